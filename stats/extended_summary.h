#pragma once

#include <Eigen/Core>

#include "stats/double_double.h"

namespace errmap::stats {

/// Mean, sd (divisor n - 1) and autocorrelation at lag 1,
/// sum d_i d_(i+1) / sum d_i^2, of a sample kept to 106 bits: the digits of
/// decimals far from zero that their nearest doubles have lost.
struct ExtendedSummary {
  DoubleDouble mean;
  DoubleDouble sd;
  DoubleDouble autocorrelation;
  /// sqrt(1 + (mean / sd)^2), by which relative errors of the data grow in the
  /// sd (Chan & Lewis 1979).
  double condition = 0.0;
};

/// Two-pass summary of `sample` (n >= 2); throws std::invalid_argument for
/// fewer values.
ExtendedSummary SummarizeExtended(
    const Eigen::Ref<const Eigen::Matrix<DoubleDouble, Eigen::Dynamic, 1>>&
        sample);

/// The autocorrelation at lag 1 of double data (n >= 2), the sums compensated.
/// NaN where all are equal; throws std::invalid_argument for fewer values.
double LagOneAutocorrelation(const Eigen::Ref<const Eigen::VectorXd>& sample);

}  // namespace errmap::stats
