#include "data/measurements/column_match.h"

#include <cstddef>
#include <utility>

#include "data/column_header.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/reading/digit_dates.h"
#include "data/measurements/reading/merged_cells.h"
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
                                   const std::string& wanted) {
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
          (nearest.empty() ? std::string("add it or fit a map without it.")
                           : "did you mean " + QuotedName(nearest) + "?") +
          " The columns are " + ListOfNames(names));
}

std::string UnitInWords(const Unit& unit) {
  return unit.symbol.empty() ? "no unit" : unit.symbol;
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

MatchedColumn MatchColumn(const CsvTable& table, const ColumnInfo& of_map) {
  const std::ptrdiff_t exact = table.Find(of_map.name);
  const CsvColumn& column =
      exact >= 0 ? table.At(exact) : SameNameInAnyUnit(table, of_map.name);
  MatchedColumn match{.of_map = of_map,
                      .of_file = {column.name, UnitOfColumn(column.name)}};
  // The very name, and nothing in it that says otherwise; an earlier version
  // read no unit in "t1_C".
  if (exact >= 0 &&
      (match.of_file.unit.symbol.empty() || of_map.unit.symbol.empty())) {
    match.of_file.unit = of_map.unit;
  }
  if (AreConvertible(match.of_file.unit, of_map.unit)) return match;
  throw InputError(PrintablePath(table.file) + ": column " +
                   QuotedName(column.name) + " is in " +
                   UnitInWords(match.of_file.unit) + ", the map's " +
                   QuotedName(of_map.name) + " in " + UnitInWords(of_map.unit) +
                   ", and the one is not to be converted into the other; "
                   "rename the column with its unit, or add another");
}

TableForMap InMapUnits(CsvTable table, const std::vector<ColumnInfo>& of_map) {
  TableForMap result;
  FillMergedCells(FindMergedCells(table), &table);
  WriteDates(FindDigitDates(table), &table);
  // Told here, and to nobody again.
  result.remarks = std::exchange(table.remarks, {});
  for (const ColumnInfo& wanted : of_map) {
    const MatchedColumn match = MatchColumn(table, wanted);
    if (match.Remark().empty()) continue;
    result.remarks.push_back(match.Remark());
    CsvColumn& column =
        table.columns[static_cast<std::size_t>(table.Find(match.of_file.name))];
    column.name = wanted.name;
    if (!match.is_converted()) continue;
    for (double& value : column.values.Own()) value = match.InMapUnit(value);
  }
  result.table = std::move(table);
  return result;
}

}  // namespace errmap::data
