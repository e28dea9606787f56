#pragma once

#include "stats/eigen.h"

namespace errmap::stats {

/// Returns the medians of the order statistics of n >= 1 uniform values by
/// Filliben (1975): (i - 0.3175) / (n + 0.365), ends 1 - 0.5^(1/n) and
/// 0.5^(1/n).
VectorXd UniformMedians(Index n);

/// Normal quantiles at UniformMedians(n): the horizontal axis of the normal
/// probability plot (NISTIR 5367, Figure 7).
VectorXd NormalMedians(Index n);

/// Returns the Pearson correlation of `ascending` (n >= 2, not constant) with
/// `quantiles` (n), both sorted: how straight the probability plot is.
double PlotCorrelation(const Eigen::Ref<const VectorXd>& ascending,
                       const Eigen::Ref<const VectorXd>& quantiles);

/// Correlation of a sample's probability plot with each member of Tukey's
/// lambda family, with quantile function (p^lambda - (1-p)^lambda)/lambda:
/// lambda -1 is close to Cauchy, 0 logistic, 0.14 close to normal, 0.5 U-shaped
/// and 2 uniform (NISTIR 5367, Figure 8; Filliben 1975).
struct TukeyPpcc {
  VectorXd lambda;           // (81) -2, -1.95 ... 2
  VectorXd r;                // (81) correlation there
  double best_lambda = 0.0;  // of the refined maximum within [-2, 2]
  double best_r = 0.0;
  double r_at_014 = 0.0;  // at lambda = 0.14, the normal's member
};

/// Correlations with the quantiles of a given lambda, for samples of one size.
class TukeyPlot {
 public:
  explicit TukeyPlot(Index n);  // n >= 2
  /// Returns the correlation of `ascending` (n, not constant) at `lambda`.
  double Correlation(const Eigen::Ref<const VectorXd>& ascending,
                     double lambda) const;
  /// Returns the curve, with its maximum refined to 1e-8 in lambda.
  TukeyPpcc Curve(const Eigen::Ref<const VectorXd>& ascending) const;

 private:
  Index n_;
  Eigen::ArrayXd log_p_;      // (n/2) of the upper medians
  Eigen::ArrayXd log_not_p_;  // (n/2) log(1 - p) there
  /// (n/2 x 81) quantiles at the grid's lambdas, divided by their norm. Empty
  /// for sizes at which few samples are expected.
  MatrixXd grid_;

  Eigen::ArrayXd Quantiles(double lambda) const;
};

}  // namespace errmap::stats
