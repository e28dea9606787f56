#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/reading/motion.h"

namespace errmap::data {

/// Where a run of rows ends: after a pause of more than `gap`.
struct Nights {
  double gap = 0.0;  // s; infinite: one session
  bool sure = true;
  double other = 0.0;  // s; another gap that would part them otherwise, or 0
};

/// Pauses of another order than those between the passes of `motion` (those
/// between rows where it has none): the lowest gap in the sorted pauses above
/// which they are nights of 3.5 h or more. One of ten median steps or more that
/// breaks a pass is a night, too. `time` (n) is in order; dates tell whether
/// passes hours apart are days.
Nights FindNights(const Eigen::VectorXd& time,
                  const Motion& motion,
                  bool dated);

}  // namespace errmap::data
