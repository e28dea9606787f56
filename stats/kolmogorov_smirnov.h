#pragma once

#include <Eigen/Core>

namespace errmap::stats {

/// One-sample Kolmogorov-Smirnov distance of `sample` (n >= 1) from the normal
/// distribution of this mean and sd > 0: the largest |F_n(x) - F(x)| over both
/// sides of every step (NISTIR 5367, Eq. 138). NaN for n = 0, sd not > 0 or a
/// NaN among the values.
double KsDistanceFromNormal(const Eigen::Ref<const Eigen::VectorXd>& sample,
                            double mean,
                            double sd);

/// The same of values in ascending order from the standard normal; n >= 1.
double KsDistanceFromStandardNormal(
    const Eigen::Ref<const Eigen::VectorXd>& ascending);

/// Probability of a distance of at least `d` in n values under the null
/// hypothesis with mean and sd GIVEN, not estimated from the same values
/// (Eq. 139-140, the asymptotic form): Q(lambda) at lambda = sqrt(n) d. With
/// mean and sd estimated it is far too large; Lilliefors' applies then.
double KsProbabilityMeanSdGiven(double d, Eigen::Index n);

/// Q(lambda) = 2 sum_j (-1)^(j-1) exp(-2 j^2 lambda^2), Eq. 139, to full
/// double precision for every lambda >= 0 (the theta-function form serves
/// small lambda, where the alternating series does not converge).
double KolmogorovComplement(double lambda);

}  // namespace errmap::stats
