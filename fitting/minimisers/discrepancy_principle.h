#pragma once

#include <functional>
#include <vector>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

/// One alpha tried; listed in order.
struct DiscrepancyStep {
  double alpha = 0.0;
  double misfit = 0.0;
};

struct DiscrepancyChoice {
  double alpha = 0.0;
  double misfit = 0.0;  // at `minimum`
  /// True if misfit <= delta. If not, `minimum` has the smallest misfit found.
  bool reached = false;
  Minimum minimum;
  std::vector<DiscrepancyStep> steps;
};

/// Discrepancy principle of NISTIR 5367, Eq. (126)-(135): of all w with misfit
/// |F(w) - z| <= delta it seeks the one with the least |w|. That w minimises
/// |F(w) - z|^2 + alpha |w|^2 for the largest alpha that reaches delta.
///
/// Decreases alpha_k = alpha0 q^k, from alpha0 = 0.1 with q = 1/4, until the
/// misfit is at most delta (Eq. 133-134) or alpha is below 1e-12. Each fit
/// starts from the previous one. Then alpha rises by factors 1/q until the
/// misfit is too large, and the bracket is halved in log alpha down to 1 %.
/// Each fit starts from the best one within delta. If F is linear, that is
/// plain bisection. For a net, the decrease may jump to a minimum that stays
/// within delta up to far larger alphas. If alpha0 itself reaches delta, it is
/// the result. `minimize` returns the minimum for an alpha from a start;
/// `misfit` is |F(w) - z| in the unit of delta. Ends early if a fit fails or is
/// interrupted. Throws std::invalid_argument unless delta is above 0.
DiscrepancyChoice ChooseByDiscrepancy(
    double delta,
    const VectorXd& start,
    const std::function<Minimum(double alpha, const VectorXd& start)>& minimize,
    const std::function<double(const VectorXd& w)>& misfit);

}  // namespace errmap::fitting
