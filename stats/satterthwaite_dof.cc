#include "stats/satterthwaite_dof.h"

#include <algorithm>
#include <limits>

#include "stats/distributions.h"

namespace errmap::stats {

double SatterthwaiteDof(const VectorXd& mean_squares, double least) {
  constexpr double kConfidence = 0.8;
  const auto n = static_cast<double>(mean_squares.size());
  const double mean = mean_squares.mean();
  const double squares = (mean_squares.array() - mean).square().sum();
  const double most = squares / ChiSquaredQuantile(1.0 - kConfidence, n - 1.0);
  return most > 0.0 ? n * std::max(least, 2.0 * mean * mean / most)
                    : std::numeric_limits<double>::infinity();
}

}  // namespace errmap::stats
