#include <cmath>

#include "stats/distributions.h"

int main() {
  // Half of the standard normal distribution lies below 0.
  return std::abs(errmap::stats::NormalCdf(0.0) - 0.5) < 1e-15 ? 0 : 1;
}
