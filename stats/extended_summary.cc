#include "stats/extended_summary.h"

#include <cmath>
#include <string>

#include "stats/require.h"
#include "stats/summary.h"

namespace errmap::stats {
namespace {

void RequireTwo(const char* function, Index n) {
  Require(n >= 2, std::string(function) + ": needs at least 2 values", n);
}

}  // namespace

ExtendedSummary SummarizeExtended(
    const Eigen::Ref<const Eigen::Matrix<DoubleDouble, Eigen::Dynamic, 1>>&
        sample) {
  const Index n = sample.size();
  RequireTwo("SummarizeExtended", n);
  ExtendedSummary summary;
  DoubleDouble sum;
  for (const DoubleDouble& value : sample) sum += value;
  summary.mean = sum / DoubleDouble(static_cast<double>(n));
  DoubleDouble squares;
  DoubleDouble products;
  for (Index i = 0; i < n; ++i) {
    const DoubleDouble deviation = sample[i] - summary.mean;
    squares += deviation * deviation;
    if (i + 1 < n) products += deviation * (sample[i + 1] - summary.mean);
  }
  summary.sd = sqrt(squares / DoubleDouble(static_cast<double>(n - 1)));
  summary.autocorrelation = products / squares;
  summary.condition = std::hypot(1.0, summary.mean.hi / summary.sd.hi);
  return summary;
}

double LagOneAutocorrelation(const Eigen::Ref<const VectorXd>& sample) {
  const Index n = sample.size();
  RequireTwo("LagOneAutocorrelation", n);
  // The rounded mean, and then what it leaves: differences of near numbers are
  // exact, so that the deviations are as good as the data.
  VectorXd deviations = sample.array() - Summarize(sample).mean;
  deviations.array() -= CompensatedSum(deviations) / static_cast<double>(n);
  return CompensatedSum(
             deviations.head(n - 1).cwiseProduct(deviations.tail(n - 1))) /
         CompensatedSum(deviations.cwiseAbs2());
}

}  // namespace errmap::stats
