#include "data/measurements/drift_faults.h"

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
constexpr double kMostScatterNoise = 8.0;  // else it goes its own ways anyhow
constexpr double kLeastTimeLeft = 0.3;     // sd of time, of that before

struct Drift {
  double change = 0.0;   // from first to last row
  double scatter = 0.0;  // about the line
  double ratio() const { return std::abs(change) / scatter; }
};

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
    const bool is_bad = std::ranges::any_of(known, [&](const auto& fault) {
      return fault.input == thermometers[k].input && !fault.of_cells;
    });
    if (!is_bad) used.push_back(static_cast<Index>(k));
  }
  const Eigen::MatrixXd covariance = CovarianceWithTime(measured, thermometers);
  // Few thermometers agree less: rooms of three days are in line by chance.
  const std::size_t fewest =
      measured.num_sessions > kFewestSessions ? 1 : kFewestOthers;
  // The worst first: it no longer counts among the others then.
  while (used.size() > fewest) {
    Drift worst{.change = 0.0, .scatter = 1.0};
    Index worst_at = -1;
    for (const Index k : used) {
      const std::optional<Drift> drift = DriftOf(covariance, used, k);
      const Thermometer& t = thermometers[static_cast<std::size_t>(k)];
      if (!drift || std::abs(drift->change) < kLeastDrift * t.degree ||
          drift->scatter > kMostScatterNoise * t.noise ||
          drift->ratio() < kDriftTimes || drift->ratio() < worst.ratio()) {
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

}  // namespace errmap::data
