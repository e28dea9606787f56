#pragma once

#include <limits>
#include <string>
#include <utility>

namespace errmap::stats {

/// Outcome of one statistical test: a statistic and its probability, or the
/// reason why there is none.
struct TestResult {
  double statistic = std::numeric_limits<double>::quiet_NaN();
  /// Probability, under the null hypothesis, of a statistic at least as
  /// extreme; NaN where only the statistic applies.
  double p = std::numeric_limits<double>::quiet_NaN();
  std::string why_not = {};  // "" where the statistic applies

  bool ok() const { return why_not.empty(); }
};

/// A test that does not apply, and why.
inline TestResult NotApplicable(std::string why) {
  TestResult result;
  result.why_not = std::move(why);
  return result;
}

}  // namespace errmap::stats
