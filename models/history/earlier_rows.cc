#include "models/history/earlier_rows.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "data/columns.h"
#include "data/csv.h"
#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_match.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/reading/read_table.h"
#include "data/text.h"
#include "models/history/history.h"
#include "stats/indices.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

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
  if (const data::ReadTable rows = data::ReadRowsForMap(
          read.table, SelectionOfRows(&history, read.table, own));
      !rows.order.empty()) {
    read.table = data::TakeRows(read.table, rows.order);
  }
  Earlier earlier{
      .found = FindSessionsFor(history, read.table, own),
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
std::vector<Index> SessionsGoneOn(const History& history,
                                  const data::FoundSessions& earlier,
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
      if (next - time >= history.night()) break;
      sessions[static_cast<std::size_t>(row)] = session;
      next = time;
    }
  }
  return sessions;
}

}  // namespace

EarlierRows PrependEarlier(const FittedModel& fitted,
                           const data::CsvTable& table,
                           const MapDataArguments& arguments,
                           data::FoundSessions* found,
                           MatrixXd* readings) {
  Earlier earlier = ReadEarlier(fitted, arguments, *found);
  if (earlier.found.time_column >= 0 && found->time_column >= 0 &&
      earlier.found.dated != found->dated) {
    throw data::InputError(fmt::format(
        "{}: its clock and that of {} have no common zero, since one of them "
        "has dates; give both files the same column of times",
        data::PrintablePath(earlier.file),
        data::PrintablePath(table.file)));
  }
  const std::vector<Index> sessions =
      SessionsGoneOn(*fitted.history, earlier.found, *found);
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
  return {.count = count, .remarks = std::move(earlier.remarks)};
}

}  // namespace errmap::models
