#include "stats/normality/monte_carlo.h"

namespace errmap::stats {

Eigen::VectorXd NormalSample(Eigen::Index n, Random* random) {
  Eigen::VectorXd sample(n);
  for (double& value : sample) value = random->Normal();
  return sample;
}

}  // namespace errmap::stats
