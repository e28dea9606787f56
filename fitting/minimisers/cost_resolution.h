#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "fitting/minimisers/objective.h"
#include "fitting/minimisers/run_monitor.h"

namespace errmap::fitting {

/// How near to a minimum a point is, told by the cost where it moves by its
/// rounding only.
struct CostResolution {
  double cost = std::numeric_limits<double>::quiet_NaN();
  /// Of the cost at points that differ from x in the last digits only, on the
  /// smoother side of x: what rounding makes of it, and not a cliff there. At
  /// least one unit in the last place; NaN where both sides are not finite.
  double rounding = 0.0;
  /// 1/2 g'H^-1 g: what Newton's step would lower the cost by. Infinite where
  /// H is found to curve down, or this is not known.
  double remaining = std::numeric_limits<double>::infinity();

  /// The most that may remain at a minimum: the rounding, or the tenth digit
  /// of the cost, which steps along the gradient no longer reach where the
  /// condition of H is above some 10^4.
  double limit() const { return std::max(rounding, 1e-9 * std::abs(cost)); }
  bool is_reached() const {
    return std::isfinite(remaining) && remaining <= limit();
  }
  std::string Text() const;  // says so, with the numbers
};

/// Looks at f around x (n). The decrease comes from conjugate gradients on
/// H d = -g with H times a vector by central differences of the gradient,
/// until the residual is a tenth of g; it ends as unknown after 2 n steps or
/// 500, or once what is promised exceeds limit(). The same from a direction
/// with a part in all others (up to 100 steps) tells minima from saddles whose
/// way down is at right angles to g. Up to 100 parameters all this is done once
/// more with each as a share of its size, and the larger result taken: in units
/// that differ by powers of ten the gradient of one hides that of another.
/// `may_evaluate` is asked before each evaluation; where it refuses, the result
/// is unknown.
CostResolution FindCostResolution(const Objective& f,
                                  const Eigen::VectorXd& x,
                                  const std::function<bool()>& may_evaluate);

/// Ends a run that finds no way down from x: as kResolution where the cost says
/// that this is a minimum, else as kNoDescent, `why`. `spend` is asked before
/// each evaluation of f; where it refuses, it has ended the run itself.
void StopWithoutDescent(const Objective& f,
                        const Eigen::VectorXd& x,
                        const std::function<bool()>& spend,
                        const std::string& why,
                        RunMonitor* monitor);

}  // namespace errmap::fitting
