#pragma once

#include <limits>

#include <Eigen/Core>

#include "stats/test_result.h"

namespace errmap::stats {

/// A two-sided t test of whether a mean difference is 0.
struct MeanDifferenceTest {
  TestResult test;  // statistic = t
  double degrees_of_freedom = std::numeric_limits<double>::quiet_NaN();
};

/// Corrected resampled t of Nadeau & Bengio (2003, Eq. 8) on one mean loss
/// difference per fold: t = mean / sqrt((1/J + test_to_train) s^2), J - 1
/// degrees of freedom. `test_to_train`, the rows tested over the rows trained
/// on in a fold, allows for training sets that overlap. Needs J >= 2; p = 1
/// where all differences are 0. Throws std::invalid_argument for a negative or
/// non-finite test_to_train.
MeanDifferenceTest CorrectedResampledT(
    const Eigen::Ref<const Eigen::VectorXd>& fold_differences,
    double test_to_train);

/// Diebold & Mariano (1995) on loss differences in the order of time, with
/// the small-sample correction of Harvey, Leybourne & Newbold (1997): t with
/// n - 1 degrees of freedom. `horizon` h: differences up to h - 1 apart may be
/// correlated (h = 1: none are). A long-run variance that is not above 0 is
/// replaced by that of h = 1, as in R's forecast::dm.test. Needs n >= 2 and
/// n > h; p = 1 where all differences are 0. Throws std::invalid_argument for
/// horizon < 1.
MeanDifferenceTest DieboldMariano(
    const Eigen::Ref<const Eigen::VectorXd>& differences, Eigen::Index horizon);

}  // namespace errmap::stats
