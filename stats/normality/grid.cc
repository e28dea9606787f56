#include "stats/normality/grid.h"

#include <cmath>

namespace errmap::stats {

std::optional<double> FindStep(const Eigen::Ref<const VectorXd>& ascending) {
  using Eigen::Index;
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
