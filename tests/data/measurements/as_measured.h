#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "data/csv.h"

// The measurements that tests of files as people have them begin with, as cells
// of text.

namespace errmap::data::as_measured {

using Rows = std::vector<std::vector<std::string>>;

// Three days of eight cycles of five positions.
inline constexpr int kDays = 3;
inline constexpr int kCycles = 8;
inline constexpr int kPositions = 5;
inline constexpr std::size_t kDay = 0;
inline constexpr std::size_t kCycle = 1;
inline constexpr std::size_t kTime = 2;
inline constexpr std::size_t kPosition = 3;
inline constexpr std::size_t kT1 = 4;
inline constexpr std::size_t kT2 = 5;
inline constexpr std::size_t kError = 6;

// To three decimals, as instruments write.
inline std::string Fixed(double value) {
  return CsvNumber(std::round(1000.0 * value) / 1000.0);
}

// A number in [-1, 1) that looks random, the same on every machine.
inline double Noise(int i) {
  const double x = std::sin(12.9898 * (i + 1)) * 43758.5453;
  return 2.0 * (x - std::floor(x)) - 1.0;
}

inline Rows Measured(int days = kDays) {
  Rows rows = {{"day",
                "cycle",
                "time_s",
                "position_mm",
                "t1_degC",
                "t2_degC",
                "error_um"}};
  int i = 0;
  for (int day = 0; day < days; ++day) {
    for (int cycle = 0; cycle < kCycles; ++cycle) {
      for (int p = 0; p < kPositions; ++p, ++i) {
        const double warm = 1.0 - std::exp(-0.3 * cycle - 0.02 * p);
        const double t1 = 20.0 + 0.4 * day + 8.0 * warm + 0.02 * Noise(i);
        const double t2 = 19.0 + 0.3 * day + 4.0 * warm + 0.02 * Noise(i + 500);
        const double error =
            3.0 + 1.5 * (t1 - 20.0) + 2.0 * p + 0.2 * Noise(i + 1000);
        rows.push_back({std::to_string(day + 1),
                        std::to_string(kCycles * day + cycle + 1),
                        std::to_string(600 * cycle + 30 * p),
                        std::to_string(100 * p),
                        Fixed(t1),
                        Fixed(t2),
                        Fixed(error)});
      }
    }
  }
  return rows;
}

inline std::string Joined(const Rows& rows,
                          const std::string& separator = ",",
                          const std::string& line_end = "\n") {
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += (i == 0 ? "" : separator) + row[i];
    }
    text += line_end;
  }
  return text;
}

// Each row changed; the header is row 0.
inline Rows Changed(
    Rows rows,
    const std::function<void(std::size_t, std::vector<std::string>*)>& change) {
  for (std::size_t i = 0; i < rows.size(); ++i) change(i, &rows[i]);
  return rows;
}

inline double Number(const std::string& text) { return std::stod(text); }

inline Rows WithCell(std::size_t row,
                     std::size_t column,
                     const std::string& text) {
  Rows rows = Measured();
  rows[row + 1][column] = text;
  return rows;
}

}  // namespace errmap::data::as_measured
