#include "models/session/map_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "data/columns.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/measured_files.h"
#include "data/measurements/reading/derived_columns.h"
#include "data/measurements/reading/read_table.h"
#include "data/measurements/row_filters.h"
#include "data/measurements/sessions.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

data::DatasetSelection SelectionFor(const FittedModel& fitted,
                                    const data::CsvTable& table,
                                    const MapRowsOptions& options) {
  data::DatasetSelection selection{
      .target = fitted.target.name,
      .inputs = {},
      .exclude = {},
      .group = "",
      .time = options.log.time,
      .session = options.log.session,
      .weight = "",
      .align = fitted.align,
      .missing = options.missing,
      .faults = options.faults,
      .keep_dead = true,
      .where = FiltersFor(fitted, table),
      .only_to_judge = true,
      .with_log = fitted.align != data::Alignment::kNone};
  for (const TrainedInput& input : fitted.inputs) {
    selection.inputs.push_back(input.column.name);
  }
  return selection;
}

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

data::Dataset WithMapLog(const data::Dataset& dataset, const MapLog& map) {
  if (map.log == nullptr) return dataset;
  std::vector<Index> log_rows;
  for (const Index row : dataset.rows()) {
    log_rows.push_back(map.first_row + row);
  }
  return dataset.WithLog(map.log, std::move(log_rows));
}

data::DatasetSelection SelectionOfRows(const FittedModel& fitted,
                                       const data::CsvTable& table,
                                       const MapLogArguments& arguments) {
  data::DatasetSelection selection;
  selection.time = arguments.time;
  selection.session = arguments.session;
  if (selection.session.empty() && fitted.history != nullptr &&
      table.Find(fitted.history->session) >= 0) {
    selection.session = fitted.history->session;
  }
  if (fitted.history != nullptr && fitted.history->gap > 0.0) {
    selection.gap = data::CsvNumber(fitted.history->gap);
  }
  return selection;
}

double WaysOf(const data::Reading& reading) {
  return reading.direction.values.size() == 2 ? 2.0 : 1.0;
}

double RowsPerCycle(const data::Reading& reading) {
  return reading.cycles.count == 0
             ? 0.0
             : static_cast<double>(reading.rows) /
                   static_cast<double>(reading.cycles.count);
}

// A memory without a clock counts rows. "" where a cycle has as many as in
// training, or where nothing tells.
std::string OtherPace(const FittedModel& fitted, const data::Reading& reading) {
  constexpr double kAlike = 0.1;
  const History* const history = fitted.history.get();
  if (history == nullptr || history->time_unit != "rows" ||
      !history->needs_sessions() || fitted.reading == nullptr) {
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

// Puts the rows in order of time where a clock tells it; what was found of
// them.
data::ReadTable ReadRows(const FittedModel& fitted,
                         const MapLogArguments& arguments,
                         data::CsvTable* table,
                         std::vector<std::string>* remarks) {
  data::DatasetSelection selection = SelectionOfRows(fitted, *table, arguments);
  selection.target = fitted.target.name;
  if (table->Find(PositionOf(fitted)) >= 0) {
    selection.position = PositionOf(fitted);
  }
  const History* const history = fitted.history.get();
  if (selection.time.empty() && history != nullptr &&
      table->Find(history->time) >= 0) {
    selection.time = history->time;
  }
  data::ReadTable read = data::ReadRowsForMap(*table, selection);
  if (read.reading.order == "none") {
    // A slow pass stands so, too.
    read.reading.order = "file";
    if (history != nullptr && history->needs_sessions()) {
      remarks->push_back(
          "warning: the rows stand in order of position; the map's memory "
          "needs them as measured, or a column of times");
    }
  }
  if (std::string pace = OtherPace(fitted, read.reading); !pace.empty()) {
    remarks->push_back(std::move(pace));
  }
  if (!read.order.empty()) *table = data::TakeRows(*table, read.order);
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

}  // namespace

std::string MadeForText(const FittedModel& fitted,
                        const data::CsvTable& table) {
  const std::vector<bool> made_for = RowsMadeFor(fitted, table);
  const auto count = std::ranges::count(made_for, true);
  if (count == std::ssize(made_for)) return "";
  return fmt::format("{} of {} rows have {}, for which the map is made",
                     count,
                     made_for.size(),
                     data::FiltersText(FiltersFor(fitted, table)));
}

data::TableForMap ReadForMap(const FittedModel& fitted,
                             const std::vector<std::string>& files,
                             MapColumns columns,
                             const MapLogArguments& arguments) {
  std::vector<data::ColumnInfo> of_map;
  for (const TrainedInput& input : fitted.inputs) {
    of_map.push_back(input.column);
  }
  if (columns == MapColumns::kInputsAndTarget) of_map.push_back(fitted.target);
  data::DatasetSelection selection;
  if (fitted.history != nullptr) selection.session = fitted.history->session;
  const bool by_file = selection.session == data::kFileColumn;
  // Another column is looked for later, where --session may name it.
  if (!by_file) selection.session.clear();
  data::JoinedTable read = data::ReadTables(files, selection);
  if (by_file && read.table.Find(data::kFileColumn) < 0) {
    data::AddFileColumn(data::FileLabel(read.table.file), &read.table);
  }
  data::ReadTable rows =
      ReadRows(fitted, arguments, &read.table, &read.remarks);
  if (auto ways = WaysOfRows(
          fitted, rows.table ? *rows.table : read.table, rows.reading)) {
    read.table.columns.push_back(*std::move(ways));
  }
  data::AddDerivedColumns(
      fitted.where,
      PositionOf(fitted),
      columns == MapColumns::kInputsAndTarget ? fitted.target.name : "",
      fitted.history != nullptr ? fitted.history->session : "",
      &read.table);
  data::TableForMap result = data::InMapUnits(std::move(read.table), of_map);
  result.remarks.insert(
      result.remarks.begin(), read.remarks.begin(), read.remarks.end());
  result.reading = std::move(rows.reading);
  result.order = std::move(rows.order);
  return result;
}

MomentsOfRows MomentsOf(const FittedModel& fitted,
                        const data::CsvTable& table,
                        const std::vector<Index>& rows,
                        const MapLogArguments& arguments) {
  const data::FoundSessions found = data::FindSessions(
      table, SelectionOfRows(fitted, table, arguments), rows);
  const bool has_times = found.time_column >= 0;
  MomentsOfRows moments{.at = {}, .session_column = found.sessions.column};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto session = static_cast<std::size_t>(found.sessions.codes[i]);
    moments.at.push_back(
        {.session = found.sessions.labels[session],
         .time = has_times ? found.time[static_cast<Index>(i)] : 0.0});
  }
  return moments;
}

VectorXd ElapsedSinceStart(const FittedModel& fitted,
                           const MapRows& rows,
                           const MapLogArguments& arguments) {
  const std::vector<Index> all =
      stats::AllIndices(static_cast<Index>(rows.table.num_rows));
  const std::vector<Moment> moments =
      MomentsOf(fitted, rows.table, all, arguments).at;
  std::map<std::string, double> start;
  const auto begin = [&](const std::string& session, double time) {
    const auto [at, is_new] = start.try_emplace(session, time);
    if (!is_new) at->second = std::min(at->second, time);
  };
  for (const Moment& moment : moments) {
    begin(moment.session, moment.time);
  }
  // The log of a map with a memory holds the rows before these, too.
  if (const data::SessionLog* log = rows.dataset.log().get();
      log != nullptr && log->time_unit == "s") {
    for (std::size_t row = 0; row < log->sessions.codes.size(); ++row) {
      const auto session = static_cast<std::size_t>(log->sessions.codes[row]);
      begin(log->sessions.labels[session], log->time[static_cast<Index>(row)]);
    }
  }
  VectorXd elapsed(rows.dataset.num_rows());
  for (Index i = 0; i < elapsed.size(); ++i) {
    const Index row = rows.dataset.rows()[static_cast<std::size_t>(i)];
    const Moment& moment = moments[static_cast<std::size_t>(row)];
    elapsed[i] = moment.time - start.at(moment.session);
  }
  return elapsed;
}

VectorXd PositionsOf(const FittedModel& fitted, const MapRows& rows) {
  if (fitted.held_out == nullptr) return {};
  const std::string& name = fitted.held_out->position;
  const std::ptrdiff_t column = name.empty() ? -1 : rows.table.Find(name);
  if (column < 0) return {};
  const VectorXd positions =
      data::ValuesOfRows(rows.table.At(column), rows.dataset.rows());
  return positions.allFinite() ? positions : VectorXd{};
}

MapRows MakeMapRows(const FittedModel& fitted,
                    data::CsvTable table,
                    const MapRowsOptions& options) {
  data::PreparedDataset prepared =
      data::MakeDataset(table, SelectionFor(fitted, table, options));
  if (std::string made_for = MadeForText(fitted, table); !made_for.empty()) {
    prepared.remarks.push_back(std::move(made_for));
  }
  MapLog map =
      options.with_memory ? MakeMapLog(fitted, table, options.log) : MapLog{};
  data::Dataset dataset = WithMapLog(prepared.dataset, map);
  Missing missing = Missing::kNothing;
  std::vector<Missing> missing_before(
      static_cast<std::size_t>(dataset.num_rows()), Missing::kNothing);
  if (map.log != nullptr) {
    std::size_t at = 0;
    for (const Index row : dataset.log_rows()) {
      const Missing here = map.missing[static_cast<std::size_t>(row)];
      missing_before[at++] = here;
      if (here == Missing::kStart || missing == Missing::kNothing) {
        missing = here;
      }
    }
  }
  return {.table = std::move(table),
          .prepared = std::move(prepared),
          .dataset = std::move(dataset),
          .missing = missing,
          .missing_before = std::move(missing_before),
          .warnings = std::move(map.warnings)};
}

}  // namespace errmap::models
