#include "models/history/map_log.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "data/columns.h"
#include "data/input_error.h"
#include "data/measurements/axis/directions.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_match.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/reading/read_table.h"
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

// Rows before those of a table, by a clock of their own.
struct Earlier {
  data::FoundSessions found;
  MatrixXd readings;  // (rows x inputs); NaN where nothing remembers them
  std::string file;
  std::vector<std::string> remarks;
};

// What names a column of both files may not be in this one.
MapDataArguments ArgumentsFor(const data::CsvTable& table,
                              const MapDataArguments& arguments) {
  MapDataArguments own = arguments;
  for (std::string* named : {&own.time, &own.session}) {
    if (*named != "none" && table.Find(*named) < 0) named->clear();
  }
  return own;
}

// In order of time. Positions are not known between measurements, and no filter
// reads them.
Earlier ReadEarlier(const FittedModel& fitted,
                    const MapDataArguments& arguments,
                    const data::FoundSessions& later) {
  const History& history = *fitted.history;
  std::vector<data::ColumnInfo> needed;
  const std::vector<Index> remembered = history.remembered();
  for (const Index input : remembered) {
    needed.push_back(fitted.inputs[static_cast<std::size_t>(input)].column);
  }
  data::CsvTable given = data::ReadCsv(arguments.after);
  data::NameLike(history.session, &given);
  data::NameLike(history.time, &given);
  // Rows before those of a file that is a session belong to it.
  if (later.sessions.column == data::kFileColumn &&
      given.Find(data::kFileColumn) < 0) {
    data::AddFileColumn(later.sessions.labels[0], &given);
  }
  data::TableForMap read = data::InMapUnits(std::move(given), needed);
  const MapDataArguments own = ArgumentsFor(read.table, arguments);
  const data::DatasetSelection selection =
      SelectionFor(history, read.table, own);
  if (const data::ReadTable rows = data::ReadRowsForMap(read.table, selection);
      !rows.order.empty()) {
    read.table = data::TakeRows(read.table, rows.order);
  }
  Earlier earlier{
      .found = FindAll(history, read.table, selection),
      .readings = MatrixXd::Constant(static_cast<Index>(read.table.num_rows),
                                     std::ssize(fitted.inputs),
                                     stats::kNaN),
      .file = read.table.file,
      .remarks = std::move(read.remarks)};
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const std::size_t at = data::RequireColumn(read.table, needed[i].name, "");
    earlier.readings.col(remembered[i]) = data::ValuesOfRows(
        read.table.columns[at], stats::AllIndices(earlier.readings.rows()));
  }
  return earlier;
}

// When each session of a table begins.
VectorXd StartsOf(const data::FoundSessions& found) {
  VectorXd starts = VectorXd::Constant(std::ssize(found.sessions.labels),
                                       std::numeric_limits<double>::infinity());
  for (Index row = 0; row < found.time.size(); ++row) {
    double& start = starts[found.sessions.codes[static_cast<std::size_t>(row)]];
    start = std::min(start, found.time[row]);
  }
  return starts;
}

// The session of the later rows in which each earlier row is: by name where
// both files have the same column of these, else the one that begins after it
// without a night between. -1: it is over, or has begun.
std::vector<Index> SessionsGoneOn(const data::FoundSessions& earlier,
                                  const data::FoundSessions& later) {
  const std::vector<std::string>& labels = later.sessions.labels;
  std::vector<Index> sessions(earlier.sessions.codes.size(), -1);
  if (!earlier.sessions.column.empty() &&
      earlier.sessions.column == later.sessions.column) {
    for (std::size_t row = 0; row < sessions.size(); ++row) {
      const std::string& label =
          earlier.sessions
              .labels[static_cast<std::size_t>(earlier.sessions.codes[row])];
      const auto at = std::ranges::find(labels, label);
      if (at != labels.end()) sessions[row] = at - labels.begin();
    }
    return sessions;
  }
  if (later.time_unit != "s") {
    std::ranges::fill(sessions, 0);
    return sessions;
  }
  const VectorXd starts = StartsOf(later);
  for (Index session = 0; session < starts.size(); ++session) {
    double next = starts[session];
    for (Index row = earlier.time.size() - 1; row >= 0; --row) {
      const double time = earlier.time[row];
      if (time >= starts[session]) continue;
      if (next - time >= data::kShortestNight) break;
      sessions[static_cast<std::size_t>(row)] = session;
      next = time;
    }
  }
  return sessions;
}

// Earlier rows before those found, as far as their sessions go on; their
// number.
Index Prepend(const Earlier& earlier,
              const data::CsvTable& table,
              data::FoundSessions* found,
              MatrixXd* readings) {
  if (earlier.found.time_column >= 0 && found->time_column >= 0 &&
      earlier.found.dated != found->dated) {
    throw data::InputError(fmt::format(
        "{}: its clock and that of {} have no common zero, since one of them "
        "has dates; give both files the same column of times",
        data::PrintablePath(earlier.file),
        data::PrintablePath(table.file)));
  }
  const std::vector<Index> sessions = SessionsGoneOn(earlier.found, *found);
  const bool has_clock = found->time_unit == "s";
  const VectorXd starts = StartsOf(*found);
  std::vector<Index> rows;
  std::vector<Index> codes;
  for (std::size_t row = 0; row < sessions.size(); ++row) {
    const Index session = sessions[row];
    const auto at = static_cast<Index>(row);
    if (session < 0 ||
        (has_clock && earlier.found.time[at] >= starts[session])) {
      continue;
    }
    rows.push_back(at);
    codes.push_back(session);
  }
  const auto count = std::ssize(rows);
  codes.insert(
      codes.end(), found->sessions.codes.begin(), found->sessions.codes.end());
  found->sessions.codes = std::move(codes);
  VectorXd time(count + found->time.size());
  time << earlier.found.time(rows),
      found->time.array() + (has_clock ? 0.0 : static_cast<double>(count));
  found->time = std::move(time);
  MatrixXd all(count + readings->rows(), readings->cols());
  all << earlier.readings(rows, Eigen::all), *readings;
  *readings = std::move(all);
  return count;
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
  data::FoundSessions found = FindSessionsFor(history, table, arguments);
  auto log = std::make_shared<data::SessionLog>();
  log->input_values = ReadingsOf(fitted, table);
  if (!arguments.after.empty()) {
    Earlier earlier = ReadEarlier(fitted, arguments, found);
    map.warnings = std::move(earlier.remarks);
    map.first_row = Prepend(earlier, table, &found, &log->input_values);
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
