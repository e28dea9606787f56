#pragma once

// Small tables in text, and what was read of them.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/input_error.h"

namespace errmap::data::small_tables {

inline std::vector<std::string> NamesIn(const CsvTable& table) {
  std::vector<std::string> names;
  for (const CsvColumn& column : table.columns) names.push_back(column.name);
  return names;
}

inline std::string RefusalOf(std::string_view text,
                             OddRows odd = OddRows::kRefuse) {
  try {
    ParseCsv(text, "f.csv", odd);
  } catch (const InputError& error) {
    return error.what();
  }
  return "read";
}

// Eight rows of three readings, a cell more at the end of each.
inline std::string Rows(const std::string& end = "") {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    text += std::to_string(20 * i - 200) + ",20." + std::to_string(i) + ",-" +
            std::to_string(i) + ".95" + end + "\n";
  }
  return text;
}

inline void ExpectRows(const CsvTable& table) {
  ASSERT_EQ(table.num_rows, 8U);
  ASSERT_GE(table.columns.size(), 3U);
  for (int i = 0; i < 8; ++i) {
    const auto row = static_cast<std::size_t>(i);
    EXPECT_EQ(table.columns[0].values[row], 20 * i - 200);
    EXPECT_DOUBLE_EQ(table.columns[1].values[row], 20 + 0.1 * i);
    EXPECT_DOUBLE_EQ(table.columns[2].values[row], -(i + 0.95));
  }
}

inline const std::string kNames = "position_mm,t1_degC,error_um";

}  // namespace errmap::data::small_tables
