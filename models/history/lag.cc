#include "models/history/lag.h"

#include <cmath>

namespace errmap::models {

double MeanDecay(double u) {
  if (u >= kMeanDecaySeriesBelow) return (1.0 - std::exp(-u)) / u;
  double sum = 1.0;
  for (int k = kMeanDecaySeriesTerms; k >= 2; --k) sum = 1.0 - u / k * sum;
  return sum;
}

}  // namespace errmap::models
