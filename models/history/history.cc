#include "models/history/history.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/csv.h"
#include "data/measurements/clock/time_units.h"
#include "data/measurements/reading/nights.h"
#include "data/text.h"
#include "models/history/history_state.h"
#include "models/history/session_start.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

// Inputs of the form in every row of a table, and their columns.
struct Derived {
  std::vector<data::ColumnInfo> columns;
  MatrixXd values;
};

std::vector<Index> FindColumns(const data::Dataset& dataset,
                               const std::vector<std::string>& names) {
  std::vector<Index> columns;
  for (const std::string& name : names) {
    columns.push_back(dataset.FindInput(name));
    if (columns.back() >= 0) continue;
    throw std::invalid_argument(
        fmt::format("the map reads input '{}', which {} does not have",
                    name,
                    dataset.source()));
  }
  return columns;
}

std::vector<data::ColumnInfo> InfoOf(const data::Dataset& dataset,
                                     const std::vector<Index>& columns) {
  std::vector<data::ColumnInfo> info;
  for (const Index column : columns) {
    info.push_back(dataset.inputs()[static_cast<std::size_t>(column)]);
  }
  return info;
}

double StepOf(const data::SessionLog& log) {
  std::vector<double> steps;
  for (const std::vector<Index>& rows :
       stats::IndicesByCode(log.sessions.codes)) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
      steps.push_back(log.time[rows[i]] - log.time[rows[i - 1]]);
    }
  }
  return data::MedianStep(std::move(steps));
}

Derived DeriveLog(const data::SessionLog& log,
                  const std::vector<Index>& log_rows,
                  const std::vector<Index>& columns,
                  HistoryState state) {
  // Index in the result of each row of the log; most views are large.
  std::vector<Index> place(static_cast<std::size_t>(log.time.size()), -1);
  std::vector<std::pair<Index, Index>> again;  // rows that stand there twice
  for (std::size_t i = 0; i < log_rows.size(); ++i) {
    Index& to = place[static_cast<std::size_t>(log_rows[i])];
    if (to >= 0) again.emplace_back(static_cast<Index>(i), to);
    to = static_cast<Index>(i);
  }
  MatrixXd derived(std::ssize(log_rows), std::ssize(state.form_columns()));
  VectorXd reading(std::ssize(columns));
  const std::vector<std::vector<Index>> sessions =
      stats::IndicesByCode(log.sessions.codes);
  for (std::size_t s = 0; s < sessions.size(); ++s) {
    Index before = -1;
    for (const Index row : sessions[s]) {
      reading = log.input_values(row, columns);
      if (before < 0) {
        state.Start(reading);
      } else {
        state.Step(log.time[row] - log.time[before], reading);
      }
      if (row == log.first_rows[s] && before >= 0) state.TakeZero();
      const Index to = place[static_cast<std::size_t>(row)];
      if (to >= 0) derived.row(to) = state.form_inputs();
      before = row;
    }
  }
  // Backwards: of three the last was written.
  for (auto pair = again.rbegin(); pair != again.rend(); ++pair) {
    derived.row(pair->second) = derived.row(pair->first);
  }
  return {state.form_columns(), std::move(derived)};
}

// Angles alone need no log: any row by itself will do.
Derived DeriveRows(const data::Dataset& dataset,
                   const std::vector<Index>& columns,
                   HistoryState state) {
  const MatrixXd readings =
      dataset.input_values()(Eigen::all, columns).transpose();
  MatrixXd derived(dataset.num_rows(), std::ssize(state.form_columns()));
  for (Index row = 0; row < derived.rows(); ++row) {
    state.Start(readings.col(row));
    derived.row(row) = state.form_inputs().transpose();
  }
  return {state.form_columns(), std::move(derived)};
}

void RequireLog(const data::Dataset& dataset, const History& history) {
  if (!history.needs_sessions()) return;
  if (dataset.log() == nullptr) {
    throw std::invalid_argument(fmt::format(
        "the map has a memory, and the sessions of {} are not known",
        dataset.source()));
  }
  if (dataset.log()->input_values.size() == 0) {
    throw std::invalid_argument("the inputs of " + dataset.source() +
                                " are derived already");
  }
  const std::string& unit = dataset.log()->time_unit;
  if (history.needs_time() && unit != history.time_unit) {
    throw std::invalid_argument(
        fmt::format("the map's filters run in {}, and the time of {} is in {}",
                    history.time_unit,
                    dataset.source(),
                    unit));
  }
}

// Derives every row, through the log if there is one.
Derived Derive(const data::Dataset& dataset, const History& history) {
  RequireLog(dataset, history);
  const std::vector<Index> columns = FindColumns(dataset, history.columns());
  HistoryState state(history, InfoOf(dataset, columns));
  return dataset.log() != nullptr
             ? DeriveLog(*dataset.log(),
                         dataset.log_rows(),
                         columns,
                         std::move(state))
             : DeriveRows(dataset, columns, std::move(state));
}

// Distance between readings if it exceeds what filters bridge; else 0.
class StepsApart {
 public:
  StepsApart(const data::SessionLog& log, const History& history)
      : log_(log),
        changes_(history.row_changes),
        longest_(history.longest_bridged()),
        in_rows_(history.time_unit == "rows") {
    const std::vector<std::string> names = history.columns();
    for (const RowChange& change : changes_) {
      columns_.push_back(std::ranges::find(names, change.column) -
                         names.begin());
    }
  }

  double Between(Index before, Index row) const {
    if (!in_rows_) {
      const double step = log_.time[row] - log_.time[before];
      return step > longest_ ? step : 0.0;
    }
    constexpr double kLeap = 2.0;
    double most = 0.0;
    for (std::size_t i = 0; i < changes_.size(); ++i) {
      const double change = std::fabs(log_.input_values(row, columns_[i]) -
                                      log_.input_values(before, columns_[i]));
      if (change > kLeap * changes_[i].largest) {
        most = std::max(most, change / changes_[i].mean);
      }
    }
    return most;
  }

 private:
  const data::SessionLog& log_;
  const std::vector<RowChange>& changes_;
  std::vector<Index> columns_;
  double longest_ = 0.0;
  bool in_rows_ = false;
};

DerivedInput Unitless(const data::ColumnInfo& of,
                      const char* name,
                      Filter filter) {
  return {
      .column = {fmt::format("{}({})", name, of.name), data::UnitOfSymbol("")},
      .of = of.name,
      .filter = filter};
}

}  // namespace

std::string_view ToString(Filter filter) {
  constexpr auto kNames =
      std::to_array<std::string_view>({"ema", "zero", "sine", "cosine"});
  return data::NameOf(kNames, filter);
}

bool RunsInTime(Filter filter) {
  switch (filter) {
    case Filter::kEma:
      return true;
    case Filter::kZero:
    case Filter::kSine:
    case Filter::kCosine:
      break;
  }
  return false;
}

bool Remembers(Filter filter) {
  return RunsInTime(filter) || filter == Filter::kZero;
}

std::string_view ToString(Between between) {
  return between == Between::kLinear ? "linear" : "held";
}

std::string History::RootOf(std::string name) const {
  // Backwards, since each derived input builds on earlier ones only.
  for (auto input = derived.rbegin(); input != derived.rend(); ++input) {
    if (input->column.name == name) name = input->of;
  }
  return name;
}

double History::longest_bridged() const {
  constexpr double kStepsOfTraining = 2.0;
  constexpr double kTimeConstants = 3.0;
  double shortest_tau = std::numeric_limits<double>::infinity();
  for (const DerivedInput& input : derived) {
    if (RunsInTime(input.filter)) {
      shortest_tau = std::min(shortest_tau, input.tau);
    }
  }
  return std::isfinite(longest_step) ? std::max(kStepsOfTraining * longest_step,
                                                kTimeConstants * shortest_tau)
                                     : std::numeric_limits<double>::infinity();
}

double History::settles_after() const {
  std::map<std::string, double> after;  // of derived inputs
  double longest = 0.0;
  for (const DerivedInput& input : derived) {
    double& own = after[input.column.name];
    own = after.contains(input.of) ? after.at(input.of) : 0.0;
    if (RunsInTime(input.filter)) own += kSettledTaus * input.tau;
    if (input.filter == Filter::kZero) {
      own = std::numeric_limits<double>::infinity();
    }
    longest = std::max(longest, own);
  }
  return longest;
}

double History::night() const { return gap > 0.0 ? gap : data::kShortestNight; }

bool History::needs_time() const {
  return std::ranges::any_of(derived, RunsInTime, &DerivedInput::filter);
}

bool History::needs_sessions() const {
  return std::ranges::any_of(derived, Remembers, &DerivedInput::filter);
}

std::vector<std::string> History::columns() const {
  std::vector<std::string> names;
  const auto add_root = [&](const std::string& name) {
    const std::string root = RootOf(name);
    if (std::ranges::find(names, root) == names.end()) names.push_back(root);
  };
  for (const std::string& name : form_inputs) add_root(name);
  for (const DerivedInput& input : derived) add_root(input.of);
  return names;
}

std::vector<Index> History::remembered() const {
  const std::vector<std::string> names = columns();
  std::set<Index> found;
  for (const DerivedInput& input : derived) {
    if (!Remembers(input.filter)) continue;
    found.insert(std::ranges::find(names, RootOf(input.of)) - names.begin());
  }
  return {found.begin(), found.end()};
}

DerivedInput Ema(const data::ColumnInfo& of,
                 double tau,
                 const std::string& time_unit) {
  return {
      .column = {fmt::format(
                     "ema({},{}{})", of.name, data::CsvNumber(tau), time_unit),
                 of.unit},
      .of = of.name,
      .filter = Filter::kEma,
      .tau = tau};
}

DerivedInput Zeroed(const data::ColumnInfo& of) {
  return {.column = {fmt::format("zeroed({})", of.name), of.unit},
          .of = of.name,
          .filter = Filter::kZero};
}

double RadiansPer(const data::ColumnInfo& angle) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  constexpr double kArcMinutesPerDegree = 60.0;
  constexpr double kArcSecondsPerDegree = 3600.0;
  const std::string& unit = angle.unit.symbol;
  if (unit == "rad") return 1.0;
  if (unit == "mrad") return 1e-3;
  if (unit == "urad") return 1e-6;
  if (unit == "deg") return kDegree;
  if (unit == "arcmin") return kDegree / kArcMinutesPerDegree;
  if (unit == "arcsec") return kDegree / kArcSecondsPerDegree;
  throw std::invalid_argument(fmt::format(
      "'{}' is not an angle in rad, mrad, urad, deg, arcmin or arcsec",
      angle.name));
}

DerivedInput SineOf(const data::ColumnInfo& angle) {
  return Unitless(angle, "sin", Filter::kSine);
}

DerivedInput CosineOf(const data::ColumnInfo& angle) {
  return Unitless(angle, "cos", Filter::kCosine);
}

double LatestStart(const data::Dataset& training) {
  if (training.log() == nullptr) return stats::kNaN;
  const data::SessionLog& log = *training.log();
  double earliest = std::numeric_limits<double>::infinity();
  double latest = -earliest;
  for (const std::vector<Index>& rows : RowsOfSessions(training)) {
    earliest = std::min(earliest, log.time[rows.front()]);
    latest = std::max(latest, log.time[rows.front()]);
  }
  const double step = StepOf(log);
  // Of the training rows: those of a few probes lie far apart.
  constexpr double kLateSteps = 5.0;
  return latest - earliest <= data::kLeapSteps * step
             ? latest + kLateSteps * step
             : stats::kNaN;
}

std::vector<RowChange> RowChanges(const data::Dataset& training,
                                  const History& history) {
  std::vector<RowChange> changes;
  if (history.time_unit != "rows" || training.log() == nullptr) return changes;
  const data::SessionLog& log = *training.log();
  const std::vector<std::vector<Index>> sessions = RowsOfSessions(training);
  for (const std::string& name : history.columns()) {
    const bool is_filtered =
        std::ranges::any_of(history.derived, [&](const DerivedInput& input) {
          return RunsInTime(input.filter) && input.of == name;
        });
    if (!is_filtered) continue;
    const auto column = log.input_values.col(training.FindInput(name));
    double largest = 0.0;
    double sum = 0.0;
    Index steps = 0;
    for (const std::vector<Index>& rows : sessions) {
      for (std::size_t i = 1; i < rows.size(); ++i) {
        const double change = std::fabs(column[rows[i]] - column[rows[i - 1]]);
        if (std::isnan(change)) continue;
        largest = std::max(largest, change);
        sum += change;
        ++steps;
      }
    }
    if (largest > 0.0) {
      changes.push_back({name, largest, sum / static_cast<double>(steps)});
    }
  }
  return changes;
}

double LongestStep(const data::Dataset& training) {
  if (training.log() == nullptr) return stats::kNaN;
  const data::SessionLog& log = *training.log();
  double longest = 0.0;
  for (const std::vector<Index>& rows : RowsOfSessions(training)) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
      longest = std::max(longest, log.time[rows[i]] - log.time[rows[i - 1]]);
    }
  }
  return longest;
}

std::vector<Missing> FindMissing(const data::SessionLog& log,
                                 const History& history,
                                 bool from_rest) {
  const StepsApart steps(log, history);
  std::vector<Missing> missing(log.sessions.codes.size(), Missing::kNothing);
  for (const std::vector<Index>& rows :
       stats::IndicesByCode(log.sessions.codes)) {
    if (rows.empty()) continue;
    const bool begins_inside =
        !from_rest && BeginsInside(log, rows.front(), history);
    double known_again = log.time[rows.front()];
    double settled = known_again;
    if (begins_inside) settled += history.settles_after();
    Index before = rows.front();
    for (const Index row : rows) {
      const double now = log.time[row];
      const double apart = steps.Between(before, row);
      if (apart > 0.0) {
        known_again = now + apart;
        if (now < settled) settled = std::max(settled, known_again);
      }
      before = row;
      Missing& here = missing[static_cast<std::size_t>(row)];
      if (now < settled) {
        here = Missing::kStart;
      } else if (now < known_again) {
        here = Missing::kReadings;
      }
    }
  }
  return missing;
}

MatrixXd DeriveInputs(const data::Dataset& dataset, const History& history) {
  return Derive(dataset, history).values;
}

data::Dataset DeriveDataset(const data::Dataset& dataset,
                            const History& history) {
  Derived derived = Derive(dataset, history);
  data::Dataset made =
      dataset.WithInputs(std::move(derived.columns), std::move(derived.values));
  if (dataset.log() == nullptr) return made;
  // Derived inputs are not derived again; only sessions and times are needed.
  auto log = std::make_shared<data::SessionLog>();
  log->sessions = dataset.log()->sessions;
  log->first_rows = dataset.log()->first_rows;
  log->time = dataset.log()->time;
  log->time_unit = dataset.log()->time_unit;
  log->time_column = dataset.log()->time_column;
  return made.WithLog(std::move(log), dataset.log_rows());
}

}  // namespace errmap::models
