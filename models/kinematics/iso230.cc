#include "models/kinematics/iso230.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

using Eigen::MatrixX3d;
using Eigen::Vector3d;

Approaches ApproachesOf(const std::vector<double>& deviations) {
  const Eigen::Map<const Eigen::ArrayXd> values(deviations.data(),
                                                std::ssize(deviations));
  const auto n = static_cast<double>(values.size());
  const double mean = deviations.empty() ? stats::kNaN : values.mean();
  return {.runs = values.size(),
          .mean = mean,
          .sd = deviations.size() < 2
                    ? stats::kNaN
                    : std::sqrt((values - mean).square().sum() / (n - 1.0))};
}

// Largest less smallest of what was added; NaN stays.
class Range {
 public:
  void Add(double value) {
    low_ = std::isnan(value) ? stats::kNaN : std::min(low_, value);
    high_ = std::isnan(value) ? stats::kNaN : std::max(high_, value);
  }
  double width() const { return high_ - low_; }

 private:
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

double LargerOrNaN(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? stats::kNaN : std::max(a, b);
}

void Check(const PositioningTest& test) {
  const Index n = test.deviations.size();
  if (n == 0 || test.positions.size() != n || std::ssize(test.upwards) != n) {
    throw std::invalid_argument(
        "PositioningPointsOf: " + std::to_string(test.positions.size()) +
        " positions, " + std::to_string(n) + " deviations and " +
        std::to_string(test.upwards.size()) + " directions");
  }
}

}  // namespace

std::vector<PositioningPoint> PositioningPointsOf(const PositioningTest& test) {
  Check(test);
  std::map<double, std::array<std::vector<double>, 2>> by_position;
  for (Index i = 0; i < test.deviations.size(); ++i) {
    const bool up = test.upwards[static_cast<std::size_t>(i)];
    by_position[test.positions[i]][up ? 1 : 0].push_back(test.deviations[i]);
  }
  std::vector<PositioningPoint> points;
  for (const auto& [position, runs] : by_position) {
    points.push_back({.position = position,
                      .up = ApproachesOf(runs[1]),
                      .down = ApproachesOf(runs[0])});
  }
  return points;
}

PositioningFigures PositioningFiguresOf(const PositioningTest& test) {
  return PositioningFiguresOf(PositioningPointsOf(test));
}

PositioningFigures PositioningFiguresOf(
    const std::vector<PositioningPoint>& points) {
  PositioningFigures figures;
  Range both;
  double reversals = 0.0;
  for (const PositioningPoint& point : points) {
    const double reversal = std::abs(point.reversal());
    both.Add(0.5 * (point.up.mean + point.down.mean));
    reversals += point.reversal();
    figures.reversal = LargerOrNaN(figures.reversal, reversal);
    figures.repeatability =
        LargerOrNaN(figures.repeatability,
                    2.0 * point.up.sd + 2.0 * point.down.sd + reversal);
  }
  figures.mean_bidirectional = both.width();
  figures.mean_reversal = reversals / static_cast<double>(points.size());
  Range means;
  Range spread;
  const auto one_way = [&](Approaches PositioningPoint::*side) {
    Range means_of_it;
    Range spread_of_it;
    PositioningFigures::OneWay found;
    for (const PositioningPoint& point : points) {
      const Approaches& of = point.*side;
      for (Range* range : {&means, &means_of_it}) range->Add(of.mean);
      for (Range* range : {&spread, &spread_of_it}) {
        range->Add(of.mean + 2.0 * of.sd);
        range->Add(of.mean - 2.0 * of.sd);
      }
      found.repeatability = LargerOrNaN(found.repeatability, 4.0 * of.sd);
    }
    found.systematic = means_of_it.width();
    found.accuracy = spread_of_it.width();
    return found;
  };
  figures.up = one_way(&PositioningPoint::up);
  figures.down = one_way(&PositioningPoint::down);
  figures.systematic = means.width();
  figures.accuracy = spread.width();
  figures.repeatability = LargerOrNaN(
      figures.repeatability,
      LargerOrNaN(figures.up.repeatability, figures.down.repeatability));
  return figures;
}

std::vector<bool> ApproachedUpwards(const VectorXd& positions) {
  const Index n = positions.size();
  std::vector<bool> upwards(static_cast<std::size_t>(n), true);
  if (n < 2) return upwards;
  const double far = 0.5 * (positions.maxCoeff() - positions.minCoeff());
  const auto is_step = [&](double step) {
    return step != 0.0 && std::abs(step) <= far;
  };
  for (Index i = 0; i < n; ++i) {
    const double before = i > 0 ? positions[i] - positions[i - 1] : 0.0;
    const double after = i + 1 < n ? positions[i + 1] - positions[i] : 0.0;
    const double step = is_step(before)  ? before
                        : is_step(after) ? after
                        : before != 0.0  ? before
                                         : after;
    upwards[static_cast<std::size_t>(i)] = step >= 0.0;
  }
  return upwards;
}

PositioningTest AlongDiagonal(const std::string& name,
                              const MatrixX3d& points,
                              const MatrixX3d& errors,
                              std::vector<bool> upwards) {
  constexpr std::string_view kSigns = "n0p";
  Vector3d direction = Vector3d::Zero();
  bool is_name = name.size() == 3;
  for (std::size_t axis = 0; is_name && axis < 3; ++axis) {
    const std::size_t sign = kSigns.find(name[axis]);
    is_name = sign != kSigns.npos;
    direction[static_cast<Index>(axis)] = static_cast<double>(sign) - 1.0;
  }
  if (!is_name || direction.cwiseAbs().sum() < 2.0) {
    throw std::invalid_argument(
        "AlongDiagonal: a diagonal's name has the signs p, n or 0 of X, Y and "
        "Z, two of them or more p or n");
  }
  if (points.rows() == 0 || errors.rows() != points.rows()) {
    throw std::invalid_argument(
        "AlongDiagonal: " + std::to_string(points.rows()) + " points and " +
        std::to_string(errors.rows()) + " errors");
  }
  const Vector3d size =
      points.colwise().maxCoeff() - points.colwise().minCoeff();
  direction = direction.cwiseProduct(size);
  if (direction.norm() == 0.0) {
    throw std::invalid_argument("AlongDiagonal: all points are one");
  }
  direction.normalize();
  return {.positions = points * direction,
          .deviations = errors * direction,
          .upwards = std::move(upwards)};
}

}  // namespace errmap::models
