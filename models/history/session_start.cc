#include "models/history/session_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "stats/distributions.h"

namespace errmap::models {
namespace {

constexpr double kDay = 86400.0;
constexpr std::size_t kFewestSessions = 4;
// Shares of sound sessions within the limits. In 48 simulated whole days no
// readings were beyond .97, but neither were two fifths of the rows of logs
// that lack up to a tenth.
constexpr double kReadingsWithin = 0.9;
constexpr double kClockWithin = 0.97;

// Each reading less the mean of them all.
VectorXd Differences(const data::SessionLog& log,
                     Index row,
                     const std::vector<Index>& columns) {
  const VectorXd readings = log.input_values(row, columns);
  return readings.array() - readings.mean();
}

// The separation of rows within sessions from their starts.
struct Separation {
  VectorXd mean;    // (columns) at the starts
  VectorXd sd;      // (columns) likewise
  VectorXd weight;  // (columns)

  double Score(const VectorXd& differences) const {
    return weight.dot(differences - mean);
  }
};

// Separates all sessions but `left_out`; rows of `starts` and `changes` are
// sessions.
Separation Separate(const MatrixXd& starts,
                    const MatrixXd& changes,
                    Index left_out) {
  std::vector<Index> kept;
  for (Index session = 0; session < starts.rows(); ++session) {
    if (session != left_out) kept.push_back(session);
  }
  const MatrixXd of_kept = starts(kept, Eigen::all);
  Separation separation;
  separation.mean = of_kept.colwise().mean();
  const VectorXd change = changes(kept, Eigen::all).colwise().mean();
  const VectorXd variance = (of_kept.rowwise() - separation.mean.transpose())
                                .array()
                                .square()
                                .colwise()
                                .sum() /
                            static_cast<double>(kept.size() - 1);
  separation.sd = variance.cwiseSqrt();
  // Among few starts some columns seem not to differ at all.
  separation.weight = change.array() / (variance.array() + variance.mean() +
                                        std::numeric_limits<double>::min());
  const double within = separation.weight.dot(change);
  if (within > 0.0) separation.weight /= within;
  return separation;
}

void LearnReadings(const data::SessionLog& log,
                   const std::vector<std::vector<Index>>& sessions,
                   const data::Dataset& training,
                   History* history) {
  const std::vector<std::string> names = history->columns();
  std::vector<std::string> remembered;
  std::vector<Index> columns;
  for (const Index column : history->remembered()) {
    remembered.push_back(names[static_cast<std::size_t>(column)]);
    columns.push_back(training.FindInput(remembered.back()));
  }
  if (columns.size() < 2) return;
  MatrixXd starts(std::ssize(sessions), std::ssize(columns));
  MatrixXd changes(starts.rows(), starts.cols());
  for (std::size_t s = 0; s < sessions.size(); ++s) {
    const auto at = static_cast<Index>(s);
    const VectorXd start = Differences(log, sessions[s].front(), columns);
    VectorXd sum = VectorXd::Zero(start.size());
    double count = 0.0;
    for (const Index row : sessions[s]) {
      const VectorXd here = Differences(log, row, columns);
      if (!here.allFinite()) continue;
      sum += here - start;
      ++count;
    }
    starts.row(at) = start;
    changes.row(at) = sum / std::max(1.0, count);
  }
  if (!starts.allFinite() || !changes.allFinite()) return;
  double squares = 0.0;
  for (Index s = 0; s < starts.rows(); ++s) {
    const double score =
        Separate(starts, changes, s).Score(starts.row(s).transpose());
    squares += score * score;
  }
  const auto count = static_cast<double>(sessions.size());
  const double limit = stats::StudentQuantile(kReadingsWithin, count - 1.0) *
                       std::sqrt(squares / count);
  const Separation all = Separate(starts, changes, -1);
  for (std::size_t i = 0; i < remembered.size(); ++i) {
    const auto at = static_cast<Index>(i);
    history->start_readings.push_back(
        {remembered[i], all.mean[at], all.sd[at], all.weight[at]});
  }
  if (limit < 1.0) history->start_limit = limit;
}

double WithinHalfDay(double seconds) {
  return seconds - kDay * std::round(seconds / kDay);
}

void LearnClock(const data::SessionLog& log,
                const std::vector<std::vector<Index>>& sessions,
                History* history) {
  // A habit is one where sessions begin within some hours of each other.
  constexpr double kWidest = kDay / 6.0;
  if (log.time_unit != "s") return;
  std::vector<double> starts;
  for (const std::vector<Index>& rows : sessions) {
    starts.push_back(log.time[rows.front()]);
  }
  const auto [first, last] = std::ranges::minmax(starts);
  if (last - first < kDay) return;  // a clock that begins anew
  const double middle = starts.front();
  double mean = 0.0;
  for (double& start : starts) {
    start = WithinHalfDay(start - middle);
    mean += start / static_cast<double>(starts.size());
  }
  double squares = 0.0;
  for (const double start : starts) {
    squares += (start - mean) * (start - mean);
  }
  const auto count = static_cast<double>(starts.size());
  const double late = stats::StudentQuantile(kClockWithin, count - 1.0) *
                      std::sqrt(squares / (count - 1.0) * (1.0 + 1.0 / count));
  if (!(late < kWidest)) return;
  history->start_clock =
      middle + mean - kDay * std::floor((middle + mean) / kDay);
  history->start_clock_late = late;
}

}  // namespace

std::vector<std::vector<Index>> RowsOfSessions(const data::Dataset& training) {
  const data::SessionLog& log = *training.log();
  const std::vector<Index> codes = training.session_codes();
  const std::set<Index> trained(codes.begin(), codes.end());
  std::map<Index, std::vector<Index>> rows;
  Index row = 0;
  for (const Index code : log.sessions.codes) {
    if (trained.contains(code)) rows[code].push_back(row);
    ++row;
  }
  std::vector<std::vector<Index>> sessions;
  for (auto& [code, of_session] : rows) {
    sessions.push_back(std::move(of_session));
  }
  return sessions;
}

void LearnStarts(const data::Dataset& training, History* history) {
  if (training.log() == nullptr || !history->needs_sessions()) return;
  const std::vector<std::vector<Index>> sessions = RowsOfSessions(training);
  if (sessions.size() < kFewestSessions) return;
  LearnReadings(*training.log(), sessions, training, history);
  LearnClock(*training.log(), sessions, history);
}

bool BeginsInside(const data::SessionLog& log,
                  Index row,
                  const History& history) {
  const double time = log.time[row];
  // A clock that began anew in each session of training does not reach another
  // day: dates are no such clock.
  const bool is_that_clock =
      log.time_unit != "s" || time < history.latest_start + kDay;
  if (is_that_clock && time > history.latest_start) return true;
  if (log.time_unit == "s" &&
      WithinHalfDay(time - history.start_clock) > history.start_clock_late) {
    return true;
  }
  if (std::isnan(history.start_limit)) return false;
  const std::vector<std::string> names = history.columns();
  std::vector<Index> columns;
  for (const StartReading& reading : history.start_readings) {
    columns.push_back(std::ranges::find(names, reading.column) - names.begin());
  }
  const VectorXd found = Differences(log, row, columns);
  double score = 0.0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const StartReading& start = history.start_readings[i];
    score += start.weight * (found[static_cast<Index>(i)] - start.mean);
  }
  return score > history.start_limit;
}

}  // namespace errmap::models
