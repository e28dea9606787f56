#pragma once

#include <vector>

#include "stats/eigen.h"

namespace errmap::models {

/// A session at the tool (m x 3 each): the true errors less what maps say that
/// had no part of it, and first-order half-widths at its poses.
struct HeldOutToolTip {
  Eigen::MatrixX3d errors;
  Eigen::MatrixX3d half_widths;
};

/// Half-widths (n x 3) within which `coverage` of the errors of a further
/// session lie: `first_order` (n x 3), each direction times one factor, so that
/// errors over half-widths have the root mean square that the sessions had on
/// average, times Student's t. Its degrees of freedom are those by which the
/// sessions' mean squares differ as much as they do (Satterthwaite 1946, JCGM
/// 100:2008, G.4), with a confidence of 80 %, and at least one for each
/// session.
///
/// This includes what the sum of independent components cannot: maps which read
/// the same sensors err together, a machine is used in states in which a
/// component was not measured, and an instrument's noise is no error of the
/// tool. Along a direction where a first-order half-width is not known or 0 all
/// are the same, from the errors alone.
///
/// Throws std::invalid_argument for fewer than two sessions, a session without
/// points, shapes that do not agree or a coverage outside of (0, 1).
Eigen::MatrixX3d ToolTipHalfWidths(const std::vector<HeldOutToolTip>& sessions,
                                   const Eigen::MatrixX3d& first_order,
                                   double coverage);

}  // namespace errmap::models
