#include "stats/random.h"

#include <cmath>

#include "stats/distributions.h"

namespace errmap::stats {

double Random::Normal() { return NormalQuantile(OpenUniform()); }

VectorXd NormalSample(Index n, Random* random) {
  VectorXd sample(n);
  for (double& value : sample) value = random->Normal();
  return sample;
}

VectorXd AutoregressionSample(Index n, double memory, Random* random) {
  VectorXd x = NormalSample(n, random);
  const double fresh = std::sqrt(1.0 - memory * memory);
  for (Index i = 1; i < n; ++i) x[i] = memory * x[i - 1] + fresh * x[i];
  return x;
}

}  // namespace errmap::stats
