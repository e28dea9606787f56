#include "data/tables/shapes/long_table.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/column_words.h"
#include "data/columns.h"
#include "data/tables/cells/unit_cells.h"
#include "data/tables/shapes/numbered_names.h"
#include "data/text.h"

namespace errmap::data {
namespace {

constexpr std::size_t kMostVariables = 64;
constexpr std::ptrdiff_t kNoReading = -1;  // as TakeRows has it

bool IsValue(std::string_view word) {
  return IsOneOf(word,
                 "value val wert messwert valeur valor valore waarde varde "
                 "arvo wartosc hodnota 値 值");
}

// Of the columns of numbers the first that is called so ("value"), else the
// only one that says so ("VarValue") or has a number for a name; -1: none.
std::ptrdiff_t ColumnOfValues(const CsvTable& table) {
  std::vector<std::ptrdiff_t> found;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& column = table.columns[i];
    const std::vector<std::string> words = WordsOf(column.name);
    if (column.is_text() || words.empty() || words.size() > 2) continue;
    if (words.size() == 1 && IsValue(words[0])) {
      return static_cast<std::ptrdiff_t>(i);
    }
    if (IsValue(words.back()) || words[0] == "column") {
      found.push_back(static_cast<std::ptrdiff_t>(i));
    }
  }
  return found.size() == 1 ? found[0] : -1;
}

// An error among others: of errors alone each is a component.
bool NameVariables(const CsvTable& table,
                   const CsvColumn& column,
                   LabelsOfRows* found) {
  if (!column.is_text() || IsCalled(column.name, Word::kComponent)) {
    return false;
  }
  *found = LabelsOf(table, column, AllRows(table.num_rows), kMostVariables);
  const auto errors = std::ranges::count_if(
      found->labels,
      [](const std::string& label) { return ErrorSign(label) != 0; });
  return found->codes.size() == table.num_rows && errors > 0 &&
         errors < std::ssize(found->labels);
}

class Spreader {
 public:
  Spreader(const CsvTable& table, std::size_t variable, LabelsOfRows found)
      : table_(table), variable_(variable), found_(std::move(found)) {
    counts_.resize(found_.labels.size());
    for (const std::size_t code : found_.codes) ++counts_[code];
  }

  // Nothing where rows do not come together.
  std::optional<CsvTable> Spread(std::size_t value) {
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (i == variable_ || i == value) continue;
      const CsvColumn& column = table_.columns[i];
      if (!TakeUnits(column) && !NumbersVariables(column)) others_.push_back(i);
    }
    if (!FindMoments()) return std::nullopt;
    CsvTable spread{.file = table_.file,
                    .num_rows = firsts_.size(),
                    .titles = table_.titles,
                    .remarks = table_.remarks};
    for (const std::size_t i : others_) {
      spread.columns.push_back(TakeRows(table_.columns[i], firsts_));
    }
    for (std::size_t k = 0; k < found_.labels.size(); ++k) {
      if (IsStray(k)) continue;
      CsvColumn column = TakeRows(table_.columns[value], readings_[k]);
      column.name = FreeName(spread, found_.labels[k]);
      spread.columns.push_back(std::move(column));
    }
    for (std::size_t row = 0; row < firsts_.size(); ++row) {
      spread.line_runs.emplace_back(
          row, table_.LineOfRow(static_cast<std::size_t>(firsts_[row])));
    }
    return spread;
  }

 private:
  // One row of a variable among many: a program's mark of its end.
  bool IsStray(std::size_t variable) const {
    constexpr std::size_t kMany = 8;
    return counts_[variable] == 1 &&
           table_.num_rows > kMany * found_.labels.size();
  }

  // A column that has one unit for each variable.
  bool TakeUnits(const CsvColumn& column) {
    if (!column.is_text()) return false;
    std::vector<std::string> units(found_.labels.size());
    for (std::size_t row = 0; row < table_.num_rows; ++row) {
      std::string& unit = units[found_.codes[row]];
      const std::string text = table_.CellText(column, row);
      if (!unit.empty() && unit != text) return false;
      unit = text;
    }
    std::vector<std::string> names;
    for (std::size_t k = 0; k < units.size(); ++k) {
      std::string unit = units[k];
      // "U" of all is a state: uncertain.
      if (unit == "U" || !ReadUnitCell(&unit)) return false;
      std::optional<std::string> name = NameWithUnit(found_.labels[k], unit);
      if (!name) return false;
      names.push_back(std::move(*name));
    }
    if (names == found_.labels) return false;
    found_.labels = std::move(names);
    return true;
  }

  // A column that has a value of its own for each variable: the number of a
  // channel, as databases write it.
  bool NumbersVariables(const CsvColumn& column) const {
    std::map<std::string, std::size_t> variables;
    std::vector<bool> is_numbered(found_.labels.size(), false);
    for (std::size_t row = 0; row < table_.num_rows; ++row) {
      const std::size_t variable = found_.codes[row];
      const auto [known, is_new] =
          variables.emplace(table_.CellText(column, row), variable);
      if (known->second != variable || (is_new && is_numbered[variable])) {
        return false;
      }
      is_numbered[variable] = true;
    }
    return true;
  }

  // Rows that share their other cells, each variable once.
  bool FindMoments() {
    std::map<std::vector<std::string>, std::size_t> moments;
    readings_.resize(found_.labels.size());
    for (std::size_t row = 0; row < table_.num_rows; ++row) {
      if (IsStray(found_.codes[row])) continue;
      std::vector<std::string> cells;
      for (const std::size_t i : others_) {
        cells.push_back(table_.CellText(table_.columns[i], row));
      }
      const auto [moment, is_new] =
          moments.emplace(std::move(cells), firsts_.size());
      if (is_new) {
        firsts_.push_back(static_cast<std::ptrdiff_t>(row));
        for (auto& readings : readings_) readings.push_back(kNoReading);
      }
      std::ptrdiff_t& reading = readings_[found_.codes[row]][moment->second];
      if (reading != kNoReading) return false;
      reading = static_cast<std::ptrdiff_t>(row);
    }
    return 2 * firsts_.size() <= table_.num_rows;
  }

  const CsvTable& table_;
  std::size_t variable_;
  LabelsOfRows found_;
  std::vector<std::size_t> counts_;  // rows of each variable
  std::vector<std::size_t> others_;
  std::vector<std::ptrdiff_t> firsts_;                 // row of each moment
  std::vector<std::vector<std::ptrdiff_t>> readings_;  // rows of each variable
};

}  // namespace

void SpreadReadings(CsvTable* table) {
  const std::ptrdiff_t value = ColumnOfValues(*table);
  if (value < 0) return;
  const auto at = static_cast<std::size_t>(value);
  for (std::size_t i = 0; i < table->columns.size(); ++i) {
    LabelsOfRows found;
    if (!NameVariables(*table, table->columns[i], &found)) continue;
    std::optional<CsvTable> spread =
        Spreader(*table, i, std::move(found)).Spread(at);
    if (!spread) continue;
    spread->Remark(std::to_string(table->num_rows) +
                   " rows of one reading each are read as " +
                   std::to_string(spread->num_rows) +
                   ", with a column for each " +
                   QuotedName(table->columns[i].name));
    *table = std::move(*spread);
    return;
  }
}

namespace {

// Rows of numbers under names, some of which say that they are errors or runs.
bool NamesRows(const CsvTable& table) {
  constexpr std::size_t kFewestReadings = 4;
  const CsvColumn& names = table.columns.front();
  if (table.columns.size() <= kFewestReadings || table.num_rows < 2 ||
      !names.is_text() || names.texts.size() != table.num_rows) {
    return false;
  }
  const auto errors =
      std::ranges::count_if(names.texts, [](const std::string& text) {
        return ErrorSign(text) != 0 || ReadRunName(text).has_value();
      });
  return errors > 0 && errors < std::ssize(names.texts) &&
         std::all_of(table.columns.begin() + 1,
                     table.columns.end(),
                     [](const CsvColumn& column) {
                       return !column.is_text() && ErrorSign(column.name) == 0;
                     });
}

}  // namespace

void TurnTable(CsvTable* table) {
  if (!NamesRows(*table)) return;
  const CsvColumn& names = table->columns.front();
  const std::size_t readings = table->columns.size() - 1;
  CsvColumn heads{.name = names.name, .has_name = names.has_name};
  std::vector<double> numbers;
  for (std::size_t i = 1; i <= readings; ++i) {
    double number = 0.0;
    if (ParseNumber(table->columns[i].name, &number)) numbers.push_back(number);
  }
  if (numbers.size() == readings) {
    heads = NumberColumn(names.name, numbers);
  } else {
    std::vector<std::ptrdiff_t> codes;
    std::vector<std::string> words;
    for (std::size_t i = 0; i < readings; ++i) {
      codes.push_back(static_cast<std::ptrdiff_t>(i));
      words.push_back(table->columns[i + 1].name);
    }
    heads = WordColumn(names.name, codes, std::move(words));
  }
  std::vector<CsvColumn> columns{std::move(heads)};
  for (std::size_t row = 0; row < table->num_rows; ++row) {
    CsvColumn all{.name = *names.TextAt(row)};
    for (std::size_t i = 1; i <= readings; ++i) {
      AppendCells(
          TakeRows(table->columns[i], {static_cast<std::ptrdiff_t>(row)}),
          &all);
    }
    columns.push_back(std::move(all));
  }
  table->Remark(std::to_string(table->num_rows) +
                " rows of one variable each are read as columns");
  table->columns = std::move(columns);
  table->line_runs.clear();
  for (std::size_t row = 0; row < readings; ++row) {
    table->line_runs.emplace_back(row, 1);
  }
  table->num_rows = readings;
}

}  // namespace errmap::data
