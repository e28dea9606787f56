#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/axis/motion.h"
#include "data/measurements/clock/clock.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// A night lasts longer than this, s.
inline constexpr double kShortestNight = 3.5 * 3600.0;

/// Nights, which divide the rows: pauses of more than `gap`.
struct Nights {
  double gap = 0.0;  // s; infinite: one session
  bool sure = true;
  double other = 0.0;  // s; a gap that would give other sessions, or 0
};

/// Finds pauses much longer than those between the passes of `motion`, or
/// between rows if it has none. The gap is the smallest one in the sorted
/// pauses above which all pauses last 3.5 h or more. A pause of at least ten
/// median steps that breaks a pass is a night, too. `time` (n) is in order.
/// `dated`: passes hours apart may be on different days.
Nights FindNights(const Eigen::VectorXd& time,
                  const Motion& motion,
                  bool dated);

/// Finds nights by a clock, or by the pause that the selection gives. Without a
/// clock there is one session. Throws InputError if the pause is not a
/// duration.
Nights FindNights(const Clock& clock,
                  const Motion& motion,
                  const DatasetSelection& selection);

}  // namespace errmap::data
