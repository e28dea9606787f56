#pragma once

#include <vector>

#include "stats/eigen.h"

namespace errmap::stats {

/// Basic statistics of a sample, as printed in section 9 of the report.
struct SampleSummary {
  Index n = 0;
  double mean = 0.0;  // NaN for n = 0
  double sd = 0.0;    // divisor n - 1 (not the report's np*j - 1); NaN if n < 2
  double min = 0.0;   // NaN for n = 0
  double max = 0.0;
  double range = 0.0;  // max - min
};

/// Returns the summary of `sample` (n), in its unit. Mean and sd use the
/// corrected two-pass algorithm (Chan, Golub & LeVeque 1983, Eq. 1.7) with
/// compensated sums, so data far from zero keep their digits.
SampleSummary Summarize(const Eigen::Ref<const VectorXd>& sample);

/// Returns the sum of `values` (n) with Neumaier's compensation (1974). The
/// error is about one unit in the last place unless terms cancel completely.
double CompensatedSum(const Eigen::Ref<const VectorXd>& values);

/// Returns the standard error of the mean of `n` independent values:
/// sd / sqrt(n).
double StandardError(double sd, Index n);

/// Returns (x - mean) / sd of `sample` (n), in its order: NISTIR 5367, Eq. 137.
/// Throws std::invalid_argument unless two values differ and all are finite.
VectorXd Standardise(const Eigen::Ref<const VectorXd>& sample);

/// Returns Pearson's correlation of `a` and `b` (n each, n >= 1); 0 if one of
/// them is constant.
double Correlation(const Eigen::Ref<const VectorXd>& a,
                   const Eigen::Ref<const VectorXd>& b);

/// Returns the quantile of `ascending` at `probability` in [0, 1]: type 7 of
/// Hyndman & Fan (1996), the default of R and NumPy. NaN if n = 0. Throws
/// std::invalid_argument if the probability is outside [0, 1].
double Quantile(const Eigen::Ref<const VectorXd>& ascending,
                double probability);

/// Counts of values in bins of one width; the last includes its upper edge.
struct Histogram {
  double low = 0.0;  // left edge of the first bin
  double width = 0.0;
  std::vector<Index> counts;
};

/// Returns the histogram of `ascending` (n >= 1) from its minimum to its
/// maximum. `bins` = 0 chooses the number by Freedman & Diaconis (1981): width
/// 2 IQR n^(-1/3), at most 1000. It is Sturges' number if the IQR is 0. Equal
/// values give one bin. Throws std::invalid_argument if there are no values, a
/// value is not finite or bins < 0.
Histogram MakeHistogram(const Eigen::Ref<const VectorXd>& ascending,
                        Index bins);

}  // namespace errmap::stats
