#include "stats/comparison/memory_bounds.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using ::testing::HasSubstr;

constexpr double kRounding = 1e-12;

// With all memory that cannot be excluded.
MemoryTest OfTheFirstPair(const UnitLosses& losses, Index a = 0, Index b = 1) {
  const MemoryBounds bounds(losses);
  return bounds.OfDifference(a, b, bounds.InDifference(a, b, kMostMemory));
}

UnitLosses MakeLosses(Index units) {
  UnitLosses losses;
  losses.mean_squares.resize(units, 2);
  losses.rows.resize(units);
  for (Index unit = 0; unit < units; ++unit) {
    const double u = static_cast<double>(unit);
    losses.mean_squares.row(unit) << 2.0 + std::sin(3.0 * u),
        3.0 + std::cos(0.7 * u);
    losses.rows[unit] = 10.0 + static_cast<double>(unit % 3);
  }
  return losses;
}

// Made by R 4.2 from the definition:
//   u <- 0:11; w <- 10 + u %% 3; L <- cbind(2 + sin(3*u), 3 + cos(0.7*u))
//   M <- colSums(w * L) / sum(w); D <- diff(rev(sqrt(M))); n <- 12
//   f <- function(j) w / mean(w) * (L[, j] - M[j]) / (2 * sqrt(M[j]))
//   x <- f(1) - f(2); r <- sum(x[-1] * x[-n]) / sum(x^2)
//   rho <- (n * r + 1) / (n - 3)
//   phi <- min(0.98, max(0, rho + qnorm(0.95) * sqrt((1 - rho^2) / n)))
//   m <- max(2, n * (1 - phi) / (1 + phi))
//   se <- sqrt(sum(x^2) / n / (1 - 1 / m) / m)
//   c(D, phi, m, D / se, 2 * pt(-abs(D / se), m - 1),
//     D + qt(c(.025, .975, .05, .95), m - 1) * se)
TEST(MemoryBounds, AgreeWithRFromTheDefinition) {
  const MemoryTest found = OfTheFirstPair(MakeLosses(12));
  EXPECT_NEAR(found.memory, 0.1657792971687524, 1e-10);
  EXPECT_NEAR(found.effective_units, 8.5870871598827847, 1e-9);
  EXPECT_NEAR(found.test.statistic, -2.8925576481244306, 1e-9);
  EXPECT_NEAR(found.test.p, 0.0212873415069274, 1e-10);
  EXPECT_NEAR(found.bounds.lower, -0.6255050408177050, 1e-9);
  EXPECT_NEAR(found.bounds.upper, -0.0676385411758871, 1e-9);
  EXPECT_NEAR(found.bounds.at_least, -0.5709557019521486, 1e-9);
  EXPECT_NEAR(found.bounds.at_most, -0.1221878800414435, 1e-9);
}

TEST(MemoryBounds, TurnWithThePairAndScaleWithTheUnit) {
  UnitLosses losses = MakeLosses(23);
  const MemoryTest one = OfTheFirstPair(losses);
  const MemoryTest other = OfTheFirstPair(losses, 1, 0);
  EXPECT_NEAR(one.bounds.lower, -other.bounds.upper, kRounding);
  EXPECT_NEAR(one.bounds.at_most, -other.bounds.at_least, kRounding);
  EXPECT_NEAR(one.test.p, other.test.p, kRounding);
  for (const double scale : {1e-300, 1e12}) {
    losses.mean_squares = scale * MakeLosses(23).mean_squares;
    const MemoryTest scaled = OfTheFirstPair(losses);
    EXPECT_NEAR(scaled.test.p, one.test.p, 1e-9);
    EXPECT_NEAR(scaled.bounds.lower / std::sqrt(scale), one.bounds.lower, 1e-9);
  }
}

TEST(MemoryBounds, NeedFourUnits) {
  for (const Index units : {0, 1, 3}) {
    const MemoryTest found = OfTheFirstPair(MakeLosses(units));
    EXPECT_FALSE(found.bounds.exist());
    EXPECT_THAT(found.test.why_not, HasSubstr("at least 4 units"));
  }
  EXPECT_TRUE(OfTheFirstPair(MakeLosses(4)).bounds.exist());
}

// The same values, once level by level and once mixed: only where neighbours
// are alike do they count for fewer.
TEST(MemoryBounds, AreWiderWhereNeighboursAreAlike) {
  UnitLosses alike = MakeLosses(40);
  UnitLosses mixed = alike;
  for (Index unit = 0; unit < 40; ++unit) {
    alike.mean_squares(unit, 0) = unit < 20 ? 1.0 : 3.0;
    mixed.mean_squares(unit, 0) = unit % 2 == 0 ? 1.0 : 3.0;
  }
  const MemoryTest of_alike = OfTheFirstPair(alike);
  const MemoryTest of_mixed = OfTheFirstPair(mixed);
  EXPECT_GT(of_alike.memory, 0.8);
  EXPECT_EQ(of_mixed.memory, 0.0);
  EXPECT_EQ(of_mixed.effective_units, 40.0);
  EXPECT_GT(of_alike.bounds.upper - of_alike.bounds.lower,
            3.0 * (of_mixed.bounds.upper - of_mixed.bounds.lower));
}

TEST(MemoryBounds, KnowEqualModelsAndAConstantDifference) {
  UnitLosses losses = MakeLosses(12);
  losses.mean_squares.col(1) = losses.mean_squares.col(0);
  const MemoryTest equal = OfTheFirstPair(losses);
  EXPECT_EQ(equal.test.p, 1.0);
  EXPECT_EQ(equal.bounds.at_most, 0.0);
  losses.mean_squares.col(0).setConstant(4.0);
  losses.mean_squares.col(1).setConstant(1.0);
  const MemoryTest constant = OfTheFirstPair(losses);
  EXPECT_LT(constant.test.p, 1e-6);
  EXPECT_NEAR(constant.bounds.at_most, 1.0, kRounding);
}

TEST(MemoryBounds, TakeSeparateSessionsForHalfAsMany) {
  EXPECT_DOUBLE_EQ(EffectiveUnits(10, kSessionMemory), 5.0);
  EXPECT_EQ(EffectiveUnits(3, kSessionMemory), 2.0);
  const MemoryTest found =
      MemoryBounds(MakeLosses(12)).OfDifference(0, 1, kSessionMemory);
  EXPECT_DOUBLE_EQ(found.effective_units, 6.0);
  EXPECT_EQ(found.memory, kSessionMemory);
}

// A series of 40 that alternates, one that does not, and one by levels.
TEST(ShownMemory, IsNoneUnlessItIsAboveChance) {
  VectorXd series(40);
  for (Index i = 0; i < 40; ++i) series[i] = i % 2 == 0 ? 1.0 : -1.0;
  EXPECT_EQ(ShownMemory(series), 0.0);
  for (Index i = 0; i < 40; ++i) series[i] = i / 4 % 2 == 0 ? 1.0 : -1.0;
  EXPECT_GT(ShownMemory(series), 0.5);
  EXPECT_LE(ShownMemory(series), MemoryOf(series, kMostMemory));
  EXPECT_GT(ShownMemory(series), MemoryOf(series, 0.0));
  EXPECT_EQ(ShownMemory(VectorXd::Constant(40, 0.1)), 0.0);
}

TEST(MemoryBounds, RefuseInvalidLosses) {
  UnitLosses losses = MakeLosses(8);
  losses.mean_squares(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MemoryBounds{losses}, std::invalid_argument);
}

}  // namespace
}  // namespace errmap::stats
