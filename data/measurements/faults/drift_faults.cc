#include "data/measurements/faults/drift_faults.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>

#include <Eigen/Eigenvalues>

namespace errmap::data {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// A drifting thermometer: what it reads beyond all that the others explain (by
// their first principal components) rises with the rows, by that much in all
// and by that many standard deviations about the line; where the rows are one
// session, or the others explain the time itself, nothing can be said.
constexpr Index kFewestSessions = 3;
constexpr Index kMostComponents = 5;
constexpr double kLeastDrift = 0.5;  // degC
constexpr double kDriftTimes = 10.0;
// Of 60 healthy machines that ran little a day, 5 of the 20 of four days went
// 10 to 19 times so far: four rooms are in line by chance.
constexpr Index kFewSessions = 4;
constexpr double kDriftTimesOfFew = 25.0;
constexpr double kMostScatterNoise = 8.0;  // else it goes its own ways anyhow
constexpr double kLeastTimeLeft = 0.3;     // sd of time, of that before

// Thermometers too unlike for that are held against each other where sessions
// begin: a machine that rested is as warm as its room. Of 3,600 pairs of 60
// simulated machines of 4 to 10 days none goes so far, while 0.04 degC an hour,
// nights included, are 3 degC by the fourth day.
constexpr Index kFewestStarts = 4;
constexpr double kLeastColdDrift = 2.5;  // degC
constexpr double kColdDriftTimes = 8.0;

struct Drift {
  double change = 0.0;   // from first to last row
  double scatter = 0.0;  // about the line
  double ratio() const { return std::abs(change) / scatter; }
};

// The straight line of `values` in time, which runs from -1 to 1.
Drift LineOf(const VectorXd& values, const VectorXd& time) {
  const VectorXd from_mean = time.array() - time.mean();
  const double slope = from_mean.dot(values) / from_mean.squaredNorm();
  const VectorXd rest =
      values.array() - values.mean() - slope * from_mean.array();
  return {
      .change = 2.0 * slope,
      .scatter = rest.norm() / std::sqrt(static_cast<double>(rest.size() - 2))};
}

bool IsTrusted(Index input, const std::vector<ColumnFault>& known) {
  return std::ranges::none_of(known, [&](const ColumnFault& fault) {
    return fault.input == input && !fault.of_cells;
  });
}

// Of column `j` by the covariance of the columns `used` and of time (last).
std::optional<Drift> DriftOf(const Eigen::MatrixXd& covariance,
                             const std::vector<Index>& used,
                             Index j) {
  std::vector<Index> others;
  std::ranges::copy_if(
      used, std::back_inserter(others), [&](Index k) { return k != j; });
  const VectorXd scale = covariance.diagonal()(others).array().sqrt().inverse();
  const Eigen::MatrixXd correlation =
      scale.asDiagonal() * covariance(others, others) * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(correlation);
  const Index time = covariance.rows() - 1;
  const VectorXd with_j = scale.asDiagonal() * covariance(others, j);
  const VectorXd with_time = scale.asDiagonal() * covariance(others, time);
  double var_j = covariance(j, j);
  double var_time = covariance(time, time);
  double joint = covariance(j, time);
  const auto num_others = static_cast<Index>(others.size());
  for (Index k = 0; k < std::min(kMostComponents, num_others); ++k) {
    const Index at = num_others - 1 - k;  // largest last
    const double variance = axes.eigenvalues()[at];
    const double a = axes.eigenvectors().col(at).dot(with_j);
    const double b = axes.eigenvectors().col(at).dot(with_time);
    if (!(variance > 1e-9)) break;
    var_j -= a * a / variance;
    var_time -= b * b / variance;
    joint -= a * b / variance;
  }
  if (!(var_time > kLeastTimeLeft * kLeastTimeLeft * covariance(time, time))) {
    return std::nullopt;
  }
  const double slope = joint / var_time;
  return Drift{.change = 2.0 * slope,  // time runs from -1 to 1
               .scatter = std::sqrt(
                   std::max(var_j - slope * joint, 1e-12 * covariance(j, j)))};
}

// Of the thermometers and of the row number from -1 to 1, over the rows in
// which all of them have a sound value.
Eigen::MatrixXd CovarianceWithTime(
    const MeasuredColumns& measured,
    const std::vector<Thermometer>& thermometers) {
  const Index m = measured.target_values.size();
  std::vector<bool> is_sound(static_cast<std::size_t>(m), true);
  for (const Thermometer& t : thermometers) {
    for (const Index row : t.wrong) {
      is_sound[static_cast<std::size_t>(row)] = false;
    }
  }
  const auto size = static_cast<Index>(thermometers.size());
  VectorXd sum = VectorXd::Zero(size + 1);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(size + 1, size + 1);
  VectorXd row_values(size + 1);
  double count = 0.0;
  for (Index row = 0; row < m; ++row) {
    if (!is_sound[static_cast<std::size_t>(row)]) continue;
    for (Index k = 0; k < size; ++k) {
      const Index input = thermometers[static_cast<std::size_t>(k)].input;
      row_values[k] =
          measured.input_values(row, input) - measured.input_values(0, input);
    }
    row_values[size] = 2.0 * static_cast<double>(row) /
                           static_cast<double>(std::max<Index>(m - 1, 1)) -
                       1.0;
    sum += row_values;
    products.selfadjointView<Eigen::Lower>().rankUpdate(row_values);
    count += 1.0;
  }
  if (count < 1.0) return Eigen::MatrixXd::Zero(size + 1, size + 1);
  const VectorXd mean = sum / count;
  const Eigen::MatrixXd full = products.selfadjointView<Eigen::Lower>();
  return full / count - mean * mean.transpose();
}

}  // namespace

std::vector<ColumnFault> FindDrift(const MeasuredColumns& measured,
                                   const std::vector<Thermometer>& thermometers,
                                   const std::vector<ColumnFault>& known) {
  std::vector<ColumnFault> faults;
  if (measured.num_sessions < kFewestSessions) return faults;
  std::vector<Index> used;  // places among the thermometers
  for (std::size_t k = 0; k < thermometers.size(); ++k) {
    if (IsTrusted(thermometers[k].input, known)) {
      used.push_back(static_cast<Index>(k));
    }
  }
  const Eigen::MatrixXd covariance = CovarianceWithTime(measured, thermometers);
  // Few thermometers agree less: rooms of three days are in line by chance.
  const std::size_t fewest =
      measured.num_sessions > kFewestSessions ? 1 : kFewestOthers;
  const double times =
      measured.num_sessions > kFewSessions ? kDriftTimes : kDriftTimesOfFew;
  // The worst first: it no longer counts among the others then.
  while (used.size() > fewest) {
    Drift worst{.change = 0.0, .scatter = 1.0};
    Index worst_at = -1;
    for (const Index k : used) {
      const std::optional<Drift> drift = DriftOf(covariance, used, k);
      const Thermometer& t = thermometers[static_cast<std::size_t>(k)];
      if (!drift || std::abs(drift->change) < kLeastDrift * t.degree ||
          drift->scatter > kMostScatterNoise * t.noise ||
          drift->ratio() < times || drift->ratio() < worst.ratio()) {
        continue;
      }
      worst = *drift;
      worst_at = k;
    }
    if (worst_at < 0) break;
    faults.push_back(
        MakeFault(measured,
                  FaultKind::kDrifting,
                  thermometers[static_cast<std::size_t>(worst_at)].input,
                  {},
                  worst.change,
                  {static_cast<double>(used.size() - 1), worst.scatter}));
    std::erase(used, worst_at);
  }
  return faults;
}

std::optional<ColumnFault> FindColdDrift(
    const MeasuredColumns& measured,
    const std::vector<Index>& session_starts,
    const std::vector<ColumnFault>& known) {
  const Unit degc = UnitOfSymbol("degC");
  std::vector<Index> used;
  for (Index k = 0; k < measured.input_values.cols(); ++k) {
    const Unit& unit = measured.inputs[static_cast<std::size_t>(k)].unit;
    if (unit.quantity == degc.quantity && IsTrusted(k, known)) {
      used.push_back(k);
    }
  }
  const auto num_starts = static_cast<Index>(session_starts.size());
  const auto num_others = static_cast<Index>(used.size()) - 1;
  if (num_starts < kFewestStarts || num_others < 1) return std::nullopt;
  Eigen::MatrixXd cold(num_starts, num_others + 1);  // degC
  for (Index k = 0; k <= num_others; ++k) {
    const Index input = used[static_cast<std::size_t>(k)];
    const Unit& unit = measured.inputs[static_cast<std::size_t>(input)].unit;
    for (Index i = 0; i < num_starts; ++i) {
      cold(i, k) =
          Converted(measured.input_values(
                        session_starts[static_cast<std::size_t>(i)], input),
                    unit,
                    degc);
    }
  }
  VectorXd time(num_starts);
  const auto first = static_cast<double>(session_starts.front());
  const auto last = static_cast<double>(session_starts.back());
  for (Index i = 0; i < num_starts; ++i) {
    const auto start =
        static_cast<double>(session_starts[static_cast<std::size_t>(i)]);
    time[i] = (2.0 * start - first - last) / (last - first);
  }
  Drift worst{.change = 0.0, .scatter = 1.0};
  Index worst_at = -1;
  double own = 0.0;
  for (Index k = 0; k <= num_others; ++k) {
    const VectorXd others =
        (cold.rowwise().sum() - cold.col(k)) / static_cast<double>(num_others);
    const Drift drift = LineOf(cold.col(k) - others, time);
    if (!(std::abs(drift.change) >= kLeastColdDrift &&
          drift.ratio() >= kColdDriftTimes)) {
      continue;
    }
    // The one that drifts leaves the others most; of two, which leave each
    // other alike, it changes more.
    const double change = std::abs(
        num_others == 1 ? LineOf(cold.col(k), time).change : drift.change);
    if (change < own) continue;
    own = change;
    worst = drift;
    worst_at = used[static_cast<std::size_t>(k)];
  }
  if (worst_at < 0) return std::nullopt;
  const double degree =
      Converted(
          1.0, degc, measured.inputs[static_cast<std::size_t>(worst_at)].unit) -
      Converted(
          0.0, degc, measured.inputs[static_cast<std::size_t>(worst_at)].unit);
  return MakeFault(measured,
                   FaultKind::kDrifting,
                   worst_at,
                   {},
                   degree * worst.change,
                   {static_cast<double>(num_others), degree * worst.scatter});
}

}  // namespace errmap::data
