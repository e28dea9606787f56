#pragma once

#include "stats/eigen.h"

namespace errmap::stats {

/// Returns Hartigan's dip of `ascending` (n >= 1): the largest distance between
/// its distribution function and that of the nearest unimodal distribution (J.
/// A. Hartigan & P. M. Hartigan, Annals of Statistics 13, 1985; the steps of AS
/// 217, but minorant and majorant are recomputed for each interval). At least
/// 1/(2n); 0 if n = 0.
double DipStatistic(const Eigen::Ref<const VectorXd>& ascending);

/// Returns the probability of a dip of at least `dip` in n uniform values. No
/// unimodal distribution has larger dips than the uniform. For others, such as
/// the normal, p is too large, so a small p is safe evidence of two modes. From
/// simulated quantiles (simulated_quantiles.h): 0.001 means at most 0.001. 1 if
/// n < 4, which is too few to show two modes.
double DipProbability(double dip, Index n);

}  // namespace errmap::stats
