#include "models/history/map_log.h"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_match.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/reading/directions.h"
#include "data/measurements/row_filters.h"
#include "data/text.h"
#include "models/trained_range.h"
#include "stats/indices.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

data::DatasetSelection SelectionFor(const History& history,
                                    const data::CsvTable& table,
                                    const MapDataArguments& arguments) {
  data::DatasetSelection selection;
  selection.time = history.time_unit == "rows" ? "none" : arguments.time;
  // Of several possible time columns, the one that the map was fitted with.
  if (selection.time.empty() && !history.time.empty() &&
      table.Find(history.time) >= 0) {
    selection.time = history.time;
  }
  if (history.gap > 0.0) selection.gap = data::CsvNumber(history.gap);
  selection.session = arguments.session;
  if (selection.session.empty()) {
    selection.session = history.session.empty() ? "none" : history.session;
    if (!history.session.empty() && table.Find(history.session) < 0) {
      // A clock shows the nights.
      if (history.time_unit == "s") {
        selection.session.clear();
        return selection;
      }
      throw data::InputError(fmt::format(
          "{}: no column {}, which tells the map's memory where a session "
          "begins; add it, or name another with {}",
          data::PrintablePath(table.file),
          data::QuotedName(history.session),
          data::ArgumentName("session")));
    }
  }
  return selection;
}

data::FoundSessions FindAll(const History& history,
                            const data::CsvTable& table,
                            const data::DatasetSelection& selection) {
  const std::vector<Index> rows =
      stats::AllIndices(static_cast<Index>(table.num_rows));
  data::FoundSessions found = data::FindSessions(table, selection, rows);
  if (history.time_unit == "s" && found.time_column < 0) {
    throw data::InputError(fmt::format(
        "{}: no column of times, which the map's filters need; add one (time_s "
        "or dates and times), or name it with {}{}",
        data::PrintablePath(table.file),
        data::ArgumentName("time"),
        found.remarks.empty() ? "" : " (" + found.remarks.front() + ")"));
  }
  return found;
}

// Until when a session that begins inside is not known.
std::string UntilSettled(const History& history) {
  const double after = history.settles_after();
  if (!std::isfinite(after)) return "throughout";
  return history.time_unit == "rows"
             ? fmt::format("for its first {:.0f} rows", after)
             : fmt::format("for its first {:.0f} min", after / 60.0);
}

void WarnOfSessions(const History& history,
                    const data::CsvTable& table,
                    const MapDataArguments& arguments,
                    MapLog* map) {
  const data::SessionLog& log = *map->log;
  map->missing = FindMissing(log, history, arguments.from_rest);
  std::vector<bool> goes_on(log.sessions.labels.size());
  std::vector<bool> is_here(goes_on.size());
  std::vector<bool> begins_inside(goes_on.size());
  std::size_t after_gaps = 0;
  for (std::size_t row = 0; row < log.sessions.codes.size(); ++row) {
    const auto session = static_cast<std::size_t>(log.sessions.codes[row]);
    if (static_cast<Index>(row) < map->first_row) {
      goes_on[session] = true;
      continue;
    }
    is_here[session] = true;
    if (map->missing[row] == Missing::kStart) begins_inside[session] = true;
    if (map->missing[row] == Missing::kReadings) ++after_gaps;
  }
  bool any_goes_on = false;
  for (std::size_t s = 0; s < goes_on.size(); ++s) {
    if (!is_here[s]) continue;
    any_goes_on = any_goes_on || goes_on[s];
    if (!begins_inside[s]) continue;
    map->warnings.push_back(
        fmt::format("warning: session {} begins inside, as no session of "
                    "training began: inside = 0 {}; give its earlier rows with "
                    "{}, or say {} where the machine was at rest before",
                    data::QuotedText(log.sessions.labels[s]),
                    UntilSettled(history),
                    data::ArgumentName("after"),
                    data::ArgumentName("from_rest")));
  }
  if (after_gaps > 0) {
    map->warnings.push_back(fmt::format(
        "warning: {} of {} rows come after a gap in the readings{}; give those "
        "between (inside = 0)",
        after_gaps,
        table.num_rows,
        history.time_unit == "rows"
            ? ", by the leaps of the filtered inputs"
            : fmt::format(": the map's filters know enough over steps of up to "
                          "{:.6g} s",
                          history.longest_bridged())));
  }
  if (!arguments.after.empty() && !any_goes_on) {
    map->warnings.push_back(
        fmt::format("warning: no session of {} goes on in {}, so {} "
                    "changes nothing",
                    data::PrintablePath(arguments.after),
                    data::PrintablePath(table.file),
                    data::ArgumentName("after")));
  }
}

// What filters remember of a spike would disturb the rows after it: the reading
// before it stands there, at the start of a session that after it.
void LeaveOutSpikes(const FittedModel& fitted,
                    const std::vector<Index>& sessions,
                    Index first_row,
                    MatrixXd* readings,
                    std::vector<std::string>* warnings) {
  for (const Spike& spike : FindSpikes(fitted.inputs, *readings)) {
    const auto row = static_cast<std::size_t>(spike.row);
    const bool is_first = row == 0 || sessions[row - 1] != sessions[row];
    const Index beside = is_first ? spike.row + 1 : spike.row - 1;
    if (beside == readings->rows()) continue;
    (*readings)(spike.row, spike.input) = (*readings)(beside, spike.input);
    if (spike.row < first_row) continue;
    const data::ColumnInfo& column =
        fitted.inputs[static_cast<std::size_t>(spike.input)].column;
    warnings->push_back(fmt::format(
        "warning: {} reads {:g} {} in data row {}: the map's memory "
        "leaves it out",
        data::QuotedName(column.name),
        spike.value,
        column.unit.symbol,
        spike.row - first_row));
  }
}

// When the map was fitted, the rows that it is not made for were no part of its
// log. A memory that counts rows must see the others only: what stands between
// two of these lies on the line between them, which its filters take for
// nothing new. Where no filter had left any out, they are not counted either.
void PassOverRowsNotMadeFor(const FittedModel& fitted,
                            const data::CsvTable& table,
                            Index first_row,
                            data::FoundSessions* found,
                            MatrixXd* readings) {
  const std::vector<bool> made_for = RowsMadeFor(fitted, table);
  const bool counts_all = data::DirectionFilter(fitted.where) != nullptr;
  const VectorXd time = found->time;
  const auto session_of = [&](Index row) {
    return found->sessions.codes[static_cast<std::size_t>(row)];
  };
  Index last = -1;  // row that the map is made for, or an earlier one
  for (Index row = 0; row < readings->rows(); ++row) {
    if (row >= first_row &&
        !made_for[static_cast<std::size_t>(row - first_row)]) {
      continue;
    }
    const bool goes_on = last >= 0 && session_of(last) == session_of(row);
    if (goes_on && !counts_all) found->time[row] = found->time[last] + 1.0;
    const double step = goes_on ? time[row] - time[last] : stats::kNaN;
    for (Index between = row - 1; between > last; --between) {
      if (session_of(between) != session_of(row)) break;
      const double part = goes_on ? (time[row] - time[between]) / step : 0.0;
      readings->row(between) = (1.0 - part) * readings->row(row) +
                               part * readings->row(goes_on ? last : row);
      if (goes_on && !counts_all)
        found->time[between] = found->time[row] - part;
    }
    last = row;
  }
}

// A table of rows before others.
struct Earlier {
  data::CsvTable table;
  MatrixXd readings;  // (rows x inputs); NaN where nothing remembers them
  std::vector<std::string> remarks;
};

// Positions are not known between measurements, and no filter reads them.
Earlier ReadEarlier(const FittedModel& fitted, const std::string& file) {
  std::vector<data::ColumnInfo> needed;
  const std::vector<Index> remembered = fitted.history->remembered();
  for (const Index input : remembered) {
    needed.push_back(fitted.inputs[static_cast<std::size_t>(input)].column);
  }
  data::TableForMap read = data::InMapUnits(data::ReadCsv(file), needed);
  const std::vector<Index> rows =
      stats::AllIndices(static_cast<Index>(read.table.num_rows));
  Earlier earlier{.table = std::move(read.table),
                  .readings = MatrixXd::Constant(
                      std::ssize(rows), std::ssize(fitted.inputs), stats::kNaN),
                  .remarks = std::move(read.remarks)};
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const std::size_t at =
        data::RequireColumn(earlier.table, needed[i].name, "");
    earlier.readings.col(remembered[i]) =
        data::ValuesOfRows(earlier.table.columns[at], rows);
  }
  return earlier;
}

}  // namespace

std::optional<std::string> WayOf(const FittedModel& fitted) {
  if (fitted.reading == nullptr || !fitted.reading->direction.sure) {
    return std::nullopt;
  }
  const data::Reading::Direction& direction = fitted.reading->direction;
  const data::ColumnFilter* const filter = data::DirectionFilter(fitted.where);
  if (filter == nullptr) {
    return direction.values.size() == 1 ? std::optional(direction.values[0])
                                        : std::nullopt;
  }
  const auto place = data::PlaceOfWay(direction, ValueText(*filter));
  return place ? std::optional(direction.values[*place]) : std::nullopt;
}

std::vector<data::ColumnFilter> FiltersFor(const FittedModel& fitted,
                                           const data::CsvTable& table) {
  const std::optional<std::string> way =
      table.Find(kWayColumn) < 0 ? std::nullopt : WayOf(fitted);
  std::vector<data::ColumnFilter> filters;
  for (const data::ColumnFilter& filter : fitted.where) {
    const bool is_told = way && &filter == data::DirectionFilter(fitted.where);
    if (!is_told && table.Find(filter.column) >= 0) filters.push_back(filter);
  }
  if (way) filters.push_back({.column = kWayColumn, .value = *way});
  return filters;
}

std::vector<bool> RowsMadeFor(const FittedModel& fitted,
                              const data::CsvTable& table) {
  std::vector<bool> made_for(table.num_rows, true);
  for (const data::ColumnFilter& filter : FiltersFor(fitted, table)) {
    data::KeepPassing(table, filter, &made_for);
  }
  return made_for;
}

data::FoundSessions FindSessionsFor(const History& history,
                                    const data::CsvTable& table,
                                    const MapDataArguments& arguments) {
  return FindAll(history, table, SelectionFor(history, table, arguments));
}

MatrixXd ReadingsOf(const FittedModel& fitted, const data::CsvTable& table) {
  const std::vector<Index> rows =
      stats::AllIndices(static_cast<Index>(table.num_rows));
  MatrixXd readings(std::ssize(rows), std::ssize(fitted.inputs));
  Index column = 0;
  for (const TrainedInput& input : fitted.inputs) {
    const std::size_t at =
        data::RequireColumn(table, input.column.name, "an input of the map");
    readings.col(column++) = data::ValuesOfRows(table.columns[at], rows);
  }
  return readings;
}

MatrixXd InputsOf(const FittedModel& fitted, const data::CsvTable& table) {
  MatrixXd inputs(static_cast<Index>(table.num_rows),
                  std::ssize(fitted.inputs));
  Index column = 0;
  for (const TrainedInput& input : fitted.inputs) {
    inputs.col(column++) = data::NumericColumn(
        table, input.column.name, data::MissingPolicy::kError, nullptr);
  }
  return inputs;
}

MapLog MakeMapLog(const FittedModel& fitted,
                  const data::CsvTable& table,
                  const MapDataArguments& arguments) {
  MapLog map;
  if (fitted.history == nullptr || !fitted.history->needs_sessions()) {
    if (!arguments.after.empty()) {
      map.warnings.push_back("warning: the map has no memory, so " +
                             data::ArgumentName("after") + " changes nothing");
    }
    return map;
  }
  const History& history = *fitted.history;
  data::DatasetSelection selection = SelectionFor(history, table, arguments);
  data::FoundSessions found = FindAll(history, table, selection);
  auto log = std::make_shared<data::SessionLog>();
  log->input_values = ReadingsOf(fitted, table);
  if (!arguments.after.empty()) {
    Earlier earlier = ReadEarlier(fitted, arguments.after);
    map.warnings = std::move(earlier.remarks);
    // Rows before those of a file that is a session belong to it.
    if (found.sessions.column == data::kFileColumn &&
        earlier.table.Find(data::kFileColumn) < 0) {
      data::AddFileColumn(found.sessions.labels[0], &earlier.table);
    }
    // Each by itself first, so that what is wrong is said of its file.
    FindAll(history, earlier.table, selection);
    std::vector<std::string> columns;
    if (!found.sessions.column.empty()) {
      columns.push_back(found.sessions.column);
    }
    if (found.time_column >= 0) {
      selection.time = table.At(found.time_column).name;
      columns.push_back(selection.time);
    }
    found = FindAll(
        history, data::AppendedTable(earlier.table, table, columns), selection);
    map.first_row = static_cast<Index>(earlier.table.num_rows);
    MatrixXd all(map.first_row + log->input_values.rows(),
                 log->input_values.cols());
    all << earlier.readings, log->input_values;
    log->input_values = std::move(all);
  }
  LeaveOutSpikes(fitted,
                 found.sessions.codes,
                 map.first_row,
                 &log->input_values,
                 &map.warnings);
  if (history.time_unit == "rows") {
    PassOverRowsNotMadeFor(
        fitted, table, map.first_row, &found, &log->input_values);
  }
  log->first_rows = data::FirstRows(
      found.sessions, log->input_values(Eigen::all, history.remembered()));
  log->sessions = std::move(found.sessions);
  log->time = std::move(found.time);
  log->time_unit = std::move(found.time_unit);
  map.log = std::move(log);
  WarnOfSessions(history, table, arguments, &map);
  return map;
}

}  // namespace errmap::models
