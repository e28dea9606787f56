#include "models/history/map_log.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/row_filters.h"
#include "data/text.h"
#include "models/history/earlier_rows.h"
#include "models/history/rows_made_for.h"
#include "models/trained_range.h"
#include "stats/indices.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

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
        fmt::format("warning: session {} seems to have begun before its first "
                    "row here: inside = 0 {}; give the earlier rows with {}, "
                    "or say {} if the machine was at rest before",
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
            ? ", by jumps of the filtered inputs"
            : fmt::format(": the map's filters work over steps of up to "
                          "{:.6g} s",
                          history.longest_bridged())));
  }
  if (!arguments.after.empty() && !any_goes_on) {
    map->warnings.push_back(fmt::format(
        "warning: no session of {} continues in {}, so {} changes nothing",
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

// When the map was fitted, the rows that it is not made for were not part of
// its log. A memory that counts rows must see the others only: what stands
// between two of these lies on the line between them, which its filters take
// for nothing new. Where no filter had left any out, they are not counted
// either.
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

}  // namespace

data::DatasetSelection SelectionOfRows(const History* history,
                                       const data::CsvTable& table,
                                       const MapDataArguments& arguments) {
  data::DatasetSelection selection;
  selection.time = arguments.time;
  selection.session = arguments.session;
  if (history == nullptr) return selection;
  // Of several possible columns, the one that the map was fitted with.
  const auto take = [&table](const std::string& of_map, std::string* column) {
    if (column->empty() && !of_map.empty() && table.Find(of_map) >= 0) {
      *column = of_map;
    }
  };
  take(history->time, &selection.time);
  take(history->session, &selection.session);
  if (history->gap > 0.0) selection.gap = data::CsvNumber(history->gap);
  return selection;
}

data::FoundSessions FindSessionsFor(const History& history,
                                    const data::CsvTable& table,
                                    const MapDataArguments& arguments) {
  data::DatasetSelection selection =
      SelectionOfRows(&history, table, arguments);
  if (history.time_unit == "rows") selection.time = "none";
  if (history.session.empty() && selection.session.empty()) {
    selection.session = "none";
  }
  // A clock shows the nights where no column tells the sessions.
  if (selection.session.empty() && history.time_unit != "s") {
    throw data::InputError(
        fmt::format("{}: no column {}, which shows the map's memory where a "
                    "session begins; add it, or name another with {}",
                    data::PrintablePath(table.file),
                    data::QuotedName(history.session),
                    data::ArgumentName("session")));
  }
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
  data::FoundSessions found = FindSessionsFor(history, table, arguments);
  auto log = std::make_shared<data::SessionLog>();
  log->input_values = ReadingsOf(fitted, table);
  if (!arguments.after.empty()) {
    EarlierRows earlier =
        PrependEarlier(fitted, table, arguments, &found, &log->input_values);
    map.warnings = std::move(earlier.remarks);
    map.first_row = earlier.count;
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
