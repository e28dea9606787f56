#include "models/kinematics/volumetric.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "stats/distributions.h"
#include "stats/random.h"
#include "stats/summary.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixX3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void Refuse(const std::string& what) {
  throw std::invalid_argument("CombineErrors: " + what);
}

void CheckShapes(const KinematicChain& chain,
                 const MatrixXd& coordinates,
                 const std::vector<ComponentAtPoints>& components) {
  const auto check = [](const std::string& what, Index found, Index expected) {
    if (found == expected) return;
    Refuse(std::to_string(found) + " " + what + ", expected " +
           std::to_string(expected));
  };
  check("columns of coordinates", coordinates.cols(), chain.num_coordinates());
  check(
      "components", static_cast<Index>(components.size()), chain.num_errors());
  for (const ComponentAtPoints& component : components) {
    check("values of a component", component.values.size(), coordinates.rows());
    check("half-widths of a component",
          component.half_widths.size(),
          coordinates.rows());
  }
}

// Standard normal deviates (errors x draws).
MatrixXd Deviates(Index num_errors, const VolumetricOptions& options) {
  stats::Random random(options.seed);
  MatrixXd deviates(num_errors, options.draws);
  for (double& deviate : deviates.reshaped()) {
    // Never 0, as Uniform may be.
    constexpr double kHalfStep = 0x1.0p-54;
    deviate = stats::NormalQuantile(random.Uniform() + kHalfStep);
  }
  return deviates;
}

// Of the errors of one point.
struct Point {
  VectorXd coordinates;
  VectorXd errors;
  VectorXd half_widths;
};

Point PointOf(const MatrixXd& coordinates,
              const std::vector<ComponentAtPoints>& components,
              Index row) {
  const auto n = static_cast<Index>(components.size());
  Point point{coordinates.row(row), VectorXd(n), VectorXd(n)};
  for (Index k = 0; k < n; ++k) {
    const ComponentAtPoints& component =
        components[static_cast<std::size_t>(k)];
    point.errors[k] = component.values[row];
    point.half_widths[k] = component.half_widths[row];
  }
  return point;
}

// Root of the sum of squares along each direction; an error without effect
// there need not be known.
Vector3d FirstOrderHalfWidths(const Matrix3Xd& sensitivities,
                              const VectorXd& half_widths) {
  Vector3d sum = Vector3d::Zero();
  for (Index k = 0; k < half_widths.size(); ++k) {
    for (Index d = 0; d < 3; ++d) {
      if (sensitivities(d, k) == 0.0) continue;
      const double part = sensitivities(d, k) * half_widths[k];
      sum[d] += part * part;
    }
  }
  return sum.cwiseSqrt();
}

// Draws of the exact error (3 x draws), each direction ascending. What is not
// known does not vary.
Matrix3Xd SortedDraws(const KinematicChain& chain,
                      const Point& point,
                      const MatrixXd& deviates,
                      double deviates_per_half_width) {
  const VectorXd spread = point.half_widths.unaryExpr([](double h) {
    return std::isnan(h) ? 0.0 : h;
  }) / deviates_per_half_width;
  MatrixXd by_direction(deviates.cols(), 3);
  for (Index draw = 0; draw < deviates.cols(); ++draw) {
    by_direction.row(draw) = chain.ExactError(
        point.coordinates,
        point.errors + spread.cwiseProduct(deviates.col(draw)));
  }
  for (auto column : by_direction.colwise()) std::ranges::sort(column);
  return by_direction.transpose();
}

}  // namespace

void VolumetricOptions::Validate() const {
  if (!(coverage > 0.0 && coverage < 1.0)) {
    throw std::invalid_argument("coverage " + std::to_string(coverage) +
                                ": give a share between 0 and 1");
  }
  constexpr Index kMostDraws = 1'000'000;
  if (draws < 0 || draws > kMostDraws) {
    throw std::invalid_argument("draws " + std::to_string(draws) +
                                ": give a whole number from 0 to " +
                                std::to_string(kMostDraws));
  }
}

double VolumetricErrors::LargestDifference() const {
  return exact.rows() == 0 ? 0.0
                           : (exact - first_order).rowwise().norm().maxCoeff();
}

VolumetricErrors CombineErrors(const KinematicChain& chain,
                               const MatrixXd& coordinates,
                               const std::vector<ComponentAtPoints>& components,
                               const VolumetricOptions& options) {
  options.Validate();
  CheckShapes(chain, coordinates, components);
  const Index m = coordinates.rows();
  const double tail = 0.5 * (1.0 - options.coverage);
  const double deviates_per_half_width = stats::NormalQuantile(1.0 - tail);
  const MatrixXd deviates = Deviates(chain.num_errors(), options);

  VolumetricErrors result;
  for (MatrixX3d* part :
       {&result.exact, &result.first_order, &result.half_widths}) {
    part->resize(m, 3);
  }
  result.lower = MatrixX3d::Constant(m, 3, kNaN);
  result.upper = result.lower;
  result.contributions.assign(components.size(), MatrixX3d(m, 3));
  for (Index row = 0; row < m; ++row) {
    const Point point = PointOf(coordinates, components, row);
    const Matrix3Xd sensitivities = chain.Sensitivities(point.coordinates);
    result.exact.row(row) = chain.ExactError(point.coordinates, point.errors);
    result.first_order.row(row) = sensitivities * point.errors;
    for (Index k = 0; k < chain.num_errors(); ++k) {
      result.contributions[static_cast<std::size_t>(k)].row(row) =
          sensitivities.col(k) * point.errors[k];
    }
    const Vector3d half_widths =
        FirstOrderHalfWidths(sensitivities, point.half_widths);
    result.half_widths.row(row) = half_widths;
    if (options.draws == 0) continue;
    const Matrix3Xd sorted =
        SortedDraws(chain, point, deviates, deviates_per_half_width);
    for (Index d = 0; d < 3; ++d) {
      if (std::isnan(half_widths[d])) continue;
      const VectorXd ascending = sorted.row(d);
      result.lower(row, d) = stats::Quantile(ascending, tail);
      result.upper(row, d) = stats::Quantile(ascending, 1.0 - tail);
    }
  }
  return result;
}

}  // namespace errmap::models
