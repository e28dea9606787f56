#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "models/kinematics/kinematic_chain.h"
#include "stats/eigen.h"

namespace errmap::models {

/// An error of a chain at m points, with its uncertainty.
struct ComponentAtPoints {
  VectorXd values;  // (m) the chain's length unit, or rad
  /// (m) A share `coverage` of errors lies within it of `values`. 0: exact;
  /// NaN: not known.
  VectorXd half_widths;
  /// Degrees of freedom of the standard deviation; half_widths are the standard
  /// deviation times Student's t. Infinite if it is known exactly.
  double degrees_of_freedom = std::numeric_limits<double>::infinity();
};

struct VolumetricOptions {
  double coverage = 0.9;  // of half_widths and of the bounds, in (0, 1)
  Index draws = 500;      // of Monte Carlo, at least 0: no bounds
  std::uint64_t seed = 1;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Errors at the tool: tool minus work in the base frame, in the chain's length
/// unit. The compensation is minus these.
struct VolumetricErrors {
  Eigen::MatrixX3d exact;        // (m x 3)
  Eigen::MatrixX3d first_order;  // (m x 3)
  /// (errors)(m x 3) The contribution of each error of the chain to
  /// first_order.
  std::vector<Eigen::MatrixX3d> contributions;
  /// (m x 3) Half-widths for the same share, for independent components, to
  /// first order (JCGM 100:2008, 5.1.2 and G.4.1). The squares of standard
  /// deviation times sensitivity are summed. Student's t has the degrees of
  /// freedom of Welch and Satterthwaite. NaN if a component with an effect is
  /// unknown.
  Eigen::MatrixX3d half_widths;
  /// (m x 3) Quantiles of the exact form over `draws` of the same components,
  /// each from its Student's t (JCGM 101:2008, 6.4.9). NaN like half_widths, or
  /// without draws.
  Eigen::MatrixX3d lower;
  Eigen::MatrixX3d upper;

  /// Largest distance between exact and first_order at a point.
  double LargestDifference() const;
};

/// Combines `components` (errors of the chain, in their order) at m points of
/// `coordinates` (m x coordinates of the chain). The same seed gives the same
/// bounds; the draws are shared by all points, as the maps are. Throws
/// std::invalid_argument if the shapes do not agree.
VolumetricErrors CombineErrors(const KinematicChain& chain,
                               const MatrixXd& coordinates,
                               const std::vector<ComponentAtPoints>& components,
                               const VolumetricOptions& options);

}  // namespace errmap::models
