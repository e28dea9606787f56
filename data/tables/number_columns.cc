#include "data/tables/number_columns.h"

#include "data/tables/cells/csv_cells.h"
#include "data/tables/cells/loose_numbers.h"
#include "data/tables/cells/missing_cells.h"
#include "data/tables/cells/unit_cells.h"
#include "data/text.h"

namespace errmap::data {

NumberColumns::NumberColumns(const std::vector<CsvRecord>& records,
                             std::size_t width,
                             const CsvDialect& dialect)
    : dialect_(dialect) {
  FindLabels(records, width);
  std::vector<CellCounts> counts(width);
  std::size_t rows = 0;
  for (const CsvRecord& record : records) {
    if (record.cells.size() != width) continue;
    // The first row may be names.
    if (++rows == 2) counts.assign(width, {});
    for (std::size_t i = 0; i < width; ++i) {
      if (IsNumber(record.cells[i], i)) {
        ++counts[i].numbers;
      } else if (!IsMissingNumber(record.cells[i])) {
        ++counts[i].words;
      }
    }
  }
  for (const CellCounts& column : counts) {
    is_number_.push_back(column.numbers > 0 && column.numbers >= column.words);
    count_ += is_number_.back() ? 1 : 0;
  }
}

void NumberColumns::FindLabels(const std::vector<CsvRecord>& records,
                               std::size_t width) {
  bool is_first = true;
  labels_.resize(width);
  for (const CsvRecord& record : records) {
    if (record.cells.size() != width) continue;
    for (std::size_t i = 0; i < width; ++i) {
      if (!is_first && labels_[i].empty()) continue;
      std::string_view cell = record.cells[i];
      const std::string label = TakeLabel(&cell).text;
      if (is_first) labels_[i] = label;
      if (label != labels_[i]) labels_[i].clear();
    }
    is_first = false;
  }
}

bool NumberColumns::IsNumber(std::string_view cell, std::size_t column) const {
  NumberForm form;
  if (ReadLooseNumber(
          cell, dialect_.decimal_comma, dialect_.decimal_points, &form) !=
      Loose::kNone) {
    return true;
  }
  const std::string& label = labels_[column];
  return !label.empty() && TakeLabel(&cell).text == label;
}

CellCounts NumberColumns::CountsOf(
    const std::vector<std::string>& cells) const {
  CellCounts counts;
  for (std::size_t i = 0; i < cells.size() && i < width(); ++i) {
    if (!Holds(i)) continue;
    if (IsNumber(cells[i], i)) {
      ++counts.numbers;
    } else if (!IsMissingNumber(cells[i])) {
      ++counts.words;
    }
  }
  return counts;
}

bool NumberColumns::MayBeNames(const std::vector<std::string>& cells) const {
  const CellCounts counts = CountsOf(cells);
  return cells.size() + 1 >= width() && (cells.size() > 1 || width() == 1) &&
         counts.numbers == 0 && 2 * counts.words >= count_;
}

bool NumberColumns::AreUnits(const std::vector<std::string>& cells) const {
  std::size_t units = 0;
  for (std::size_t i = 0; i < cells.size() && i < width(); ++i) {
    std::string unit = AsUtf8(cells[i]);
    units += Holds(i) && ReadUnitCell(&unit) && !unit.empty() ? 1 : 0;
  }
  return units >= 2 && 4 * units >= 3 * count_;
}

}  // namespace errmap::data
