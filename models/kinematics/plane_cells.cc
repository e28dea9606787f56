#include "models/kinematics/plane_cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace errmap::models {
namespace {

using Eigen::MatrixX3d;
// Parts of equal width between the least and the largest of some values.
class Parts {
 public:
  Parts(const VectorXd& values, Index count)
      : low_(values.minCoeff()), count_(count) {
    const double range = values.maxCoeff() - low_;
    width_ = range > 0.0 ? range / static_cast<double>(count) : 1.0;
    if (range == 0.0) low_ -= 0.5 * width_ * static_cast<double>(count);
  }
  Index Of(double value) const {
    const auto part = static_cast<Index>((value - low_) / width_);
    return std::clamp(part, Index{0}, count_ - 1);
  }
  double Middle(Index part) const {
    return low_ + (static_cast<double>(part) + 0.5) * width_;
  }
  double width() const { return width_; }

 private:
  double low_;
  double width_ = 1.0;
  Index count_;
};

Index PartsOf(Index num_points) {
  constexpr double kPointsPerCell = 4.0;
  constexpr double kFewest = 3.0;
  constexpr double kMost = 12.0;
  return static_cast<Index>(
      std::clamp(std::sqrt(static_cast<double>(num_points) / kPointsPerCell),
                 kFewest,
                 kMost));
}

}  // namespace

std::optional<WorkingPlane> WorkingPlaneOf(
    const std::array<bool, 3>& sensitive) {
  const auto [x, y, z] = sensitive;
  if (x && y) return WorkingPlane{.across = 0, .up = 1};
  if (x && z) return WorkingPlane{.across = 2, .up = 0};
  if (y && z) return WorkingPlane{.across = 1, .up = 2};
  return std::nullopt;
}

PlaneCells CellsOf(const WorkingPlane& plane,
                   const MatrixX3d& points,
                   const MatrixX3d& errors) {
  if (points.rows() != errors.rows()) {
    throw std::invalid_argument("CellsOf: " + std::to_string(points.rows()) +
                                " points and " + std::to_string(errors.rows()) +
                                " errors");
  }
  PlaneCells result;
  if (points.rows() == 0) return result;
  const Parts across(points.col(plane.across), PartsOf(points.rows()));
  const Parts up(points.col(plane.up), PartsOf(points.rows()));
  result.width = across.width();
  result.height = up.width();
  std::map<std::pair<Index, Index>, PlaneCell> cells;
  for (Index row = 0; row < points.rows(); ++row) {
    const std::pair place{up.Of(points(row, plane.up)),
                          across.Of(points(row, plane.across))};
    const PlaneCell empty{
        across.Middle(place.second), up.Middle(place.first), 0, 0.0, 0.0, 0.0};
    PlaneCell& cell = cells.try_emplace(place, empty).first->second;
    const double error_across = errors(row, plane.across);
    const double error_up = errors(row, plane.up);
    ++cell.points;
    cell.mean_across += error_across;
    cell.mean_up += error_up;
    cell.rms += error_across * error_across + error_up * error_up;
  }
  for (auto& [place, cell] : cells) {
    const auto n = static_cast<double>(cell.points);
    cell.mean_across /= n;
    cell.mean_up /= n;
    cell.rms = std::sqrt(cell.rms / n);
    result.cells.push_back(cell);
  }
  return result;
}

}  // namespace errmap::models
