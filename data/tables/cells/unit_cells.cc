#include "data/tables/cells/unit_cells.h"

#include <algorithm>
#include <string_view>

#include "data/column_header.h"
#include "data/tables/cells/csv_cells.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {

bool ReadUnitCell(std::string* cell) {
  std::string_view text = *cell;
  if (text.size() > 1 && ((text.front() == '[' && text.back() == ']') ||
                          (text.front() == '(' && text.back() == ')'))) {
    text = Trimmed(text.substr(1, text.size() - 2));
  }
  if (text.empty() || text == "-") {
    cell->clear();
    return true;
  }
  double number = 0.0;
  if (ParseNumber(text, &number) || text.find_first_of("[]()") != text.npos) {
    return false;
  }
  const bool is_unit = ReadUnit(text, UnitPlace::kBracketed).has_value();
  *cell = std::string(text);
  return is_unit;
}

bool AreUnitCells(std::vector<std::string> cells) {
  bool any = false;
  for (std::string& cell : cells) {
    cell = AsUtf8(cell);
    if (!ReadUnitCell(&cell)) return false;
    any = any || !cell.empty();
  }
  return any;
}

bool ReadUnitsOverNumbers(const std::vector<std::string>& below,
                          bool decimal_comma,
                          std::vector<std::string>* cells) {
  bool any = false;
  for (std::size_t i = 0; i < cells->size(); ++i) {
    std::string& cell = (*cells)[i];
    if (!ReadUnitCell(&cell)) return false;
    if (cell.empty()) continue;
    NumberForm form;
    if (i >= below.size() || !ReadNumberForm(below[i], decimal_comma, &form)) {
      return false;
    }
    any = true;
  }
  return any;
}

bool AreRules(const std::vector<std::string>& cells) {
  const auto rules = [](const std::string& cell) {
    return cell.find_first_not_of("-:=+") == cell.npos;
  };
  return !cells.empty() && std::ranges::all_of(cells, rules) &&
         std::ranges::any_of(
             cells, [](const std::string& cell) { return cell.size() > 2; });
}

std::optional<std::string> NameWithUnit(const std::string& name,
                                        std::string_view unit) {
  const std::string with_unit = name + " [" + std::string(unit) + "]";
  const Header header = ReadHeader(name);
  if (header.source != UnitSource::kStated) return with_unit;
  if (header.unit == ReadUnit(unit, UnitPlace::kBracketed).value_or(Unit{})) {
    return name;
  }
  // "Temp_A" over degC is the first of several.
  if (header.unit_text.size() == 1 && name.ends_with(header.unit_text)) {
    return with_unit;
  }
  return std::nullopt;
}

void AddUnitOfCell(const std::string& cell, std::string* name) {
  std::string unit = AsUtf8(cell);
  if (!ReadUnitCell(&unit) || unit.empty()) return;
  *name = NameWithUnit(AsUtf8(*name), unit).value_or(*name);
}

}  // namespace errmap::data
