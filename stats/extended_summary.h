#pragma once

#include "stats/double_double.h"
#include "stats/eigen.h"

namespace errmap::stats {

/// Mean, sd (divisor n - 1) and autocorrelation at lag 1, sum d_i d_(i+1) / sum
/// d_i^2, of a sample in 106 bits. Decimals far from zero lose digits when
/// rounded to the nearest doubles; here they keep them.
struct ExtendedSummary {
  DoubleDouble mean;
  DoubleDouble sd;
  DoubleDouble autocorrelation;
  /// Condition number of the sd, sqrt(1 + (mean / sd)^2): the factor by which
  /// relative errors of the data grow in the sd (Chan & Lewis 1979).
  double condition = 0.0;
};

/// Returns the two-pass summary of `sample`. Throws std::invalid_argument if n
/// < 2.
ExtendedSummary SummarizeExtended(
    const Eigen::Ref<const Eigen::Matrix<DoubleDouble, Eigen::Dynamic, 1>>&
        sample);

/// Returns the autocorrelation at lag 1 of double data, with compensated sums.
/// NaN if all values are equal. Throws std::invalid_argument if n < 2.
double LagOneAutocorrelation(const Eigen::Ref<const VectorXd>& sample);

}  // namespace errmap::stats
