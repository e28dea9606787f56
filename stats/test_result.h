#pragma once

#include <string>
#include <utility>

#include "stats/not_a_number.h"

namespace errmap::stats {

/// Result of one statistical test: a statistic and its p, or the reason why
/// there is none.
struct TestResult {
  double statistic = kNaN;
  /// Probability, under the null hypothesis, of a statistic at least as
  /// extreme. NaN if there is only a statistic.
  double p = kNaN;
  std::string why_not = {};  // "" if the statistic applies

  bool ok() const { return why_not.empty(); }
};

/// Returns the result of a test that does not apply, with the reason.
inline TestResult NotApplicable(std::string why) {
  TestResult result;
  result.why_not = std::move(why);
  return result;
}

}  // namespace errmap::stats
