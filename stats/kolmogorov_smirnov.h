#pragma once

#include "stats/eigen.h"

namespace errmap::stats {

/// Returns the one-sample Kolmogorov-Smirnov distance of `sample` (n >= 1) from
/// the normal distribution with this mean and sd > 0: the largest |F_n(x) -
/// F(x)| over both sides of every step (NISTIR 5367, Eq. 138). NaN if n = 0, sd
/// is not above 0 or a value is NaN.
double KsDistanceFromNormal(const Eigen::Ref<const VectorXd>& sample,
                            double mean,
                            double sd);

/// Returns the distance of ascending values (n >= 1) from the standard normal.
double KsDistanceFromStandardNormal(
    const Eigen::Ref<const VectorXd>& ascending);

/// Returns the probability of a distance of at least `d` in n values under the
/// null hypothesis with mean and sd GIVEN, not estimated from the same values
/// (Eq. 139-140, the asymptotic form): Q(lambda) at lambda = sqrt(n) d. If mean
/// and sd are estimated, p is far too large: use Lilliefors' test.
double KsProbabilityMeanSdGiven(double d, Index n);

/// Q(lambda) = 2 sum_j (-1)^(j-1) exp(-2 j^2 lambda^2), Eq. 139, to full double
/// precision for every lambda >= 0. Uses the theta-function form for small
/// lambda, for which the alternating series does not converge.
double KolmogorovComplement(double lambda);

}  // namespace errmap::stats
