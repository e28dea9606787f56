#include "stats/normality/monte_carlo.h"

#include "stats/distributions.h"

namespace errmap::stats {

Eigen::VectorXd NormalSample(Eigen::Index n, Random* random) {
  // Half a step up: a uniform value of 0 has no quantile.
  constexpr double kHalfStep = 0x1.0p-54;
  Eigen::VectorXd sample(n);
  for (double& value : sample) {
    value = NormalQuantile(random->Uniform() + kHalfStep);
  }
  return sample;
}

}  // namespace errmap::stats
