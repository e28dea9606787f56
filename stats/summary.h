#pragma once

#include <vector>

#include <Eigen/Core>

namespace errmap::stats {

/// First figures of a sample, as the report's section 9 prints them.
struct SampleSummary {
  Eigen::Index n = 0;
  double mean = 0.0;  // NaN for n = 0
  double sd = 0.0;    // divisor n - 1 (not the report's np*j - 1); NaN if n < 2
  double min = 0.0;   // NaN for n = 0
  double max = 0.0;
  double range = 0.0;  // max - min
};

/// Summary of `sample` (n). Mean and sd by the corrected two-pass algorithm
/// (Chan, Golub & LeVeque 1983, Eq. 1.7), the sums compensated, so that the
/// digits of data far from zero survive. Unit: that of the sample.
SampleSummary Summarize(const Eigen::Ref<const Eigen::VectorXd>& sample);

/// Sum of `values` (n) with Neumaier's compensation (1974): error about one
/// unit in the last place unless terms cancel completely.
double CompensatedSum(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Standard error of the mean of independent values: sd / sqrt(n).
double StandardError(const SampleSummary& summary);

/// (x - mean) / sd of `sample` (n), in its order: NISTIR 5367, Eq. 137. Throws
/// std::invalid_argument unless two values differ and all are finite.
Eigen::VectorXd Standardise(const Eigen::Ref<const Eigen::VectorXd>& sample);

/// Quantile of `ascending` (n >= 1) at `probability` in [0, 1]: linear between
/// x_(i) at (i - 1)/(n - 1), type 7 of Hyndman & Fan (1996), the default of R
/// and NumPy. NaN for n = 0. Throws std::invalid_argument for a probability
/// outside [0, 1].
double Quantile(const Eigen::Ref<const Eigen::VectorXd>& ascending,
                double probability);

/// Counts of values in bins of one width; the last bin holds its upper edge.
struct Histogram {
  double low = 0.0;  // left edge of the first bin
  double width = 0.0;
  std::vector<Eigen::Index> counts;
};

/// Histogram of `ascending` (n >= 1) from its minimum to its maximum in `bins`
/// bins; 0 bins = by Freedman & Diaconis (1981): width 2 IQR n^(-1/3), at most
/// 1000, and Sturges' count where the IQR is 0. Equal values make one bin.
/// Throws std::invalid_argument for no values, values that are not finite, or
/// bins < 0.
Histogram MakeHistogram(const Eigen::Ref<const Eigen::VectorXd>& ascending,
                        Eigen::Index bins);

}  // namespace errmap::stats
