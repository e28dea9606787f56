#pragma once

#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::stats {

/// Errors of predictions, in the unit of the measured targets: residual =
/// target - predicted (Eq. 136).
struct ErrorMetrics {
  Index n = 0;
  double mean = kNaN;
  double sd = kNaN;    // divisor n - 1
  double rmse = kNaN;  // sqrt(mean of squared residuals), divisor n
  double mae = kNaN;   // mean of |residual|
  double min = kNaN;
  double max = kNaN;
  double range = kNaN;
  /// 1 - SSE / sum (target - baseline)^2. NaN if the targets equal the
  /// baseline. Negative: worse than predicting the baseline.
  double r2 = kNaN;
};

/// Returns the metrics of `residuals` (n) of `targets` (n). `baseline` (n) is
/// the mean of the training rows of each prediction, so that R2 does not use
/// held-out rows. All are in the target's unit, and NaN if n = 0. Throws
/// std::invalid_argument unless the sizes agree.
ErrorMetrics ComputeErrorMetrics(const Eigen::Ref<const VectorXd>& targets,
                                 const Eigen::Ref<const VectorXd>& residuals,
                                 const Eigen::Ref<const VectorXd>& baseline);

/// Returns sqrt(mean of squared `residuals`), divisor n.
double RootMeanSquare(const Eigen::Ref<const VectorXd>& residuals);

/// Returns the geometric mean of `sizes` (n, at least 0), such as the RMSE of n
/// sessions. A size of 0 counts as the smallest normal number, so two models
/// with only zeros are equal.
double GeometricMean(const Eigen::Ref<const VectorXd>& sizes);

}  // namespace errmap::stats
