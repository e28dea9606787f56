#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "fitting/minimisers/objective.h"
#include "fitting/minimisers/run_monitor.h"
#include "stats/not_a_number.h"

namespace errmap::fitting {

/// Distance in cost of a point from a minimum, for points near which the cost
/// changes only by rounding.
struct CostResolution {
  double cost = stats::kNaN;
  /// Rounding of the cost: its change at points that differ from x only in the
  /// last digits, on the smoother side of x, which excludes a cliff there. At
  /// least one unit in the last place. NaN if both sides are not finite.
  double rounding = 0.0;
  /// 1/2 g'H^-1 g: the cost reduction predicted by Newton's step. Infinite if H
  /// has negative curvature in some direction, or if unknown.
  double remaining = std::numeric_limits<double>::infinity();

  /// Largest `remaining` at a minimum: the rounding, or the tenth digit of the
  /// cost. Steps along the gradient cannot reach that digit if the condition of
  /// H exceeds about 10^4.
  double limit() const { return std::max(rounding, 1e-9 * std::abs(cost)); }
  bool is_reached() const {
    return std::isfinite(remaining) && remaining <= limit();
  }
  std::string Text() const;  // message for a minimum, with numbers
};

/// Examines f around x (n). `remaining` comes from conjugate gradients on H d =
/// -g, until the residual is a tenth of g. H times a vector is by central
/// differences of the gradient. The result is unknown after 2 n steps or 500,
/// or once it exceeds limit(). A second run, of up to 100 steps, starts from a
/// direction with components along all axes. It detects saddles whose descent
/// direction is orthogonal to g. With up to 100 parameters, both runs are
/// repeated in parameters relative to their size, and the larger result counts:
/// if units differ by powers of ten, one gradient component could hide another.
/// `may_evaluate` is called before each evaluation; if it returns false, the
/// result is unknown.
CostResolution FindCostResolution(const Objective& f,
                                  const VectorXd& x,
                                  const std::function<bool()>& may_evaluate);

/// Ends a run that finds no descent from x: with kResolution if the cost shows
/// a minimum, else with kNoDescent and `why`. `spend` is called before each
/// evaluation of f; if it returns false, it must have ended the run.
void StopWithoutDescent(const Objective& f,
                        const VectorXd& x,
                        const std::function<bool()>& spend,
                        const std::string& why,
                        RunMonitor* monitor);

}  // namespace errmap::fitting
