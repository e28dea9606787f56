#include "data/tables/csv_dialect.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "data/input_error.h"
#include "data/tables/cells/loose_numbers.h"
#include "data/tables/cells/missing_cells.h"
#include "data/tables/cells/thousands.h"
#include "data/text.h"

namespace errmap::data {
namespace {

// Where all else is equal the rarer character wins: commas and semicolons
// occur in names.
constexpr auto kDelimiters = std::to_array<char>({'\t', ';', '|', ','});

constexpr std::size_t kMostRecords = 100;
constexpr std::size_t kMuchText = 1U << 20U;

// "2024-03-01", "08:12:05,5", "01.03.2024T08:00".
bool IsLikeTime(std::string_view cell) {
  return cell.find_first_not_of("0123456789.,:/-+TZ ") ==
             std::string_view::npos &&
         HasDigit(cell) && cell.find_first_of(":/-.") != std::string_view::npos;
}

bool IsKnown(std::string_view cell, bool decimal_comma) {
  NumberForm form;
  return ReadNumberForm(cell, decimal_comma, &form) || IsMissingNumber(cell) ||
         IsLikeTime(cell) || ReadFortranNumber(cell, decimal_comma, &form);
}

// How well a delimiter explains the rows: of those of the usual width the
// share, times what of their cells, names in the first row apart, is known.
using Score = std::tuple<double, bool, std::size_t>;

Score ScoreOf(const std::vector<CsvRecord>& records, char delimiter) {
  std::size_t width = UsualWidth(records, 0);
  // Of a single row the names tell better.
  if (records.size() == 2) {
    width = std::max(width, records.front().cells.size());
  }
  if (width < 2) return {};
  std::size_t rows = 0;
  std::size_t cells = 0;
  std::size_t known = 0;
  for (const CsvRecord& record : records) {
    if (record.cells.size() != width) continue;
    ++rows;
    if (&record == records.data()) continue;
    cells += width;
    known += static_cast<std::size_t>(
        std::ranges::count_if(record.cells, [&](const std::string& cell) {
          return IsKnown(cell, delimiter != ',');
        }));
  }
  // Words alone tell something, too.
  constexpr double kOfWords = 0.1;
  const double share =
      static_cast<double>(rows) / static_cast<double>(records.size());
  const double of_known =
      cells == 0 ? 0.0
                 : static_cast<double>(known) / static_cast<double>(cells);
  return {share * (kOfWords + of_known),
          records.front().cells.size() == width,
          width};
}

// What the numbers of the first rows tell: where commas part cells, those in
// quotes may have decimal commas. No number has three zeros for decimals.
void TakeDecimals(const std::vector<CsvRecord>& records, CsvDialect* dialect) {
  bool commas = false;
  bool all_round = true;
  bool any_round = false;
  for (const CsvRecord& record : records) {
    for (const std::string& cell : record.cells) {
      NumberForm form;
      if (!ReadNumberForm(cell, true, &form)) continue;
      dialect->decimal_points = dialect->decimal_points || form.decimal_point;
      commas = commas ||
               (form.decimal_comma && !MayPartThousands(cell, cell.find(',')));
      const bool is_round = cell.ends_with(",000");
      any_round = any_round || is_round;
      all_round = all_round && (is_round || !form.decimal_comma);
    }
  }
  if (dialect->delimiter == ',') {
    dialect->decimal_comma = commas && !dialect->decimal_points;
    if (any_round && all_round && !commas) dialect->decimal_points = true;
  }
}

bool AreWords(const CsvRecord& record) {
  return std::ranges::none_of(record.cells, [](const std::string& cell) {
    return IsKnown(cell, true);
  });
}

// The names lack one for the first column, which numbers the rows.
bool AreNamesOfAllButOne(const CsvRecord& record, std::size_t width) {
  return record.cells.size() > 1 && record.cells.size() + 1 == width &&
         AreWords(record);
}

// Blanks part cells where they do so in most rows, of known cells, and a row of
// names or of numbers that begins the file, or names further down, has as many.
bool ArePartedByBlanks(const std::vector<CsvRecord>& records) {
  const std::size_t width = UsualWidth(records, 0);
  const auto [score, agrees, cells] = ScoreOf(records, ' ');
  constexpr double kHalf = 0.5;
  return width > 1 && score > kHalf &&
         (agrees || AreNamesOfAllButOne(records.front(), width) ||
          (records.size() > 2 &&
           std::ranges::any_of(records.begin(),
                               records.begin() + 2,
                               [&](const CsvRecord& record) {
                                 return record.cells.size() == width &&
                                        !IsKnown(record.cells.front(), true);
                               })) ||
          std::ranges::any_of(records, [&](const CsvRecord& record) {
            return record.cells.size() == width && AreWords(record);
          }));
}

// A column of numbers with decimal commas under a name without one.
bool IsColumnOfCommas(const std::vector<CsvRecord>& records) {
  if (records.size() < 2 || records.front().cells.size() != 1) return false;
  bool any = false;
  for (const CsvRecord& record : records) {
    if (&record == records.data()) continue;
    if (record.cells.size() > 2) return false;
    const std::string text = JoinWords(record.cells, ",");
    NumberForm form;
    if (!ReadNumberForm(text, true, &form) && !IsMissingNumber(text)) {
      return false;
    }
    any = any || form.decimal_comma;
  }
  return any;
}

}  // namespace

std::vector<CsvRecord> FirstRecords(CsvCells cells) {
  std::vector<CsvRecord> records;
  const char* const begin = cells.position().cursor;
  bool is_too_wide = false;
  try {
    while (
        !cells.at_end() && !is_too_wide && records.size() < kMostRecords &&
        (records.size() < 3 || cells.position().cursor < begin + kMuchText)) {
      if (cells.front() == '#' || cells.AtBlankLine()) {
        cells.SkipLine();
        continue;
      }
      CsvRecord record{.start = cells.position()};
      do {
        record.cells.emplace_back(cells.Next());
        is_too_wide = record.cells.size() > kMostCsvColumns;
      } while (cells.PassEnd() && !is_too_wide);
      records.push_back(std::move(record));
    }
  } catch (const InputError&) {
    // To be told where the row is read.
  }
  if (is_too_wide) {
    cells.ThrowAt(records.back().start.line,
                  "more than " + std::to_string(kMostCsvColumns) +
                      " columns; keep those that are needed, or write a row "
                      "for each reading");
  }
  return records;
}

std::size_t UsualWidth(const std::vector<CsvRecord>& records,
                       std::size_t first) {
  std::map<std::size_t, std::size_t> rows_of;
  std::size_t usual = 1;
  for (std::size_t i = first; i < records.size(); ++i) {
    const std::size_t width = records[i].cells.size();
    const std::size_t rows = ++rows_of[width];
    if (rows >= rows_of[usual]) usual = width;
  }
  if (usual > 1) return usual;
  // Lines of one cell are titles where a part of the lines are rows of more.
  constexpr std::size_t kFewestRows = 3;
  constexpr std::size_t kLinesPerRow = 4;
  for (const auto& [width, rows] : rows_of) {
    const bool is_table =
        rows >= kFewestRows && kLinesPerRow * rows >= records.size() - first;
    if (width > 1 && is_table && (usual == 1 || rows >= rows_of.at(usual))) {
      usual = width;
    }
  }
  return usual;
}

CsvDialect FindDialect(const CsvCells& cells) {
  CsvDialect dialect;
  CsvDialect unclosed;  // by which a quote in the first row never is
  Score best{};
  CsvCells trial = cells;
  for (const char delimiter : kDelimiters) {
    trial.delimiter = delimiter;
    const std::vector<CsvRecord> records = FirstRecords(trial);
    if (delimiter == ',' && std::get<0>(best) == 0.0 &&
        IsColumnOfCommas(records)) {
      return {.decimal_comma = true};
    }
    const CsvDialect tried{.delimiter = delimiter,
                           .decimal_comma = delimiter != ','};
    if (records.empty()) unclosed = tried;
    const Score score = ScoreOf(records, delimiter);
    if (score > best) {
      best = score;
      dialect = tried;
      TakeDecimals(records, &dialect);
    }
  }
  if (dialect.delimiter != CsvCells::kNoDelimiter) return dialect;
  trial.delimiter = ' ';
  if (ArePartedByBlanks(FirstRecords(trial))) {
    return {.delimiter = ' ', .decimal_comma = true};
  }
  return unclosed;
}

}  // namespace errmap::data
