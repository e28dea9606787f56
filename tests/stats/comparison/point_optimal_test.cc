#include "stats/comparison/point_optimal.h"

#include <cmath>

#include <gtest/gtest.h>

#include "stats/comparison/ar1_t_test.h"
#include "stats/random.h"

namespace errmap::stats {
namespace {

constexpr Index kNullDraws = 9999;
constexpr int kSeriesDrawn = 2000;

// Share (%) of normal series, an autoregression about `mean`, with p <= 5 %.
double ShareFound(Index size, double memory, double mean) {
  const PointOptimalTest test(size, kSessionMemoryInTurn, kNullDraws, 1);
  Random random(2);
  int found = 0;
  for (int i = 0; i < kSeriesDrawn; ++i) {
    VectorXd x = NormalSample(size, &random);
    for (Index k = 1; k < size; ++k) {
      x[k] = memory * x[k - 1] + std::sqrt(1.0 - memory * memory) * x[k];
    }
    x.array() += mean;
    found += test.P(x) <= 0.05;
  }
  return 100.0 * found / kSeriesDrawn;
}

TEST(PointOptimalTest, KeepsItsLevelWithTheMemoryOfSessions) {
  for (const Index size : {6, 8, 10, 20}) {
    for (const double memory : {-0.5, 0.0, 0.3, kSessionMemory}) {
      EXPECT_LE(ShareFound(size, memory, 0.0), 5.0) << size << ", " << memory;
    }
  }
}

// The t test with kSessionMemory finds 32, 45 and 94 %.
TEST(PointOptimalTest, FindsAMeanWithoutMemory) {
  EXPECT_GE(ShareFound(8, 0.0, 1.0), 40.0);
  EXPECT_GE(ShareFound(10, 0.0, 1.0), 54.0);
  EXPECT_GE(ShareFound(8, 0.0, 2.0), 91.0);
}

TEST(PointOptimalTest, FindsWhatIsPlainWhateverTheScale) {
  const PointOptimalTest test(6, kSessionMemoryInTurn, kNullDraws, 1);
  const VectorXd equal = VectorXd::Constant(6, 1e-200);
  EXPECT_LE(test.P(equal), 0.05);
  EXPECT_EQ(test.P(-equal), 1.0);
  const VectorXd uneven{{1.0, 0.5, 2.0, -0.5, 1.5, 0.1}};
  EXPECT_EQ(test.P(uneven), test.P(1024.0 * uneven));
}

TEST(PointOptimalTest, IsTheSameForTheSameSeed) {
  const VectorXd uneven{{1.0, 0.5, 2.0, -0.5, 1.5, 0.1}};
  EXPECT_EQ(PointOptimalTest(6, 0.5, kNullDraws, 3).P(uneven),
            PointOptimalTest(6, 0.5, kNullDraws, 3).P(uneven));
}

}  // namespace
}  // namespace errmap::stats
