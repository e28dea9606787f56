#pragma once

#include <vector>

#include "stats/eigen.h"

namespace errmap::models {

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
