#pragma once

#include "stats/eigen.h"
#include "stats/not_a_number.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// A two-sided t test of whether a mean difference is 0.
struct MeanDifferenceTest {
  TestResult test;  // statistic = t
  double degrees_of_freedom = kNaN;
};

/// Corrected resampled t test of Nadeau & Bengio (2003, Eq. 8) on one mean loss
/// difference per fold: t = mean / sqrt((1/J + test_to_train) s^2), J - 1
/// degrees of freedom. `test_to_train` is test rows over training rows in a
/// fold; it corrects for overlapping training sets. Needs J >= 2. p = 1 if all
/// differences are 0. Throws std::invalid_argument if test_to_train is negative
/// or not finite.
MeanDifferenceTest CorrectedResampledT(
    const Eigen::Ref<const VectorXd>& fold_differences, double test_to_train);

/// Test of Diebold & Mariano (1995) on loss differences in time order, of
/// forecasts one step ahead. Corrected for small samples (Harvey, Leybourne &
/// Newbold 1997): t with n - 1 degrees of freedom. Needs n >= 2. p = 1 if all
/// differences are 0.
MeanDifferenceTest DieboldMariano(
    const Eigen::Ref<const VectorXd>& differences);

}  // namespace errmap::stats
