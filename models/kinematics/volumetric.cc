#include "models/kinematics/volumetric.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "stats/distributions.h"
#include "stats/not_a_number.h"
#include "stats/random.h"
#include "stats/satterthwaite_dof.h"
#include "stats/summary.h"

namespace errmap::models {
namespace {

using Eigen::Matrix3Xd;
using Eigen::MatrixX3d;
using Eigen::Vector3d;
[[noreturn]] void RefuseVolumetric(const std::string& what) {
  throw std::invalid_argument("CombineErrors: " + what);
}

void CheckShapes(const KinematicChain& chain,
                 const MatrixXd& coordinates,
                 const std::vector<ComponentAtPoints>& components) {
  const auto check = [](const std::string& what, Index found, Index expected) {
    if (found == expected) return;
    RefuseVolumetric(std::to_string(found) + " " + what + ", expected " +
                     std::to_string(expected));
  };
  check("columns of coordinates", coordinates.cols(), chain.num_coordinates());
  check("components", std::ssize(components), chain.num_errors());
  for (const ComponentAtPoints& component : components) {
    check("values of a component", component.values.size(), coordinates.rows());
    check("half-widths of a component",
          component.half_widths.size(),
          coordinates.rows());
  }
}

// Of Student's t; normal where the degrees of freedom are infinite.
double TQuantile(double p, double degrees_of_freedom) {
  return std::isinf(degrees_of_freedom)
             ? stats::NormalQuantile(p)
             : stats::StudentQuantile(p, degrees_of_freedom);
}

// Deviates of each component's t (errors x draws), column by column.
MatrixXd Deviates(const VectorXd& degrees_of_freedom,
                  const VolumetricOptions& options) {
  stats::Random random(options.seed);
  MatrixXd deviates(degrees_of_freedom.size(), options.draws);
  for (Index draw = 0; draw < deviates.cols(); ++draw) {
    for (Index k = 0; k < deviates.rows(); ++k) {
      deviates(k, draw) =
          TQuantile(random.OpenUniform(), degrees_of_freedom[k]);
    }
  }
  return deviates;
}

// What of the components is the same at all points.
struct Spreads {
  VectorXd degrees_of_freedom;
  VectorXd deviations_per_half_width;
  double upper = 0.0;   // the share below the interval's upper end
  double normal = 0.0;  // its quantile, where deviations are known

  Spreads(const std::vector<ComponentAtPoints>& components, double coverage)
      : degrees_of_freedom(std::ssize(components)),
        deviations_per_half_width(degrees_of_freedom.size()),
        upper(0.5 * (1.0 + coverage)),
        normal(stats::NormalQuantile(upper)) {
    for (Index k = 0; k < degrees_of_freedom.size(); ++k) {
      degrees_of_freedom[k] =
          components[static_cast<std::size_t>(k)].degrees_of_freedom;
      deviations_per_half_width[k] =
          1.0 / TQuantile(upper, degrees_of_freedom[k]);
    }
  }
};

// Of the errors of one point.
struct Point {
  VectorXd coordinates;
  VectorXd errors;
  VectorXd half_widths;
};

Point PointOf(const MatrixXd& coordinates,
              const std::vector<ComponentAtPoints>& components,
              Index row) {
  const auto n = std::ssize(components);
  Point point{coordinates.row(row), VectorXd(n), VectorXd(n)};
  for (Index k = 0; k < n; ++k) {
    const ComponentAtPoints& component =
        components[static_cast<std::size_t>(k)];
    point.errors[k] = component.values[row];
    point.half_widths[k] = component.half_widths[row];
  }
  return point;
}

// Along each direction; an error without effect there need not be known.
Vector3d FirstOrderHalfWidths(const Matrix3Xd& sensitivities,
                              const VectorXd& deviations,
                              const Spreads& spreads) {
  Vector3d half_widths;
  for (Index d = 0; d < 3; ++d) {
    double variance = 0.0;
    double spread_of_it = 0.0;
    for (Index k = 0; k < deviations.size(); ++k) {
      if (sensitivities(d, k) == 0.0) continue;
      const double part = std::pow(sensitivities(d, k) * deviations[k], 2);
      variance += part;
      spread_of_it += part * part / spreads.degrees_of_freedom[k];
    }
    // NaN stays.
    half_widths[d] =
        std::sqrt(variance) *
        (spread_of_it > 0.0
             ? TQuantile(spreads.upper, variance * variance / spread_of_it)
             : spreads.normal);
  }
  return half_widths;
}

// Draws of the exact error (3 x draws), each direction ascending. What is not
// known does not vary.
Matrix3Xd SortedDraws(const KinematicChain& chain,
                      const Point& point,
                      const VectorXd& deviations,
                      const MatrixXd& deviates) {
  const VectorXd spread =
      deviations.unaryExpr([](double s) { return std::isnan(s) ? 0.0 : s; });
  MatrixXd by_direction(deviates.cols(), 3);
  for (Index draw = 0; draw < deviates.cols(); ++draw) {
    by_direction.row(draw) = chain.ExactError(
        point.coordinates,
        point.errors + spread.cwiseProduct(deviates.col(draw)));
  }
  for (auto column : by_direction.colwise()) std::ranges::sort(column);
  return by_direction.transpose();
}

using Eigen::MatrixX3d;
void CheckSpread(const std::vector<HeldOutToolTip>& sessions, double coverage) {
  if (sessions.size() < 2 || !(coverage > 0.0 && coverage < 1.0)) {
    throw std::invalid_argument(
        "ToolTipHalfWidths: needs two sessions and a coverage between 0 and 1");
  }
  for (const HeldOutToolTip& session : sessions) {
    if (session.errors.rows() == 0 ||
        session.errors.rows() != session.half_widths.rows()) {
      throw std::invalid_argument(
          "ToolTipHalfWidths: errors and half-widths of a session differ in "
          "number, or there are none");
    }
  }
}

bool IsKnown(const MatrixX3d& half_widths, Index direction) {
  return (half_widths.col(direction).array() > 0.0).all() &&
         half_widths.col(direction).allFinite();
}

// Student's t times the root of the mean of the sessions' `mean_squares`.
double Spread(const VectorXd& mean_squares, double coverage) {
  return std::sqrt(mean_squares.mean()) *
         stats::StudentQuantile(0.5 * (1.0 + coverage),
                                stats::SatterthwaiteDof(mean_squares));
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

VolumetricErrors CombineErrors(const KinematicChain& chain,
                               const MatrixXd& coordinates,
                               const std::vector<ComponentAtPoints>& components,
                               const VolumetricOptions& options) {
  options.Validate();
  CheckShapes(chain, coordinates, components);
  const Index m = coordinates.rows();
  const double tail = 0.5 * (1.0 - options.coverage);
  const Spreads spreads(components, options.coverage);
  const MatrixXd deviates = Deviates(spreads.degrees_of_freedom, options);

  VolumetricErrors result;
  for (MatrixX3d* part :
       {&result.exact, &result.first_order, &result.half_widths}) {
    part->resize(m, 3);
  }
  result.lower = MatrixX3d::Constant(m, 3, stats::kNaN);
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
    const VectorXd deviations =
        point.half_widths.cwiseProduct(spreads.deviations_per_half_width);
    const Vector3d half_widths =
        FirstOrderHalfWidths(sensitivities, deviations, spreads);
    result.half_widths.row(row) = half_widths;
    if (options.draws == 0) continue;
    const Matrix3Xd sorted = SortedDraws(chain, point, deviations, deviates);
    for (Index d = 0; d < 3; ++d) {
      if (std::isnan(half_widths[d])) continue;
      const VectorXd ascending = sorted.row(d);
      result.lower(row, d) = stats::Quantile(ascending, tail);
      result.upper(row, d) = stats::Quantile(ascending, 1.0 - tail);
    }
  }
  return result;
}

MatrixX3d ToolTipHalfWidths(const std::vector<HeldOutToolTip>& sessions,
                            const MatrixX3d& first_order,
                            double coverage) {
  CheckSpread(sessions, coverage);
  MatrixX3d half_widths = MatrixX3d::Ones(first_order.rows(), 3);
  for (Index d = 0; d < 3; ++d) {
    const bool has_shape =
        IsKnown(first_order, d) &&
        std::ranges::all_of(sessions, [&](const HeldOutToolTip& session) {
          return IsKnown(session.half_widths, d);
        });
    VectorXd mean_squares(std::ssize(sessions));
    Index s = 0;
    for (const HeldOutToolTip& session : sessions) {
      VectorXd errors = session.errors.col(d);
      if (has_shape) errors = errors.cwiseQuotient(session.half_widths.col(d));
      mean_squares[s++] =
          errors.squaredNorm() / static_cast<double>(errors.size());
    }
    if (has_shape) half_widths.col(d) = first_order.col(d);
    half_widths.col(d) *= Spread(mean_squares, coverage);
  }
  return half_widths;
}

}  // namespace errmap::models
