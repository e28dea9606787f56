#pragma once

#include <string>

#include <Eigen/Core>

#include "stats/summary.h"

namespace errmap::stats {

/// A sample sorted and standardised once, for all tests of its shape.
///
/// Each such test sees z only, so none depends on shift, scale or row order.
class OrderedSample {
 public:
  /// Never throws on the values: what cannot be tested says so in why_not().
  explicit OrderedSample(const Eigen::Ref<const Eigen::VectorXd>& sample);

  Eigen::Index size() const { return z_.size(); }
  /// (x - mean) / sd with divisor n - 1 (NISTIR 5367, Eq. 137), ascending.
  /// Meaningful where why_not() is empty only.
  const Eigen::VectorXd& z() const { return z_; }
  /// Mean, sd and extremes of the values as given.
  const SampleSummary& summary() const { return summary_; }
  /// "" or why nothing can be tested: no values, one value, values that are
  /// not finite, all values equal.
  const std::string& why_not() const { return why_not_; }
  /// The same, or that fewer than `least` values are too few.
  std::string WhyNotWith(Eigen::Index least) const;

 private:
  Eigen::VectorXd z_;
  SampleSummary summary_;
  std::string why_not_;
};

}  // namespace errmap::stats
