#pragma once

#include <string>

#include <Eigen/Core>

#include "stats/summary.h"

namespace errmap::stats {

/// A sample sorted and standardised once, for all tests of its shape.
///
/// Tests see only z, so results do not depend on shift, scale or row order.
class OrderedSample {
 public:
  /// Never throws. If the values cannot be tested, why_not() says why.
  explicit OrderedSample(const Eigen::Ref<const Eigen::VectorXd>& sample);

  Eigen::Index size() const { return z_.size(); }
  /// (x - mean) / sd with divisor n - 1 (NISTIR 5367, Eq. 137), ascending.
  /// Meaningful only if why_not() is empty.
  const Eigen::VectorXd& z() const { return z_; }
  /// Mean, sd and extremes of the values as given.
  const SampleSummary& summary() const { return summary_; }
  /// Returns "", or why nothing can be tested: no values, one value, values
  /// that are not finite, or all values equal.
  const std::string& why_not() const { return why_not_; }
  /// Returns why_not(), or that fewer than `least` values are too few.
  std::string WhyNotWith(Eigen::Index least) const;

 private:
  Eigen::VectorXd z_;
  SampleSummary summary_;
  std::string why_not_;
};

}  // namespace errmap::stats
