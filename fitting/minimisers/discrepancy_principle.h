#pragma once

#include <functional>
#include <vector>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

/// Rules of the search for alpha.
struct DiscrepancyRules {
  double delta = 0.0;  // wanted misfit; above 0
  /// alpha0 and q of alpha_k = alpha0 q^k, Eq. (133). alpha0 must be above 0, q
  /// between 0 and 1.
  double alpha0 = 0.1;
  double q = 0.25;
  /// Smallest alpha tried; above 0.
  double least_alpha = 1e-12;
  /// Relative width at which halving of the bracket of alpha ends; above
  /// 0.
  double tolerance = 0.01;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// One alpha tried; listed in order.
struct DiscrepancyStep {
  double alpha = 0.0;
  double misfit = 0.0;
};

struct DiscrepancyChoice {
  double alpha = 0.0;
  double misfit = 0.0;  // at `minimum`
  /// True if misfit <= delta. If not, `minimum` is that of smallest misfit.
  bool reached = false;
  Minimum minimum;
  std::vector<DiscrepancyStep> steps;
};

/// Discrepancy principle of NISTIR 5367, Eq. (126)-(135): of all w with misfit
/// |F(w) - z| <= delta it seeks that with the least |w|. It is the minimiser of
/// |F(w) - z|^2 + alpha |w|^2 for the largest alpha that reaches delta.
///
/// Decreases alpha0 q^k until the misfit is at most delta (Eq. 133-134). Each
/// fit starts from the previous one. Then alpha rises by factors 1/q until the
/// misfit is too large, and the bracket is halved in log alpha. Each fit starts
/// from the best one within delta. If F is linear, that is plain bisection. A
/// net's minimum may jump on the way down to one that stays within delta up to
/// far larger alphas. If alpha0 is small enough, it is the answer. `minimize`
/// returns the minimum for an alpha from a start; `misfit` is |F(w) - z| in the
/// unit of delta. Ends early if a fit fails or is interrupted. Throws
/// std::invalid_argument if a rule is out of range.
DiscrepancyChoice ChooseByDiscrepancy(
    const DiscrepancyRules& rules,
    const VectorXd& start,
    const std::function<Minimum(double alpha, const VectorXd& start)>& minimize,
    const std::function<double(const VectorXd& w)>& misfit);

}  // namespace errmap::fitting
