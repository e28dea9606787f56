#pragma once

#include <Eigen/Core>

#include "stats/summary.h"

namespace errmap::stats {

/// How far predictions are from what was measured.
struct ErrorMetrics {
  SampleSummary residuals;  // of residual = target - predicted (Eq. 136)
  double rmse = 0.0;        // sqrt(mean of squared residuals), divisor n
  double mae = 0.0;         // mean of |residual|
  /// 1 - SSE / sum (target - baseline)^2; NaN where the targets do not vary
  /// about the baseline. Negative: worse than predicting the baseline.
  double r2 = 0.0;
};

/// Metrics of `residuals` (n) of `targets` (n); `baseline` (n) is the mean of
/// the rows each prediction was trained on, so that R2 of held-out rows does
/// not know them. All in the target's unit. n = 0 gives NaN throughout.
/// Throws std::invalid_argument unless the sizes agree.
ErrorMetrics ComputeErrorMetrics(
    const Eigen::Ref<const Eigen::VectorXd>& targets,
    const Eigen::Ref<const Eigen::VectorXd>& residuals,
    const Eigen::Ref<const Eigen::VectorXd>& baseline);

/// sqrt(mean of squared `residuals`), divisor n.
double RootMeanSquare(const Eigen::Ref<const Eigen::VectorXd>& residuals);

}  // namespace errmap::stats
