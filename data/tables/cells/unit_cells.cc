#include "data/tables/cells/unit_cells.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/column_header.h"
#include "data/tables/cells/csv_cells.h"
#include "data/tables/cells/missing_cells.h"
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

namespace {

constexpr double kSixty = 60.0;

// Signs of degrees, minutes and seconds; those of seconds before the
// apostrophe of minutes twice.
constexpr auto kSigns = std::to_array<std::array<std::string_view, 4>>(
    {{"\u00b0", "\u00ba", "", ""},
     {"\u2032", "\u2019", "'", ""},
     {"\u2033", "\u201d", "\"", "''"}});

// The number and the sign of one part, off the front of `cell`.
std::optional<double> TakePart(std::size_t part,
                               bool decimal_comma,
                               std::string_view* cell) {
  const std::size_t size =
      std::min(cell->find_first_not_of("0123456789.,"), cell->size());
  const std::string_view behind = TrimmedCell(cell->substr(size));
  NumberForm form;
  if (!ReadNumberForm(cell->substr(0, size), decimal_comma, &form)) {
    return std::nullopt;
  }
  for (const std::string_view sign : kSigns[part]) {
    if (sign.empty() || !behind.starts_with(sign)) continue;
    *cell = TrimmedCell(behind.substr(sign.size()));
    return form.value;
  }
  return std::nullopt;
}

// "27°30'15"" for "27:30:15".
std::string WithSigns(std::string text) {
  const std::size_t first = text.find(':');
  if (first == text.npos) return text;
  const std::size_t second = text.find(':', first + 1);
  if (second != text.npos) text.replace(second, 1, "'");
  text.replace(first, 1, kSigns[0][0]);
  return text + (second == text.npos ? "'" : "\"");
}

// Colons part times, too: angles have the unit, or they are positions, which
// come again, below 0 or beyond all hours of a clock.
bool MayBeAngles(const CsvColumn& column,
                 const std::vector<std::optional<double>>& angles) {
  constexpr double kMostHours = 48.0;
  constexpr std::size_t kFewestTimes = 3;
  const auto colons = [](const std::string& text) {
    return std::ranges::count(text, ':');
  };
  if (UnitOfColumn(column.name).symbol == "deg" ||
      std::ranges::max(column.texts, {}, colons).find(':') ==
          std::string::npos) {
    return true;
  }
  return kFewestTimes * column.texts.size() <= column.values.size() &&
         std::ranges::any_of(angles, [](const auto& angle) {
           return angle && (*angle < 0.0 || *angle > kMostHours);
         });
}

// Of each text; nothing unless most are angles.
std::vector<std::optional<double>> AnglesOf(const CsvColumn& column,
                                            bool decimal_comma) {
  std::vector<std::optional<double>> angles;
  std::ptrdiff_t others = 0;
  for (const std::string& text : column.texts) {
    angles.push_back(ReadAngle(WithSigns(text), decimal_comma));
    others += angles.back() || IsMissingNumber(text) ? 0 : 1;
  }
  const auto found = std::ranges::count_if(
      angles, [](const auto& angle) { return angle.has_value(); });
  if (found <= others || !MayBeAngles(column, angles)) angles.clear();
  return angles;
}

}  // namespace

std::optional<double> ReadAngle(std::string_view cell, bool decimal_comma) {
  const bool is_negative = cell.starts_with('-') || cell.starts_with("\u2212");
  const std::size_t sign = cell.find_first_of("0123456789");
  const std::string_view before = cell.substr(0, std::min(sign, cell.size()));
  if (sign == cell.npos || !(before.empty() || before == "+" || is_negative)) {
    return std::nullopt;
  }
  cell.remove_prefix(sign);
  const std::optional<double> degrees = TakePart(0, decimal_comma, &cell);
  if (!degrees) return std::nullopt;
  const std::optional<double> minutes = TakePart(1, decimal_comma, &cell);
  if (!minutes || *minutes >= kSixty) return std::nullopt;
  double seconds = 0.0;
  if (!cell.empty()) {
    const std::optional<double> last = TakePart(2, decimal_comma, &cell);
    if (!last || *last >= kSixty || !cell.empty()) return std::nullopt;
    seconds = *last;
  }
  const double angle = *degrees + (*minutes + seconds / kSixty) / kSixty;
  return is_negative ? -angle : angle;
}

void TakeAngleCells(bool decimal_comma, CsvTable* table) {
  for (CsvColumn& column : table->columns) {
    if (!column.is_text()) continue;
    const auto angles = AnglesOf(column, decimal_comma);
    const auto name = NameWithUnit(column.name, "deg");
    if (angles.empty() || !name) continue;
    std::erase_if(column.exceptions, [&](const auto& cell) {
      const auto& angle = angles[cell.second];
      if (angle) column.values.Own()[cell.first] = *angle;
      return angle.has_value();
    });
    column.name = *name;
    table->Remark("the cells of " + QuotedName(column.name) +
                  " are angles in degrees, minutes and seconds");
  }
}

}  // namespace errmap::data
