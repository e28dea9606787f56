#include "stats/lre.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "stats/require.h"

namespace errmap::stats {

double LogRelativeError(double value, double certified, double cap) {
  Require(cap > 0.0, "LogRelativeError: cap must be above 0", cap);
  if (!std::isfinite(value) || !std::isfinite(certified)) return 0.0;
  const double difference = std::abs(value - certified);
  if (difference == 0.0) return cap;
  // The logarithms apart: the quotient of very large numbers may overflow.
  const double digits =
      (certified == 0.0 ? 0.0 : std::log10(std::abs(certified))) -
      std::log10(difference);
  return std::clamp(digits, 0.0, cap);
}

double SmallestLogRelativeError(const Eigen::Ref<const VectorXd>& values,
                                const Eigen::Ref<const VectorXd>& certified,
                                double cap) {
  if (values.size() != certified.size() || values.size() < 1) {
    throw std::invalid_argument(
        "SmallestLogRelativeError: " + std::to_string(values.size()) +
        " values, " + std::to_string(certified.size()) +
        " certified; the same number, at least 1, is needed");
  }
  double smallest = cap;
  for (Index i = 0; i < values.size(); ++i) {
    smallest =
        std::min(smallest, LogRelativeError(values[i], certified[i], cap));
  }
  return smallest;
}

}  // namespace errmap::stats
