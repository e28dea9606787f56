#include "models/history/session_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Cholesky>

#include "stats/distributions.h"

namespace errmap::models {
namespace {

constexpr double kDay = 86400.0;
constexpr std::size_t kFewestSessions = 4;
constexpr double kWithin = 0.97;  // share of sound sessions within the limits

// Each reading less the mean of them all.
VectorXd Differences(const data::SessionLog& log,
                     Index row,
                     const std::vector<Index>& columns) {
  const VectorXd readings = log.input_values(row, columns);
  return readings.array() - readings.mean();
}

// How the differences of a session begin and go on.
struct Course {
  VectorXd start;
  VectorXd change;  // mean of what they are less the start
  MatrixXd spread;  // mean square of that
};

Course CourseOf(const data::SessionLog& log,
                const std::vector<Index>& rows,
                const std::vector<Index>& columns) {
  const Index size = std::ssize(columns);
  Course course{.start = Differences(log, rows.front(), columns),
                .change = VectorXd::Zero(size),
                .spread = MatrixXd::Zero(size, size)};
  double count = 0.0;
  for (const Index row : rows) {
    const VectorXd change = Differences(log, row, columns) - course.start;
    if (!change.allFinite()) continue;
    course.change += change;
    course.spread += change * change.transpose();
    ++count;
  }
  course.change /= std::max(1.0, count);
  course.spread /= std::max(1.0, count);
  return course;
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

Separation Separate(const std::vector<Course>& courses) {
  const auto count = static_cast<double>(courses.size());
  const Index size = courses.front().start.size();
  VectorXd mean = VectorXd::Zero(size);
  VectorXd change = VectorXd::Zero(size);
  MatrixXd spread = MatrixXd::Zero(size, size);
  for (const Course& course : courses) {
    mean += course.start / count;
    change += course.change / count;
    spread += course.spread / count;
  }
  MatrixXd covariance = MatrixXd::Zero(size, size);
  for (const Course& course : courses) {
    const VectorXd apart = course.start - mean;
    covariance += apart * apart.transpose() / (count - 1.0);
  }
  const VectorXd sd = covariance.diagonal().cwiseSqrt();
  // Few starts tell little of how starts scatter. How sessions go on counts as
  // one more, and no combination of columns is free of noise.
  constexpr double kNoise = 1e-3;
  covariance = (1.0 + 1.0 / count) * covariance + spread / count;
  covariance.diagonal().array() +=
      kNoise * spread.diagonal().mean() + std::numeric_limits<double>::min();
  VectorXd weight = covariance.llt().solve(change);
  const double within = weight.dot(change);
  if (within > 0.0) weight /= within;
  return {.mean = mean, .sd = sd, .weight = weight};
}

Separation SeparateWithout(std::vector<Course> courses, std::size_t left_out) {
  courses.erase(courses.begin() + static_cast<std::ptrdiff_t>(left_out));
  return Separate(courses);
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
  std::vector<Course> courses;
  for (const std::vector<Index>& rows : sessions) {
    courses.push_back(CourseOf(log, rows, columns));
    if (!courses.back().start.allFinite()) return;
  }
  double squares = 0.0;
  for (std::size_t s = 0; s < courses.size(); ++s) {
    const double score = SeparateWithout(courses, s).Score(courses[s].start);
    squares += score * score;
  }
  const auto count = static_cast<double>(courses.size());
  const double limit =
      stats::StudentQuantile(kWithin, count - 1.0) * std::sqrt(squares / count);
  const Separation all = Separate(courses);
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
  const double late = stats::StudentQuantile(kWithin, count - 1.0) *
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
