// What damages a table in real collections of files (a separator more or less
// in a row and column, quotes, delimiters, line ends, other tables, headers
// that lack or come twice; after Vitagliano et al., Pollock, VLDB 2023), each
// put into a table of six days: none is read to other numbers without a word.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"

namespace errmap::data {
namespace {

using Cells = std::vector<std::string>;

// ---- The table.

struct Plain {
  Cells names;
  std::vector<Cells> rows;

  std::size_t num_columns() const { return names.size(); }
};

std::string Decimals(double value, int digits) {
  std::string text(32, '\0');
  text.resize(static_cast<std::size_t>(
      std::snprintf(text.data(), text.size(), "%.*f", digits, value)));
  return text;
}

// Six days of fourteen rows; `with_remark`: a last column that is mostly empty.
Plain SixDays(bool with_remark) {
  std::mt19937_64 random(64);
  const auto noise = [&] {
    return static_cast<double>(random() % 2001) / 1000.0 - 1.0;
  };
  Plain plain{.names = {"day",
                        "cycle",
                        "time_s",
                        "position_mm",
                        "t00_degC",
                        "t03_degC",
                        "t13_degC",
                        "error_mm"},
              .rows = {}};
  if (with_remark) plain.names.push_back("remark");
  for (int i = 0; i < 84; ++i) {
    const int day = i / 14;
    const double position = -215.9 + 12.7 * (i % 7);
    const double warm = 22.0 + 0.05 * (i % 14) + 0.3 * day;
    Cells row{std::to_string(day + 1),
              std::to_string(i / 7 + 1),
              std::to_string(29330 + 86400 * day + 5 * (i % 14)),
              Decimals(position, 1),
              Decimals(warm + 0.1 * noise(), 2),
              Decimals(warm + 0.4 + 0.1 * noise(), 2),
              Decimals(warm + 1.1 + 0.1 * noise(), 2),
              Decimals(1e-4 * position + 2e-3 * noise(), 5)};
    if (with_remark) row.emplace_back(i % 17 == 3 ? "\"slide, cold\"" : "");
    plain.rows.push_back(std::move(row));
  }
  return plain;
}

std::string Line(const Cells& cells, const std::string& between) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    line += (i == 0 ? "" : between) + cells[i];
  }
  return line;
}

std::vector<std::string> Lines(const Plain& plain,
                               const std::string& between = ",") {
  std::vector<std::string> lines{Line(plain.names, between)};
  for (const Cells& row : plain.rows) lines.push_back(Line(row, between));
  return lines;
}

std::string File(const std::vector<std::string>& lines,
                 const std::string& end = "\n") {
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

// ---- What becomes of a damaged file.

enum class Outcome { kSame, kSaid, kRefused, kRefusedByCell, kOther };

// The row of the table that a row was, by its time, which no two rows share;
// else by its place where no row is lacking.
const Cells* RowOf(const Plain& plain, const CsvTable& table, std::size_t row) {
  for (const CsvColumn& column : table.columns) {
    if (column.name != "time_s" && column.name != "column_3") continue;
    for (const Cells& cells : plain.rows) {
      if (std::stod(cells[2]) == column.values[row]) return &cells;
    }
  }
  return table.num_rows == plain.rows.size() ? &plain.rows[row] : nullptr;
}

std::size_t ColumnOf(const Plain& plain, const CsvTable& table, std::size_t i) {
  for (std::size_t k = 0; k < plain.num_columns(); ++k) {
    if (plain.names[k] == table.columns[i].name) return k;
  }
  return i;
}

Outcome JudgeTable(const Plain& plain, const CsvTable& table) {
  bool has_text = false;
  for (const std::string& remark : table.remarks) {
    // A name cut in two, before columns that hold no numbers.
    if (remark.find("the rows end before 1 column") != std::string::npos) {
      return Outcome::kSaid;
    }
  }
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    if (std::ranges::all_of(table.columns, [&](const CsvColumn& column) {
          return std::isnan(column.values[row]);
        })) {
      has_text = true;
      continue;
    }
    const Cells* const was = RowOf(plain, table, row);
    if (was == nullptr) return Outcome::kOther;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const double value = table.columns[i].values[row];
      const std::size_t k = ColumnOf(plain, table, i);
      const bool was_number = k < 8;
      if (std::isnan(value)) {
        has_text = has_text || was_number;
      } else if (!was_number || value != std::stod((*was)[k])) {
        return Outcome::kOther;
      }
    }
  }
  if (has_text) return Outcome::kRefusedByCell;
  const bool all = table.num_rows == plain.rows.size();
  if (!table.remarks.empty()) return Outcome::kSaid;
  return all ? Outcome::kSame : Outcome::kOther;
}

struct Counts {
  std::map<Outcome, int> of;
  std::vector<std::string> wrong;

  int total() const {
    int sum = 0;
    for (const auto& [outcome, count] : of) sum += count;
    return sum;
  }
};

Outcome OutcomeOf(const Plain& plain, const std::string& text, OddRows odd) {
  try {
    return JudgeTable(plain, ParseCsv(text, "f.csv", odd));
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_THAT(message, ::testing::StartsWith("f.csv: "));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return Outcome::kRefused;
  }
}

// As it stands, and without the rows of another length.
void Try(const Plain& plain,
         const std::string& what,
         const std::string& text,
         Counts* counts) {
  const Outcome outcome = OutcomeOf(plain, text, OddRows::kOffer);
  ++counts->of[outcome];
  if (outcome == Outcome::kOther) counts->wrong.push_back(what);
  if (OutcomeOf(plain, text, OddRows::kLeaveOut) == Outcome::kOther) {
    counts->wrong.push_back(what + ", odd rows left out");
  }
}

void ExpectNoneWrong(const Counts& counts, int at_least) {
  EXPECT_THAT(counts.wrong, ::testing::IsEmpty());
  EXPECT_GE(counts.total(), at_least);
  std::string figures;
  for (const auto& [outcome, count] : counts.of) {
    figures += std::to_string(static_cast<int>(outcome)) + ": " +
               std::to_string(count) + "  ";
  }
  ::testing::Test::RecordProperty("outcomes", figures);
  std::printf("outcomes (same, said, refused, by cell, other) %s\n",
              figures.c_str());
}

// ---- The damages.

using Damage = std::function<std::string(Cells, std::size_t column)>;

// To each line and each cell in turn.
void TryEachCell(const std::string& what,
                 const Damage& damage,
                 Counts* counts,
                 std::size_t step = 1) {
  for (const bool with_remark : {false, true}) {
    const Plain plain = SixDays(with_remark);
    for (std::size_t row = 0; row <= plain.rows.size(); row += step) {
      for (std::size_t i = 0; i < plain.num_columns(); ++i) {
        std::vector<std::string> lines = Lines(plain);
        lines[row] = damage(row == 0 ? plain.names : plain.rows[row - 1], i);
        Try(plain,
            what + ", line " + std::to_string(row + 1) + ", cell " +
                std::to_string(i) + ": " + lines[row],
            File(lines),
            counts);
      }
    }
  }
}

TEST(PollutedFile, ASeparatorMoreInARowShiftsNothing) {
  Counts counts;
  TryEachCell(
      "before the cell",
      [](Cells cells, std::size_t i) {
        cells.insert(cells.begin() + static_cast<std::ptrdiff_t>(i), "");
        return Line(cells, ",");
      },
      &counts);
  TryEachCell(
      "within the cell",
      [](Cells cells, std::size_t i) {
        if (cells[i].size() > 1) cells[i].insert(cells[i].size() / 2, ",");
        return Line(cells, ",");
      },
      &counts);
  TryEachCell(
      "and an empty cell at the end",
      [](Cells cells, std::size_t i) {
        cells.insert(cells.begin() + static_cast<std::ptrdiff_t>(i), "");
        cells.emplace_back();
        return Line(cells, ",");
      },
      &counts);
  ExpectNoneWrong(counts, 4000);
}

TEST(PollutedFile, ASeparatorLessInARowJoinsNothing) {
  Counts counts;
  TryEachCell(
      "after the cell",
      [](Cells cells, std::size_t i) {
        if (i + 1 < cells.size()) {
          cells[i] += cells[i + 1];
          cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(i + 1));
        }
        return Line(cells, ",");
      },
      &counts);
  TryEachCell(
      "the cell lacks",
      [](Cells cells, std::size_t i) {
        cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(i));
        return Line(cells, ",");
      },
      &counts);
  ExpectNoneWrong(counts, 2700);
}

TEST(PollutedFile, AQuoteTooManyLosesNoRow) {
  Counts counts;
  for (const std::string quote : {"\"", "\"\"", "'"}) {
    for (const int place : {0, 1, 2}) {
      TryEachCell(
          quote + " at " + std::to_string(place),
          [&](Cells cells, std::size_t i) {
            cells[i].insert(place * cells[i].size() / 2, quote);
            return Line(cells, ",");
          },
          &counts,
          4);
    }
  }
  ExpectNoneWrong(counts, 3000);
}

TEST(PollutedFile, ARowWithAnotherDelimiterOrLineEndIsNoOther) {
  Counts counts;
  for (const bool with_remark : {false, true}) {
    const Plain plain = SixDays(with_remark);
    for (std::size_t row = 0; row <= plain.rows.size(); ++row) {
      const Cells& cells = row == 0 ? plain.names : plain.rows[row - 1];
      for (const std::string between : {";", "\t", " ", "|", ", ", " , "}) {
        std::vector<std::string> lines = Lines(plain);
        lines[row] = Line(cells, between);
        Try(plain,
            "'" + between + "' in line " + std::to_string(row + 1),
            File(lines),
            &counts);
      }
      for (const std::string end : {"\r", "\r\n", "", "\n\n", "\n \n"}) {
        std::vector<std::string> lines = Lines(plain);
        std::string text;
        for (std::size_t i = 0; i < lines.size(); ++i) {
          text += lines[i] + (i == row ? end : "\n");
        }
        Try(plain,
            "end of line " + std::to_string(row + 1) + " of " +
                std::to_string(end.size()),
            text,
            &counts);
      }
      std::vector<std::string> lines = Lines(plain);
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(row), lines[0]);
      Try(plain, "names at " + std::to_string(row), File(lines), &counts);
    }
  }
  ExpectNoneWrong(counts, 2000);
}

// Of these most are read.
TEST(PollutedFile, WholeFilesInOtherFormsAreReadOrRefused) {
  Counts counts;
  for (const bool with_remark : {false, true}) {
    const Plain plain = SixDays(with_remark);
    const std::vector<std::string> lines = Lines(plain);
    const auto with_first = [&](const std::vector<std::string>& first) {
      std::vector<std::string> all = first;
      all.insert(all.end(), lines.begin(), lines.end());
      return File(all);
    };
    const auto with_last = [&](const std::vector<std::string>& last) {
      std::vector<std::string> all = lines;
      all.insert(all.end(), last.begin(), last.end());
      return File(all);
    };
    const std::string empty(plain.num_columns() - 1, ',');
    for (const std::string between : {",", ";", "\t", "|", ", ", " , "}) {
      for (const std::string end : {"\n", "\r\n", "\r"}) {
        Try(plain, "form" + between, File(Lines(plain, between), end), &counts);
      }
    }
    Try(plain, "no names", File({lines.begin() + 1, lines.end()}), &counts);
    Try(plain, "title", with_first({"Linear test"}), &counts);
    Try(plain, "titles", with_first({"Linear test", "", "Axis: X"}), &counts);
    Try(plain, "wide title", with_first({"Linear test" + empty}), &counts);
    Try(plain, "wide titles", with_first({"A" + empty, empty}), &counts);
    Try(plain, "pairs", with_first({"Machine,3", "Temp,20.3"}), &counts);
    Try(plain, "wide pair", with_first({"Temp,20.3" + empty}), &counts);
    Try(plain, "two names", with_first({lines[0]}), &counts);
    Try(plain, "group names", with_first({"a,,,b,c,,,d"}), &counts);
    Try(plain, "footer", with_last({"end"}), &counts);
    Try(plain, "blank, footer", with_last({"", "end of file"}), &counts);
    Try(plain, "empty rows", with_last({empty, empty}), &counts);
    Try(plain, "sum", with_last({"sum" + empty}), &counts);
    Try(plain, "names again", with_last({lines[0]}), &counts);
    Try(plain, "narrow table", with_last({"", "a,b", "1,2", "3,4"}), &counts);
    Try(plain, "narrow table at once", with_last({"a,b", "1,2"}), &counts);
    Try(plain,
        "wide table",
        with_last({"", lines[0] + ",x,y", lines[1] + ",1,2"}),
        &counts);
    Try(plain,
        "other names",
        with_last({"", Line(Cells(plain.num_columns(), "name"), ",")}),
        &counts);
    Try(plain,
        "other names at once",
        with_last({Line(Cells(plain.num_columns(), "name"), ",")}),
        &counts);
    Try(plain, "mark", "\xEF\xBB\xBF" + File(lines), &counts);
    std::string text = File(lines);
    const std::size_t last = lines.back().size() + 2;
    for (std::size_t cut = 1; cut < 60; ++cut) {
      text.pop_back();
      // Nobody sees that a whole row is lacking.
      if (text.size() == File(lines).size() - last || text.ends_with('\n')) {
        continue;
      }
      Try(plain, "cut by " + std::to_string(cut), text, &counts);
    }
  }
  ExpectNoneWrong(counts, 150);
  EXPECT_GT(counts.of[Outcome::kSame] + counts.of[Outcome::kSaid], 90);
}

}  // namespace
}  // namespace errmap::data
