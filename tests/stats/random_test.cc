#include "stats/random.h"

#include <cmath>

#include <gtest/gtest.h>

#include "stats/distributions.h"

namespace errmap::stats {
namespace {

TEST(Random, DrawsNormalValuesAsItsUniformOnesLie) {
  Random normal(1);
  Random uniform(1);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kDraws = 10000;
  for (int i = 0; i < kDraws; ++i) {
    const double value = normal.Normal();
    EXPECT_NEAR(NormalCdf(value), uniform.Uniform(), 1e-12);
    sum += value;
    squares += value * value;
  }
  // Three standard errors.
  EXPECT_NEAR(sum / kDraws, 0.0, 0.03);
  EXPECT_NEAR(squares / kDraws, 1.0, 0.043);
}

}  // namespace
}  // namespace errmap::stats
