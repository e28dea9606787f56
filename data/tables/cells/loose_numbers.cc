#include "data/tables/cells/loose_numbers.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "data/column_words.h"
#include "data/columns.h"
#include "data/tables/cells/missing_cells.h"
#include "data/tables/cells/unit_cells.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

std::size_t DigitsOf(std::string_view text) {
  return std::min(text.find_first_not_of("0123456789"), text.size());
}

// What parts thousands, at the front of a text; "" where nothing does.
std::string_view MarkOf(std::string_view text) {
  constexpr auto kMarks = std::to_array<std::string_view>({" ",
                                                           "'",
                                                           ".",
                                                           ",",
                                                           "\xC2\xA0",
                                                           "\xE2\x80\xAF",
                                                           "\xE2\x80\x89",
                                                           "\xE2\x80\x99"});
  for (const std::string_view mark : kMarks) {
    if (text.starts_with(mark)) return mark;
  }
  return "";
}

// The digits of "25 000", "1.234.567" or, as in India, "12,34,567" without
// their marks, off the front of `text`; none if there are no groups.
std::string TakeGroups(std::string_view* text,
                       std::string_view* mark,
                       int* count) {
  std::string_view rest = *text;
  const std::size_t first = DigitsOf(rest);
  if (first == 0 || first > 3) return "";
  std::string digits(rest.substr(0, first));
  rest.remove_prefix(first);
  *mark = MarkOf(rest);
  for (*count = 0; !mark->empty() && rest.starts_with(*mark); ++*count) {
    const std::string_view group = rest.substr(mark->size());
    const std::size_t size = DigitsOf(group);
    const bool is_lakh =
        size == 2 && *mark == "," && group.substr(size).starts_with(*mark);
    if (size != 3 && !is_lakh) break;
    digits += group.substr(0, size);
    rest = group.substr(size);
  }
  *text = rest;
  return *count > 0 ? digits : "";
}

// "12.3" and "0.2" of "12.3 ± 0.2", "12.3 +/- 0.2" or "12.3(2)"; else nothing.
// "1(2)" is a label.
std::optional<std::pair<std::string_view, std::string_view>> AtUncertainty(
    std::string_view cell) {
  if (cell.ends_with(')')) {
    cell.remove_suffix(1);
    const std::size_t at = cell.find('(');
    if (at == cell.npos || cell.find_first_of(".,") > at) return std::nullopt;
    return std::pair(cell.substr(0, at), cell.substr(at + 1));
  }
  for (const std::string_view sign : {"\xC2\xB1", "\xB1", "+/-", "+-"}) {
    const std::size_t at = cell.find(sign);
    if (at == cell.npos) continue;
    return std::pair(Trimmed(cell.substr(0, at)),
                     Trimmed(cell.substr(at + sign.size())));
  }
  return std::nullopt;
}

// Where the digits, signs and marks in the width of a Chinese character begin
// in UTF-8: U+FF0B to U+FF19.
constexpr std::string_view kFullWidth = "\xEF\xBC";

// The cell without a sign of money before or behind its number; empty if there
// is none.
std::string WithoutCurrency(std::string_view cell) {
  constexpr auto kSigns = std::to_array<std::string_view>(
      {"$", "\xE2\x82\xAC", "\xC2\xA3", "\xC2\xA5", "\x80", "\xA3", "\xA5"});
  for (const std::string_view sign : kSigns) {
    const std::size_t at = cell.find(sign);
    if (at == cell.npos) continue;
    const std::string_view before = TrimmedCell(cell.substr(0, at));
    const std::string_view behind = TrimmedCell(cell.substr(at + sign.size()));
    if (before.find_first_not_of("(+-") == cell.npos || behind.empty()) {
      return std::string(before).append(behind);
    }
  }
  return "";
}

std::string WithAsciiDigits(std::string_view cell) {
  std::string plain;
  for (std::size_t at = cell.find(kFullWidth); at != cell.npos;
       at = cell.find(kFullWidth)) {
    plain += cell.substr(0, at);
    cell.remove_prefix(at + kFullWidth.size());
    if (cell.empty()) break;
    constexpr unsigned char kFromAscii = 0x60;
    plain += static_cast<char>(static_cast<unsigned char>(cell.front()) -
                               kFromAscii);
    cell.remove_prefix(1);
  }
  return plain += cell;
}

}  // namespace

bool ReadFortranNumber(std::string_view cell,
                       bool decimal_comma,
                       NumberForm* form) {
  const std::size_t at = cell.find_first_of("dD");
  if (at == cell.npos || at == 0 || at + 2 >= cell.size() ||
      (cell[at + 1] != '-' && cell[at + 1] != '+')) {
    return false;
  }
  std::string with_e(cell);
  with_e[at] = 'e';
  return ReadNumberForm(with_e, decimal_comma, form);
}

Loose ReadLooseNumber(std::string_view cell,
                      bool decimal_comma,
                      bool other_mark,
                      NumberForm* form) {
  if (const std::size_t remark = cell.find(" #"); remark != cell.npos) {
    const std::string_view number = Trimmed(cell.substr(0, remark));
    return ReadNumberForm(number, decimal_comma, form) ? Loose::kRemark
                                                       : Loose::kNone;
  }
  if (cell.find(kFullWidth) != cell.npos) {
    return ReadNumberForm(WithAsciiDigits(cell), decimal_comma, form)
               ? Loose::kFullWidth
               : Loose::kNone;
  }
  if (const std::string bare = WithoutCurrency(cell); !bare.empty()) {
    const Loose kind = ReadLooseNumber(bare, decimal_comma, other_mark, form);
    return kind == Loose::kNone ? kind : std::max(kind, Loose::kCurrency);
  }
  if (ReadFortranNumber(cell, decimal_comma, form)) return Loose::kExponent;
  if (const auto parts = AtUncertainty(cell)) {
    NumberForm uncertainty;
    return ReadNumberForm(parts->second, decimal_comma, &uncertainty) &&
                   ReadNumberForm(parts->first, decimal_comma, form)
               ? Loose::kUncertainty
               : Loose::kNone;
  }
  if (cell.starts_with('(') && cell.ends_with(')') &&
      cell.find_first_of(".,") != cell.npos &&
      ReadNumberForm(cell.substr(1, cell.size() - 2), decimal_comma, form)) {
    form->value = -form->value;  // as accountants and Excel write it
    return Loose::kParentheses;
  }
  Loose kind = Loose::kDash;
  std::string sign;
  for (const std::string_view dash :
       {"\xE2\x88\x92", "\xE2\x80\x93", "-", "+"}) {
    if (!cell.starts_with(dash)) continue;
    cell.remove_prefix(dash.size());
    cell = Trimmed(cell);  // "-   1.26"
    sign = dash == "+" ? "" : "-";
    break;
  }
  if (cell.find_first_of("0123456789.") != 0) return Loose::kNone;
  if (sign.empty() && cell.ends_with('-')) {  // as SAP writes it
    cell.remove_suffix(1);
    sign = "-";
    kind = Loose::kMinusBehind;
  }
  if (ReadNumberForm(cell, decimal_comma, form)) {  // the dash was in the way
    form->value = sign.empty() ? form->value : -form->value;
    return kind;
  }
  if (kind == Loose::kDash) kind = Loose::kMarks;
  std::string_view mark;
  int groups = 0;
  std::string number = TakeGroups(&cell, &mark, &groups);
  if (number.empty()) return Loose::kNone;
  const char decimal = decimal_comma && mark != "," ? ',' : '.';
  const bool has_decimals = cell.size() > 1 &&
                            (cell.front() == decimal || cell.front() == '.') &&
                            DigitsOf(cell.substr(1)) + 1 == cell.size();
  const bool is_doubtful = mark == "." || mark == ",";
  if (!(cell.empty() || has_decimals) ||
      (has_decimals && mark.front() == cell.front()) ||
      (is_doubtful && groups < 2 && !has_decimals && !other_mark)) {
    return Loose::kNone;
  }
  form->decimal_comma = has_decimals && cell.front() == ',';
  form->decimal_point = has_decimals && cell.front() == '.';
  if (has_decimals) number += "." + std::string(cell.substr(1));
  return ParseNumber(sign + number, &form->value) ? kind : Loose::kNone;
}

CellLabel TakeLabel(std::string_view* cell) {
  std::string_view rest = *cell;
  while (rest.size() > 2 && (rest[0] == 'N' || rest[0] == 'G') &&
         IsDigit(rest[1])) {
    rest = Trimmed(rest.substr(1 + DigitsOf(rest.substr(1))));
  }
  constexpr std::string_view kAxes = "XYZUVWABC";
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_";
  std::size_t size = std::min(rest.find_first_not_of(kLetters), rest.size());
  const std::size_t sign =
      std::min(rest.find_first_not_of("0123456789", size), rest.size());
  const bool has_sign = size > 0 && sign + 1 < rest.size() && rest[sign] == '=';
  if (has_sign) size = sign;
  CellLabel label{.text = std::string(rest.substr(0, size)), .is_axis = false};
  label.is_axis = size == 1 && kAxes.find(rest[0]) != kAxes.npos;
  rest = Trimmed(rest.substr(size + (has_sign ? 1 : 0)));
  // "X1" may be the name of a place, "run-1" that of a run.
  const std::size_t mark = rest.find_first_of(".,");
  const bool has_decimals = mark != rest.npos && mark > 0 &&
                            mark + 1 < rest.size() && IsDigit(rest[mark - 1]);
  const bool is_number =
      has_sign || has_decimals ||
      (label.is_axis &&
       (rest.find_first_of(".,-+") != rest.npos || rest.size() >= 3));
  if (size == 0 || rest.empty() || !is_number) return {};
  *cell = rest;
  return label;
}

void LooseNumbers::Add(Loose kind, std::size_t line) {
  Seen& seen = seen_[static_cast<std::size_t>(kind)];
  if (seen.count++ == 0) seen.first_line = line;
}

std::vector<std::string> LooseNumbers::Remarks() const {
  constexpr auto kHow = std::to_array<std::string_view>(
      {"",
       " with a dash for the minus",
       " without marks between thousands",
       " without their sign of money",
       " without the remark after it",
       " with a minus after the number, which changes the sign",
       " with D for the exponent",
       " without the uncertainty behind them",
       " whose parentheses are a minus",
       " with full-width digits"});
  static_assert(kHow.size() == std::tuple_size_v<decltype(seen_)>);
  std::vector<std::string> remarks;
  for (std::size_t i = 1; i < kHow.size(); ++i) {
    const Seen& seen = seen_[i];
    if (seen.count == 0) continue;
    remarks.push_back(std::to_string(seen.count) +
                      (seen.count == 1 ? " cell is read as a number"
                                       : " cells are read as numbers") +
                      std::string(kHow[i]) + " (the first on line " +
                      std::to_string(seen.first_line) + ")");
  }
  return remarks;
}

namespace {

// The numbers of cells that all carry one unit, or a label.
struct UnitCells {
  std::string unit;
  CellLabel label;
  std::vector<std::optional<NumberForm>> numbers;  // (texts) none: no reading
};

// "n.d.", "refused", "<0.05 mg/l": a cell in place of a number.
bool IsNoReading(std::string_view text) {
  return !HasDigit(text) || text.starts_with('<') || text.starts_with('>');
}

// The word behind all numbers of a column is its unit, whatever it is, unless
// they count or date something: "3 Lauf".
bool MayBeUnit(const std::string& name, std::string_view word) {
  using enum Word;
  for (const Word label : {kTime,
                           kDate,
                           kDirection,
                           kCycle,
                           kSession,
                           kRun,
                           kCounter,
                           kIdentifier}) {
    if (Says(name, label)) return false;
  }
  return word.find_first_of(" -+.,:;_#()[]*'\"") == word.npos;
}

// "Kg" for "kg"; but "MPa" is not "mPa".
bool IsSameUnit(std::string_view a, std::string_view b) {
  return a == b ||
         (EqualsIgnoringCase(a, b) && !StartsWithIgnoringCase(a, "m"));
}

// Nothing unless more cells are such numbers than words; and most of all where
// the unit is not known.
std::optional<UnitCells> ReadUnitCells(const CsvColumn& column,
                                       bool decimal_comma,
                                       bool other_mark) {
  UnitCells cells;
  bool is_known = true;
  for (const std::string& text : column.texts) {
    cells.numbers.emplace_back();
    if (IsMissingNumber(text) || IsNoReading(text)) continue;
    std::string_view cell = text;
    const CellLabel label = TakeLabel(&cell);
    const std::size_t size = cell.find_last_of("0123456789") + 1;
    std::string unit(TrimmedCell(cell.substr(size)));
    NumberForm form;
    const bool is_first = cells.unit.empty() && cells.label.text.empty();
    is_known = ReadUnitCell(&unit) && is_known;
    if ((unit.empty() && label.text.empty()) ||
        ReadLooseNumber(
            cell.substr(0, size), decimal_comma, other_mark, &form) ==
            Loose::kNone ||
        !(is_first ||
          (IsSameUnit(cells.unit, unit) && cells.label.text == label.text))) {
      return std::nullopt;
    }
    if (is_first) cells.unit = unit;
    cells.label = label;
    cells.numbers.back() = form;
  }
  std::size_t numbers = 0;
  std::size_t missing = 0;
  for (const auto& [row, text] : column.exceptions) {
    numbers += cells.numbers[text] ? 1 : 0;
    missing += IsMissingNumber(column.texts[text]) ? 1 : 0;
  }
  const std::size_t others = column.exceptions.size() - numbers;
  const bool is_column = is_known
                             ? numbers > others - missing
                             : numbers > others && column.texts.size() > 1 &&
                                   MayBeUnit(column.name, cells.unit);
  return is_column ? std::optional(std::move(cells)) : std::nullopt;
}

void TakeNumbers(const UnitCells& cells, CsvColumn* column) {
  std::vector<std::pair<std::size_t, std::uint32_t>> missing;
  for (const auto& cell : column->exceptions) {
    if (const auto& number = cells.numbers[cell.second]) {
      column->values.Own()[cell.first] = number->value;
      column->NoteMarks(
          cell.first, number->decimal_comma, number->decimal_point);
    } else {
      missing.push_back(cell);
    }
  }
  column->exceptions = std::move(missing);
}

// "T1_2 [degF]" where "T1 [degF]" is another column's.
std::optional<std::string> FreeNameWithUnit(const CsvTable& table,
                                            const CsvColumn& column,
                                            const std::string& unit) {
  std::optional<std::string> name = NameWithUnit(column.name, unit);
  for (int i = 2; name && *name != column.name && table.Find(*name) >= 0; ++i) {
    name = NameWithUnit(column.name + "_" + std::to_string(i), unit);
  }
  return name;
}

}  // namespace

void TakeUnitsOfCells(bool decimal_comma, bool other_mark, CsvTable* table) {
  std::size_t number = 0;
  for (CsvColumn& column : table->columns) {
    const std::string unnamed = "column_" + std::to_string(++number);
    if (!column.is_text() || column.values.empty()) continue;
    const auto cells = ReadUnitCells(column, decimal_comma, other_mark);
    if (!cells) continue;
    const std::string& label = cells->label.text;
    if (!label.empty()) {
      TakeNumbers(*cells, &column);
      table->Remark("the cells of " + QuotedName(column.name) +
                    (cells->label.is_axis
                         ? " are program words, read as positions "
                         : " begin with their name, ") +
                    label);
      if (column.name == unnamed ||
          (cells->label.is_axis && !IsCalledPosition(column.name))) {
        column.name = FreeName(*table, label);
      }
    }
    if (cells->unit.empty()) continue;
    const auto name = FreeNameWithUnit(*table, column, cells->unit);
    if (!name) continue;
    column.name = *name;
    if (label.empty()) TakeNumbers(*cells, &column);
    table->Remark("the cells of " + QuotedName(column.name) +
                  " carry their unit (" + cells->unit +
                  "), which is read as the column's");
  }
}

}  // namespace errmap::data
