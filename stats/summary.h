#pragma once

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

}  // namespace errmap::stats
