#include "stats/random.h"

#include <algorithm>

#include "stats/distributions.h"

namespace errmap::stats {

double Random::Normal() {
  constexpr double kHalfStep = 0x1.0p-54;
  // The middle of the last step rounds to 1, whose quantile is infinite.
  constexpr double kLast = 1.0 - 0x1.0p-53;
  return NormalQuantile(std::min(Uniform() + kHalfStep, kLast));
}

VectorXd NormalSample(Index n, Random* random) {
  VectorXd sample(n);
  for (double& value : sample) value = random->Normal();
  return sample;
}

}  // namespace errmap::stats
