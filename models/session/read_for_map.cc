#include "models/session/read_for_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "data/columns.h"
#include "data/measurements/clock/time_units.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/measured_files.h"
#include "data/measurements/reading/derived_columns.h"
#include "data/measurements/reading/read_table.h"
#include "data/measurements/row_filters.h"
#include "data/text.h"
#include "models/history/history.h"
#include "models/history/rows_made_for.h"
#include "models/map_experience.h"

namespace errmap::models {
namespace {

// Its column of positions; "" where nothing tells it.
std::string PositionOf(const FittedModel& fitted) {
  if (fitted.reading != nullptr && fitted.reading->position.column) {
    return *fitted.reading->position.column;
  }
  for (const TrainedInput& input : fitted.inputs) {
    if (data::IsPosition(input.column)) return input.column.name;
  }
  return "";
}

bool HasMemory(const FittedModel& fitted) {
  return fitted.history != nullptr && fitted.history->needs_sessions();
}

double WaysOf(const data::Reading& reading) {
  return reading.direction.values.size() == 2 ? 2.0 : 1.0;
}

// Of both ways, also where a map is of one.
double RowsPerCycle(const data::Reading& reading) {
  return reading.cycles.count == 0
             ? 0.0
             : static_cast<double>(reading.rows + reading.rows_filtered) /
                   static_cast<double>(reading.cycles.count);
}

// A memory without a clock counts rows. "" where a cycle has as many as in
// training, or where nothing tells.
std::string OtherPace(const FittedModel& fitted, const data::Reading& reading) {
  constexpr double kAlike = 0.1;
  if (!HasMemory(fitted) || fitted.history->time_unit != "rows" ||
      fitted.reading == nullptr) {
    return "";
  }
  // A map of one way that left out no rows counts those of its way.
  const bool counts_its_way = WayOf(fitted).has_value() &&
                              data::DirectionFilter(fitted.where) == nullptr;
  const double then = RowsPerCycle(*fitted.reading);
  const double now =
      RowsPerCycle(reading) / (counts_its_way ? WaysOf(reading) : 1.0);
  if (then == 0.0 || now == 0.0 || std::abs(now / then - 1.0) < kAlike) {
    return "";
  }
  return fmt::format(
      "warning: the map remembers by counting rows: {:.0f} in a cycle when it "
      "was fitted, {:.0f} here. It will be wrong; measure as before, or fit a "
      "map to data with a clock",
      then,
      now);
}

// Of steps from row to row within a session the share of those without a pause,
// of which `is_still` is true, too.
template <typename IsStill>
double ShareAtOnce(const VectorXd& time, const IsStill& is_still) {
  Index at_once = 0;
  for (Index i = 1; i < time.size(); ++i) {
    at_once += time[i] == time[i - 1] && is_still(i) ? 1 : 0;
  }
  return time.size() < 2 ? 0.0
                         : static_cast<double>(at_once) /
                               static_cast<double>(time.size() - 1);
}

// Whether the map's rows were passes with one time and temperature each, as
// tables with a column for each position have them.
bool HadPassesAtOnce(const FittedModel& fitted) {
  if (fitted.held_out == nullptr || fitted.held_out->time_unit != "s") {
    return false;
  }
  return std::ranges::all_of(
      fitted.held_out->units, [](const HeldOutErrors::Unit& unit) {
        return unit.temperature.size() == unit.elapsed.size() &&
               ShareAtOnce(unit.elapsed, [&](Index i) {
                 return unit.temperature[i] == unit.temperature[i - 1];
               }) > 0.5;
      });
}

// A memory takes temperatures off those before. "" where rows follow one
// another as in training.
std::string OtherSteps(const FittedModel& fitted,
                       const data::FoundSessions& found) {
  constexpr double kFew = 0.1;
  if (!HasMemory(fitted) || found.time_unit != "s" ||
      !HadPassesAtOnce(fitted) ||
      ShareAtOnce(found.time, [](Index) { return true; }) > kFew) {
    return "";
  }
  return "warning: the map was fitted to passes with one time and temperature "
         "each, and each row here has its own: its memory was not tried on "
         "such rows. Give each pass one time and temperature, or fit a map to "
         "a log like this";
}

// Names the unit of a clock that states none, where this is the map's unit by
// its pace; what was done.
std::optional<std::string> NameClockUnit(const FittedModel& fitted,
                                         const data::Reading::Time& now,
                                         data::CsvTable* table) {
  if (fitted.reading == nullptr || now.sure || !now.column || !now.step_s) {
    return std::nullopt;
  }
  const data::Reading::Time& then = fitted.reading->time;
  const data::TimeUnit* const of_map = data::FindTimeUnit(then.unit);
  const data::TimeUnit* const taken = data::FindTimeUnit(now.unit);
  const std::ptrdiff_t column = table->Find(*now.column);
  if (of_map == nullptr || taken == nullptr || of_map == taken ||
      !then.step_s || column < 0) {
    return std::nullopt;
  }
  const auto away = [&](double step) {
    return std::abs(std::log(step / *then.step_s));
  };
  if (away(*now.step_s * of_map->seconds / taken->seconds) >=
      away(*now.step_s)) {
    return std::nullopt;
  }
  std::string& name = table->columns[static_cast<std::size_t>(column)].name;
  name += fmt::format(" [{}]", of_map->name);
  return fmt::format("{} counts {}, as when the map was fitted",
                     data::QuotedName(*now.column),
                     of_map->name);
}

data::DatasetSelection SelectionToRead(const FittedModel& fitted,
                                       const data::CsvTable& table,
                                       const MapDataArguments& arguments) {
  data::DatasetSelection selection =
      SelectionOfRows(fitted.history.get(), table, arguments);
  selection.target = fitted.target.name;
  if (table.Find(PositionOf(fitted)) >= 0) {
    selection.position = PositionOf(fitted);
  }
  return selection;
}

// "" where the table has the column that names the map's sessions.
std::string OtherSessions(const FittedModel& fitted,
                          const data::CsvTable& table,
                          const MapDataArguments& arguments) {
  if (!HasMemory(fitted) || fitted.history->session.empty() ||
      !arguments.session.empty() || table.Find(fitted.history->session) >= 0) {
    return "";
  }
  return fmt::format("no column {}: the clock gives the sessions",
                     data::QuotedName(fitted.history->session));
}

// What was found of the rows; remarks go to the table's.
data::ReadTable ReadRows(const FittedModel& fitted,
                         const MapDataArguments& arguments,
                         data::TableForMap* given) {
  const auto read_them = [&] {
    return data::ReadRowsForMap(
        given->table, SelectionToRead(fitted, given->table, arguments));
  };
  data::ReadTable read = read_them();
  if (arguments.time.empty()) {
    if (auto named = NameClockUnit(fitted, read.reading.time, &given->table)) {
      given->remarks.push_back(*std::move(named));
      read = read_them();
    }
  }
  if (read.reading.order == "none") {
    // A slow pass stands so, too.
    read.reading.order = "file";
    if (HasMemory(fitted)) {
      given->remarks.emplace_back(
          "warning: the rows are in order of position; the map's memory "
          "needs them as measured, or a column of times");
    }
  }
  for (std::string remark : {OtherSessions(fitted, given->table, arguments),
                             OtherPace(fitted, read.reading),
                             OtherSteps(fitted, read.found)}) {
    if (!remark.empty()) given->remarks.push_back(std::move(remark));
  }
  for (const TrainedInput& input : fitted.inputs) {
    if (data::IsReadBySensor(input.column)) {
      read.reading.sensors.push_back(input.column.name);
    }
  }
  return read;
}

// Whether the ways that were read are those of the rows: by a column, or by the
// positions where these are whole passes. Probes here and there go no way.
bool AreWaysTold(const FittedModel& fitted, const data::Reading& reading) {
  constexpr double kWhole = 0.9;
  return reading.direction.sure &&
         (reading.direction.by == "column" ||
          RowsPerCycle(reading) / WaysOf(reading) >=
              kWhole * RowsPerCycle(*fitted.reading) / WaysOf(*fitted.reading));
}

// Whether the map's filter, or the lack of one, does for these rows.
bool NeedsNoWays(const FittedModel& fitted,
                 const data::Reading::Direction& direction,
                 const std::string& way) {
  const data::ColumnFilter* const filter = data::DirectionFilter(fitted.where);
  if (filter == nullptr) {
    return std::ranges::count(direction.values, way) ==
           std::ssize(direction.values);
  }
  return direction.column == filter->column &&
         std::ranges::count(direction.labels, ValueText(*filter)) > 0;
}

// kWayColumn of rows whose table is `seen`; nothing where no map asks for it.
std::optional<data::CsvColumn> WaysOfRows(const FittedModel& fitted,
                                          const data::CsvTable& seen,
                                          const data::Reading& reading) {
  const std::optional<std::string> way = WayOf(fitted);
  const data::Reading::Direction& direction = reading.direction;
  if (!way || !AreWaysTold(fitted, reading) ||
      NeedsNoWays(fitted, direction, *way)) {
    return std::nullopt;
  }
  std::vector<Index> codes(seen.num_rows, 0);
  for (std::size_t row = 0; direction.column && row < codes.size(); ++row) {
    const std::string label =
        seen.CellText(seen.At(seen.Find(*direction.column)), row);
    codes[row] =
        std::ranges::find(direction.labels, label) - direction.labels.begin();
  }
  std::vector<std::string> words = direction.values;
  words.emplace_back();  // of other labels
  return data::WordColumn(kWayColumn, codes, std::move(words));
}

// One table of the files, its sessions and times named as the map names them.
data::JoinedTable ReadFiles(const FittedModel& fitted,
                            const std::vector<std::string>& files,
                            const MapDataArguments& arguments) {
  const std::string session =
      fitted.history == nullptr ? "" : fitted.history->session;
  const bool by_file = session == data::kFileColumn;
  // Another column is looked for later, where --session may name it.
  data::JoinedTable read =
      data::ReadTables(files,
                       {.session = by_file ? session : "",
                        .with = arguments.with,
                        .clock_offset = arguments.clock_offset});
  if (by_file && read.table.Find(data::kFileColumn) < 0) {
    data::AddFileColumn(data::FileLabel(read.table.file), &read.table);
  }
  if (arguments.session.empty()) data::NameLike(session, &read.table);
  if (arguments.time.empty() && fitted.history != nullptr) {
    data::NameLike(fitted.history->time, &read.table);
  }
  return read;
}

}  // namespace

data::TableForMap ReadForMap(const FittedModel& fitted,
                             const std::vector<std::string>& files,
                             MapColumns columns,
                             const MapDataArguments& arguments) {
  data::JoinedTable read = ReadFiles(fitted, files, arguments);
  std::vector<data::ColumnInfo> inputs;
  for (const TrainedInput& input : fitted.inputs) {
    inputs.push_back(input.column);
  }
  const data::TargetOfMap target{fitted.target, arguments.target};
  data::TableForMap result = data::InMapUnits(
      std::move(read.table),
      inputs,
      columns == MapColumns::kInputsAndTarget ? &target : nullptr);
  result.remarks.insert(
      result.remarks.begin(), read.remarks.begin(), read.remarks.end());
  data::ReadTable rows = ReadRows(fitted, arguments, &result);
  if (!rows.order.empty()) {
    result.table = data::TakeRows(result.table, rows.order);
  }
  if (auto ways = WaysOfRows(fitted, rows.table, rows.reading)) {
    result.table.columns.push_back(*std::move(ways));
  }
  const std::string position = PositionOf(fitted);
  data::AddDerivedColumns(fitted.where,
                          result.table.Find(position) < 0 ? "" : position,
                          fitted.history ? fitted.history->session : "",
                          &result.table);
  result.reading = std::move(rows.reading);
  result.order = std::move(rows.order);
  return result;
}

}  // namespace errmap::models
