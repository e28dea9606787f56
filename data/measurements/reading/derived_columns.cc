#include "data/measurements/reading/derived_columns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/counted_labels.h"
#include "data/measurements/axis/axis.h"
#include "data/measurements/axis/directions.h"
#include "data/measurements/clock/text_times.h"
#include "data/measurements/reading/reading.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {

using Eigen::Index;

CsvTable Borrowed(const CsvTable& table) {
  CsvTable borrowed{.file = table.file,
                    .num_rows = table.num_rows,
                    .line_runs = table.line_runs,
                    .parts = table.parts,
                    .titles = table.titles,
                    .remarks = table.remarks};
  const std::shared_ptr<const void> keeper(&table, [](const void*) {});
  for (const CsvColumn& column : table.columns) {
    const ColumnValues& values = column.values;
    CsvColumn& copy = borrowed.columns.emplace_back(
        CsvColumn{.name = column.name,
                  .has_name = column.has_name,
                  .exceptions = column.exceptions,
                  .texts = column.texts,
                  .first_decimal_comma = column.first_decimal_comma,
                  .first_decimal_point = column.first_decimal_point});
    if (values.empty()) continue;
    const std::ptrdiff_t stride =
        values.size() > 1 ? &values[1] - &values[0] : 1;
    copy.values =
        ColumnValues::Borrowed(&values[0], stride, values.size(), keeper);
  }
  return borrowed;
}

namespace {

// The values of a column by a function of them, under a name.
template <typename Of>
CsvColumn Mapped(const CsvColumn& column,
                 const std::string& name,
                 const Of& of) {
  CsvColumn mapped = column;
  mapped.name = name;
  std::vector<double> values(column.values.size());
  for (std::size_t row = 0; row < values.size(); ++row) {
    values[row] = of(row, column.values[row]);
  }
  mapped.values = std::move(values);
  return mapped;
}

// "A-B", in this unit.
std::optional<DerivedTarget> Difference(const CsvTable& table,
                                        std::string_view names,
                                        const std::string& name,
                                        const Unit& unit) {
  for (std::size_t at = names.find('-'); at != names.npos;
       at = names.find('-', at + 1)) {
    const std::ptrdiff_t a = table.Find(names.substr(0, at));
    const std::ptrdiff_t b = table.Find(names.substr(at + 1));
    if (a < 0 || b < 0) continue;
    Unit of_a = UnitOfColumn(table.At(a).name);
    Unit of_b = UnitOfColumn(table.At(b).name);
    const Unit& in = unit.symbol.empty() ? of_b : unit;
    // Neither says its unit: it is that of the difference.
    if (of_a.symbol.empty() && of_b.symbol.empty()) of_a = of_b = unit;
    if (!AreConvertible(of_a, in) || !AreConvertible(of_b, in)) continue;
    const ColumnValues& taken_off = table.At(b).values;
    CsvColumn column =
        Mapped(table.At(a), name, [&](std::size_t row, double value) {
          return Converted(value, of_a, in) -
                 Converted(taken_off[row], of_b, in);
        });
    // A cell that either lacks.
    std::set<std::size_t> lacking;
    for (const auto& cell : column.exceptions) lacking.insert(cell.first);
    for (const auto& [row, text] : table.At(b).exceptions) {
      if (!lacking.insert(row).second) continue;
      column.exceptions.emplace_back(row, column.texts.size());
      column.texts.push_back(table.At(b).texts[text]);
    }
    std::ranges::sort(column.exceptions);
    return DerivedTarget{.column = std::move(column)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<DerivedTarget> FindDerivedTarget(const CsvTable& table,
                                               const std::string& name) {
  if (table.Find(name) >= 0) return std::nullopt;
  const bool is_negative = name.starts_with('-');
  std::string_view of = name;
  if (is_negative) of.remove_prefix(1);
  Unit unit;
  if (table.Find(of) < 0 && of.ends_with(']')) {
    const std::size_t open = of.rfind('[');
    const std::string_view bare =
        open == of.npos ? of : Trimmed(of.substr(0, open));
    if (open == of.npos || table.Find(bare) < 0) {
      if (auto difference = Difference(table, of, name, {})) return difference;
    }
    if (open != of.npos) unit = UnitOfColumn(of);
    of = bare;
  }
  const std::ptrdiff_t found = table.Find(of);
  if (found < 0) return Difference(table, of, name, unit);
  const Header given = ReadHeader(table.At(found).name);
  // A unit that the name states is kept; one that it lacks is told.
  const bool converts = !unit.symbol.empty() &&
                        given.source == UnitSource::kStated &&
                        AreConvertible(given.unit, unit);
  CsvColumn column =
      Mapped(table.At(found), name, [&](std::size_t, double value) {
        const double in_unit =
            converts ? Converted(value, given.unit, unit) : value;
        return is_negative ? -in_unit : in_unit;
      });
  return DerivedTarget{.column = std::move(column),
                       .of = static_cast<std::size_t>(found)};
}

void AddDerivedColumns(const std::vector<ColumnFilter>& filters,
                       const std::string& position,
                       const std::string& session,
                       CsvTable* table) {
  const std::vector<Index> rows = AllRows(table->num_rows);
  for (std::size_t i = 0; table->Find(session) < 0 && i < table->columns.size();
       ++i) {
    const CsvColumn& labels = table->columns[i];
    if (session != SessionsNamedIn(labels.name)) continue;
    auto sessions = FindSessionsInLabels(*table, labels, rows, 1);
    if (!sessions) break;
    table->columns.push_back(std::move(*sessions));
  }
  const bool needs_direction =
      std::ranges::any_of(filters, [&](const ColumnFilter& filter) {
        return filter.column == kDirectionColumn &&
               table->Find(kDirectionColumn) < 0;
      });
  if (!needs_direction) return;
  constexpr auto kNoTarget = static_cast<std::size_t>(-1);
  const Axis axis = FindAxis(*table, {.position = position}, kNoTarget, rows);
  if (axis.column < 0 || axis.motion.directions.empty()) return;
  table->columns.push_back(DirectionColumn(*table, rows, axis.motion));
}

namespace {

// Of names without a unit: "Soll", "Y-Ist", "X".
bool MayBePlace(std::string_view name) {
  constexpr std::size_t kMostWords = 2;
  return WordsOf(name).size() <= kMostWords && !NamesTemperature(name) &&
         (Says(name, Word::kNominal) || Says(name, Word::kMeasured) ||
          IsCalledPosition(name));
}

}  // namespace

bool IsReadOf(const CsvColumn& read, const CsvColumn& commanded) {
  constexpr double kSmallPart = 0.02;  // of the range
  const Unit of_read = UnitOfColumn(read.name);
  const Unit of_commanded = UnitOfColumn(commanded.name);
  if (!AreConvertible(of_read, of_commanded)) return false;
  double low = INFINITY;
  double high = -INFINITY;
  double most = 0.0;
  for (std::size_t row = 0; row < read.values.size(); ++row) {
    const double sent = commanded.values[row];
    const double away =
        Converted(read.values[row], of_read, of_commanded) - sent;
    if (std::isnan(away)) continue;
    low = std::min(low, sent);
    high = std::max(high, sent);
    most = std::max(most, std::abs(away));
  }
  return most > 0.0 && most < kSmallPart * (high - low);
}

std::vector<ReadBeside> FindReadBeside(const CsvTable& table) {
  constexpr std::size_t kMostColumns = 200;
  const std::size_t count = std::min(table.columns.size(), kMostColumns);
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string& name = table.columns[i].name;
    const Unit unit = UnitOfColumn(name);
    if (!table.columns[i].is_text() &&
        (unit.symbol.empty() ? MayBePlace(name) : IsLengthOrAngle(unit))) {
      positions.push_back(i);
    }
  }
  const auto values_of = [&](std::size_t i) {
    const auto& values = table.columns[i].values;
    return std::set<double>(values.begin(), values.end()).size();
  };
  std::vector<ReadBeside> found;
  for (const std::size_t b : positions) {
    for (const std::size_t a : positions) {
      if (a != b && IsReadOf(table.columns[a], table.columns[b]) &&
          values_of(a) > 2 * values_of(b)) {
        found.push_back({.read = a, .commanded = b});
      }
    }
  }
  if (found.empty()) return found;
  // What was read may itself come again, yet less often than what was sent.
  const std::size_t sent =
      std::ranges::min_element(found, {}, [&](const ReadBeside& pair) {
        return values_of(pair.commanded);
      })->commanded;
  std::erase_if(found,
                [&](const ReadBeside& pair) { return pair.commanded != sent; });
  return found;
}

namespace {

// How many of this unit a millimetre is; 1 where it is no length, or one of the
// columns states its own.
double InMillimetres(const CsvTable& table,
                     const ReadBeside& positions,
                     const Unit& unit) {
  const Unit mm = UnitOfSymbol("mm");
  const bool lack_units =
      UnitOfColumn(table.columns[positions.read].name).symbol.empty() &&
      UnitOfColumn(table.columns[positions.commanded].name).symbol.empty();
  return lack_units && AreConvertible(mm, unit) ? Converted(1.0, mm, unit)
                                                : 1.0;
}

}  // namespace

void RequireDifference(const CsvTable& table,
                       std::size_t target,
                       const ReadBeside& positions) {
  constexpr std::size_t kFewestRows = 12;
  constexpr double kFits = 0.01;  // of the sum of squares may be left
  constexpr double kAlike = 0.05;
  const CsvColumn& error = table.columns[target];
  std::string difference = table.columns[positions.read].name + "-" +
                           table.columns[positions.commanded].name;
  const Unit unit = UnitOfColumn(error.name);
  const auto read = Difference(table, difference, "", unit);
  if (!read) return;
  double products = 0.0;
  double squares = 0.0;
  double all = 0.0;
  std::size_t rows = 0;
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    const double by = read->column.values[row];
    const double value = error.values[row];
    if (std::isnan(by * value)) continue;
    products += by * value;
    squares += by * by;
    all += value * value;
    ++rows;
  }
  double factor = products / squares;
  if (rows < kFewestRows || !(all - factor * products <= kFits * all)) return;
  // Positions that state no unit are in millimetres most often.
  const double in_mm = InMillimetres(table, positions, unit);
  if (in_mm != 1.0 && std::abs(std::abs(factor / in_mm) - 1.0) < kAlike) {
    factor /= in_mm;
    difference += " [mm]";
  }
  if (std::abs(factor - 1.0) < kAlike) return;
  const bool opposite = std::abs(factor + 1.0) < kAlike;
  const double decades = std::log10(std::abs(factor));
  const double whole = std::round(decades);
  if (!opposite && (whole == 0.0 || std::abs(decades - whole) > kAlike)) return;
  throw OpenQuestion(
      PrintablePath(table.file),
      {.topic = opposite ? "target" : "unit",
       .question = QuotedName(error.name) + " is " +
                   (opposite ? "the opposite of "
                             : Rounded(std::pow(10.0, whole)) + " times ") +
                   QuotedName(difference) + "; which is the error?",
       .answers = {{.option = ArgumentName("target", difference),
                    .means = "what was read less what was commanded"},
                   {.option = ArgumentName("target", error.name),
                    .means = "the column as it stands"}}});
}

std::string SessionsNamedIn(std::string_view labels) {
  return "session of " + std::string(labels);
}

std::optional<CsvColumn> FindSessionsInLabels(
    const CsvTable& table,
    const CsvColumn& labels,
    const std::vector<Eigen::Index>& rows,
    std::size_t least) {
  constexpr std::size_t kMostLabels = 5000;
  if (HoldsTimes(labels)) return std::nullopt;  // "2024-03-04" is no fourth run
  const LabelsOfRows found = LabelsOf(table, labels, rows, kMostLabels);
  const std::size_t num = found.labels.size();
  if (found.codes.size() != rows.size() || num < 2 * least ||
      num > kMostLabels ||
      !std::ranges::is_sorted(found.codes)) {  // each in one piece
    return std::nullopt;
  }
  const std::vector<std::string> sessions =
      SessionsOfCounted(found.labels, least);
  if (sessions.empty()) return std::nullopt;
  std::vector<std::string> words = {""};
  std::vector<std::ptrdiff_t> code_of;
  for (const std::string& session : sessions) {
    if (session != words.back() || words.size() == 1) words.push_back(session);
    code_of.push_back(std::ssize(words) - 1);
  }
  std::vector<std::ptrdiff_t> codes(table.num_rows, 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    codes[rows[i]] = code_of[found.codes[i]];
  }
  CsvColumn column =
      WordColumn(SessionsNamedIn(labels.name), codes, std::move(words));
  DropUnusedTexts(&column);
  return column;
}

}  // namespace errmap::data
