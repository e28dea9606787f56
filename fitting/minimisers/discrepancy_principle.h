#pragma once

#include <functional>
#include <vector>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

/// How alpha is looked for.
struct DiscrepancyRules {
  double delta = 0.0;  // wanted misfit; above 0
  /// alpha0 and q of alpha_k = alpha0 q^k, Eq. (133); alpha0 above 0, q between
  /// 0 and 1.
  double alpha0 = 0.1;
  double q = 0.25;
  /// No smaller alpha is tried; above 0.
  double least_alpha = 1e-12;
  /// The bracket of alpha is halved until its ends differ by less than this
  /// share; above 0.
  double tolerance = 0.01;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// One alpha that was tried, in order.
struct DiscrepancyStep {
  double alpha = 0.0;
  double misfit = 0.0;
};

struct DiscrepancyChoice {
  double alpha = 0.0;
  double misfit = 0.0;  // at `minimum`
  /// misfit <= delta. Where not, `minimum` is that of the smallest misfit.
  bool reached = false;
  Minimum minimum;
  std::vector<DiscrepancyStep> steps;
};

/// The discrepancy principle of NISTIR 5367, Eq. (126)-(135): of all w with
/// misfit |F(w) - z| <= delta the one of least |w|, found as the minimiser of
/// |F(w) - z|^2 + alpha |w|^2 for the largest alpha that gets there.
///
/// Goes down alpha0 q^k, each fit starting where the last one ended, until the
/// misfit is at most delta (Eq. 133-134). From there alpha rises again, by 1/q
/// until the misfit is too large and then by halving the bracket in log alpha,
/// each fit starting from the best one within delta. Where F is linear that is
/// plain bisection; a net's minimum may jump on the way down to one that stays
/// within delta up to far larger alphas. Where alpha0 is small enough, it is
/// the answer. `minimize` gives the minimum for an alpha from a start, `misfit`
/// is |F(w) - z| in delta's unit. Ends early where a fit fails or is
/// interrupted. Throws std::invalid_argument where the rules are out of range.
DiscrepancyChoice ChooseByDiscrepancy(
    const DiscrepancyRules& rules,
    const Eigen::VectorXd& start,
    const std::function<Minimum(double alpha, const Eigen::VectorXd& start)>&
        minimize,
    const std::function<double(const Eigen::VectorXd& w)>& misfit);

}  // namespace errmap::fitting
