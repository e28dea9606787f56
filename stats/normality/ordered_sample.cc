#include "stats/normality/ordered_sample.h"

#include <algorithm>
#include <cmath>

namespace errmap::stats {

OrderedSample::OrderedSample(const Eigen::Ref<const VectorXd>& sample)
    : z_(sample), summary_(Summarize(sample)) {
  if (size() == 0) {
    why_not_ = "there are no values";
  } else if (!sample.allFinite()) {
    why_not_ = "values that are not finite";
  } else if (size() == 1) {
    why_not_ = "needs at least 2 values, found 1";
  } else if (summary_.min == summary_.max) {
    why_not_ = "the values do not vary";
  }
  if (!why_not_.empty()) return;
  std::sort(z_.begin(), z_.end());
  const double magnitude = z_.cwiseAbs().maxCoeff();
  // Squares of values beyond these would overflow or vanish.
  constexpr double kLarge = 1e150;
  constexpr double kSmall = 1e-140;
  if (magnitude > kLarge || magnitude < kSmall) {
    const int exponent = std::ilogb(magnitude);
    for (double& value : z_) value = std::scalbn(value, -exponent);
    const SampleSummary scaled = Summarize(z_);
    z_ = (z_.array() - scaled.mean) / scaled.sd;
    summary_.mean = std::scalbn(scaled.mean, exponent);
    summary_.sd = std::scalbn(scaled.sd, exponent);
  } else {
    z_ = (z_.array() - summary_.mean) / summary_.sd;
  }
  if (!z_.allFinite()) why_not_ = "the values do not vary beyond rounding";
}

std::string OrderedSample::WhyNotWith(Index least) const {
  if (!why_not_.empty() || size() >= least) return why_not_;
  return "needs at least " + std::to_string(least) + " values, found " +
         std::to_string(size());
}

std::optional<double> FindStep(const Eigen::Ref<const VectorXd>& ascending) {
  const double least =
      kFinestStep / std::sqrt(static_cast<double>(ascending.size()));
  // Standardising leaves 1e-10 if the mean is a million standard deviations.
  constexpr double kRounding = 1e-6;
  const double nothing = kRounding * least;
  double step = 0.0;
  for (Index i = 1; i < ascending.size(); ++i) {
    // Euclid's algorithm, with the remainder of least magnitude.
    double remainder = ascending[i] - ascending[i - 1];
    while (remainder > nothing) {
      const double next = std::abs(std::remainder(step, remainder));
      step = remainder;
      remainder = next;
    }
    if (step > 0.0 && step < least) return std::nullopt;
  }
  return step > 0.0 ? std::optional(step) : std::nullopt;
}

}  // namespace errmap::stats
