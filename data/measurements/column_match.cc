#include "data/measurements/column_match.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/columns.h"
#include "data/measurements/clock/digit_dates.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/reading/derived_columns.h"
#include "data/measurements/reading/merged_cells.h"
#include "data/measurements/reading/table_in_reading.h"
#include "data/text.h"

namespace errmap::data {
namespace {

[[noreturn]] void ThrowNoMatch(const CsvTable& table,
                               const std::string& wanted,
                               const std::string& why) {
  throw InputError(PrintablePath(table.file) + ": no column " +
                   QuotedName(wanted) + ", which the map reads" + why);
}

// The column with the wanted name in another unit.
const CsvColumn& SameNameInAnyUnit(const CsvTable& table,
                                   const std::string& wanted,
                                   const std::string& remedy) {
  const std::string base = ReadHeader(wanted).base;
  const CsvColumn* found = nullptr;
  std::vector<std::string> names;
  for (const CsvColumn& column : table.columns) {
    names.push_back(column.name);
    const Header header = ReadHeader(column.name);
    if (header.source == UnitSource::kUnread &&
        EqualsIgnoringCase(column.name, base + "_" + header.unit_text)) {
      ThrowNoMatch(table,
                   wanted,
                   "; of " + QuotedName(column.name) + ", " +
                       WhyNoUnit(header) + ": rename it " +
                       QuotedName(base + " [" + header.unit_text + "]"));
    }
    if (!EqualsIgnoringCase(header.base, base)) continue;
    if (found != nullptr) {
      ThrowNoMatch(table,
                   wanted,
                   "; " + QuotedName(found->name) + " and " +
                       QuotedName(column.name) +
                       " both could be meant; rename one of them");
    }
    found = &column;
  }
  if (found != nullptr) return *found;
  const std::string nearest = NearestColumn(wanted, names);
  ThrowNoMatch(
      table,
      wanted,
      "; " +
          (nearest.empty() ? remedy + "."
                           : "did you mean " + QuotedName(nearest) + "?") +
          " The columns are " + ListOfNames(names));
}

std::string UnitInWords(const Unit& unit) {
  return unit.symbol.empty() ? "no unit" : unit.symbol;
}

// With `has_map_unit` a column without a unit is in that of the map, and the
// other way round.
MatchedColumn MatchNamed(const CsvTable& table,
                         const std::string& name,
                         const ColumnInfo& of_map,
                         bool has_map_unit) {
  MatchedColumn match{.of_map = of_map, .of_file = {name, UnitOfColumn(name)}};
  if (has_map_unit &&
      (match.of_file.unit.symbol.empty() || of_map.unit.symbol.empty())) {
    match.of_file.unit = of_map.unit;
  }
  if (AreConvertible(match.of_file.unit, of_map.unit)) return match;
  throw InputError(PrintablePath(table.file) + ": column " + QuotedName(name) +
                   " is in " + UnitInWords(match.of_file.unit) +
                   ", the map's " + QuotedName(of_map.name) + " in " +
                   UnitInWords(of_map.unit) +
                   ", and the one is not to be converted into the other; "
                   "rename the column with its unit, or add another");
}

void TakeAs(const MatchedColumn& match, TableForMap* result) {
  if (match.Remark().empty()) return;
  result->remarks.push_back(match.Remark());
  CsvTable& table = result->table;
  CsvColumn& column = table.columns[table.Find(match.of_file.name)];
  column.name = match.of_map.name;
  if (!match.is_converted()) return;
  for (double& value : column.values.Own()) value = match.InMapUnit(value);
}

MatchedColumn MatchTarget(const TargetOfMap& target, CsvTable* table) {
  const std::string& named =
      target.named.empty() ? target.column.name : target.named;
  if (std::optional<DerivedTarget> derived = FindDerivedTarget(*table, named)) {
    table->columns.push_back(std::move(derived->column));
  }
  if (target.named.empty()) {
    return MatchColumn(
        *table,
        target.column,
        "name the column of the errors with " + ArgumentName("target", "COL") +
            ", one of " + "corrections with " + ArgumentName("target", "-COL"));
  }
  RequireColumn(*table, named, ArgumentName("target"));
  MatchedColumn match = MatchNamed(*table, named, target.column, true);
  std::erase_if(table->columns, [&](const CsvColumn& column) {
    return column.name == target.column.name && column.name != named;
  });
  return match;
}

}  // namespace

double MatchedColumn::InMapUnit(double value) const {
  return Converted(value, of_file.unit, of_map.unit);
}

std::string MatchedColumn::Remark() const {
  std::string remark;
  if (of_map.name != of_file.name) {
    remark = " is read from " + QuotedName(of_file.name);
  }
  if (is_converted()) {
    remark +=
        (remark.empty() ? " is converted from " : " and converted from ") +
        of_file.unit.symbol + " to " + of_map.unit.symbol;
  }
  return remark.empty()
             ? ""
             : Printable(of_map.name, of_map.name.max_size()) + remark;
}

MatchedColumn MatchColumn(const CsvTable& table,
                          const ColumnInfo& of_map,
                          const std::string& remedy) {
  // The very name, and nothing in it that says otherwise; an earlier version
  // read no unit in "t1_C".
  const bool is_exact = table.Find(of_map.name) >= 0;
  return MatchNamed(table,
                    is_exact
                        ? of_map.name
                        : SameNameInAnyUnit(table, of_map.name, remedy).name,
                    of_map,
                    is_exact);
}

void NameLike(const std::string& name, CsvTable* table) {
  if (name.empty() || table->Find(name) >= 0) return;
  const auto found =
      std::ranges::find_if(table->columns, [&](const CsvColumn& column) {
        return EqualsIgnoringCase(column.name, name);
      });
  if (found != table->columns.end()) found->name = name;
}

namespace {

// Rows of totals and remarks, in which a map predicts nothing.
void TakeOutTotals(TableForMap* result) {
  CsvTable& table = result->table;
  std::vector<bool> passes(table.num_rows, true);
  const std::vector<std::ptrdiff_t> totals = LeaveOutTotals(
      table, CycleColumn(table), MissingPolicy::kDropRows, &passes);
  if (totals.empty()) return;
  result->remarks.push_back("rows of totals or remarks are left out: " +
                            std::to_string(totals.size()) +
                            ", the first on line " +
                            std::to_string(table.LineOfRow(
                                static_cast<std::size_t>(totals.front()))));
  auto parts = table.parts;
  for (auto& part : parts) {
    part.first -= static_cast<std::size_t>(
        std::ranges::lower_bound(totals,
                                 static_cast<std::ptrdiff_t>(part.first)) -
        totals.begin());
  }
  table = TakeRows(table, MarkedRows(passes));
  table.parts = std::move(parts);
}

}  // namespace

TableForMap InMapUnits(CsvTable table,
                       const std::vector<ColumnInfo>& inputs,
                       const TargetOfMap* target) {
  TableForMap result{.table = std::move(table)};
  FillMergedCells(&result.table);
  WriteDates(&result.table);
  // Told here, and to nobody again.
  result.remarks = std::exchange(result.table.remarks, {});
  TakeOutTotals(&result);
  for (const ColumnInfo& wanted : inputs) {
    TakeAs(MatchColumn(result.table, wanted), &result);
  }
  if (target != nullptr) TakeAs(MatchTarget(*target, &result.table), &result);
  return result;
}

}  // namespace errmap::data
