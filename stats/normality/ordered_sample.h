#pragma once

#include <optional>
#include <string>

#include "stats/eigen.h"
#include "stats/summary.h"

namespace errmap::stats {

/// A sample sorted and standardised once, for all tests of its shape.
///
/// Tests see only z, so results do not depend on shift, scale or row order.
class OrderedSample {
 public:
  /// Never throws. If the values cannot be tested, why_not() says why.
  explicit OrderedSample(const Eigen::Ref<const VectorXd>& sample);

  Index size() const { return z_.size(); }
  /// (x - mean) / sd with divisor n - 1 (NISTIR 5367, Eq. 137), ascending.
  /// Meaningful only if why_not() is empty.
  const VectorXd& z() const { return z_; }
  /// Mean, sd and extremes of the values as given.
  const SampleSummary& summary() const { return summary_; }
  /// Returns "", or why nothing can be tested: no values, one value, values
  /// that are not finite, or all values equal.
  const std::string& why_not() const { return why_not_; }
  /// Returns why_not(), or a reason if there are fewer than `least` values.
  std::string WhyNotWith(Index least) const;

 private:
  VectorXd z_;
  SampleSummary summary_;
  std::string why_not_;
};

/// Smallest rounding step that FindStep reports, in standard deviations over
/// sqrt(n). Finer steps move the shape tests by less than their own scatter.
inline constexpr double kFinestStep = 0.1;

/// Returns the rounding step of `ascending` (n >= 2, finite, standard deviation
/// 1): the greatest common divisor of their differences. Returns nothing if it
/// is below kFinestStep / sqrt(n).
std::optional<double> FindStep(const Eigen::Ref<const VectorXd>& ascending);

}  // namespace errmap::stats
