#include "stats/random.h"

#include "stats/distributions.h"

namespace errmap::stats {

double Random::Normal() { return NormalQuantile(OpenUniform()); }

VectorXd NormalSample(Index n, Random* random) {
  VectorXd sample(n);
  for (double& value : sample) value = random->Normal();
  return sample;
}

}  // namespace errmap::stats
