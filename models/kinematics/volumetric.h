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
};

/// Combines `components` (errors of the chain, in their order) at m points of
/// `coordinates` (m x coordinates of the chain). The same seed gives the same
/// bounds; the draws are shared by all points, as the maps are. Throws
/// std::invalid_argument if the shapes do not agree.
VolumetricErrors CombineErrors(const KinematicChain& chain,
                               const MatrixXd& coordinates,
                               const std::vector<ComponentAtPoints>& components,
                               const VolumetricOptions& options);

/// A session at the tool (m x 3 each): true errors minus the predictions of
/// maps that were not fitted to the session, and first-order half-widths at its
/// poses.
struct HeldOutToolTip {
  Eigen::MatrixX3d errors;
  Eigen::MatrixX3d half_widths;
};

/// Returns half-widths (n x 3) within which `coverage` of the errors of a
/// further session lie. They are `first_order` (n x 3), with one factor for
/// each direction, times Student's t. The factor is the average root mean
/// square of errors over half-widths in the sessions. The degrees of freedom
/// follow from the differences between the sessions' mean squares
/// (Satterthwaite 1946, JCGM 100:2008, G.4), with a confidence of 80 %, and at
/// least one for each session.
///
/// This includes effects that a sum of independent components cannot. Maps
/// which read the same sensors have correlated errors. A machine is used in
/// states in which a component was not measured. Noise of the instrument is not
/// an error of the tool. Along a direction with an unknown or zero first-order
/// half-width, all half-widths are equal, from the errors alone.
///
/// Throws std::invalid_argument for fewer than two sessions, a session without
/// points, shapes that do not agree or a coverage outside (0, 1).
Eigen::MatrixX3d ToolTipHalfWidths(const std::vector<HeldOutToolTip>& sessions,
                                   const Eigen::MatrixX3d& first_order,
                                   double coverage);

}  // namespace errmap::models
