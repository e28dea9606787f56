#include "stats/comparison/ar1_t_test.h"

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
  const Ar1TTest bounds(losses);
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
//   g <- function(phi) {
//     R <- phi^abs(outer(u, u, "-")); A <- diag(n) - 1/n; V <- A %*% R
//     c(sqrt(sum(R) / n * (n - 1) / sum(diag(V))),
//       sum(diag(V))^2 / sum(diag(V %*% V))) }
//   k <- g(phi); se <- k[1] * sqrt(sum(x^2) / (n - 1) / n)
//   c(D, phi, k[2], D / se, 2 * pt(-abs(D / se), k[2]),
//     D + qt(c(.025, .975, .05, .95), k[2]) * se)
//   g(1/3); g(0.9)
TEST(Ar1TTest, AgreeWithRFromTheDefinition) {
  const MemoryTest found = OfTheFirstPair(MakeLosses(12));
  EXPECT_NEAR(found.memory, 0.165779297168752393, 1e-10);
  EXPECT_NEAR(found.degrees_of_freedom, 10.519682438656795753, 1e-9);
  EXPECT_NEAR(found.test.statistic, -2.940033451855907032, 1e-9);
  EXPECT_NEAR(found.test.p, 0.014051520696134056, 1e-10);
  EXPECT_NEAR(found.bounds.lower, -0.607477079937295272, 1e-9);
  EXPECT_NEAR(found.bounds.upper, -0.085666502056296945, 1e-9);
  EXPECT_NEAR(found.bounds.at_least, -0.559159098876141680, 1e-9);
  EXPECT_NEAR(found.bounds.at_most, -0.133984483117450509, 1e-9);
}

TEST(OfMean, AgreesWithTheCorrelationsAsAMatrix) {
  const MeanWithMemory weak = OfMean(12, 1.0 / 3.0);
  EXPECT_NEAR(weak.inflation, 1.4272481703946538, 1e-9);
  EXPECT_NEAR(weak.degrees_of_freedom, 9.2019685952123300, 1e-9);
  const MeanWithMemory strong = OfMean(12, 0.9);
  EXPECT_NEAR(strong.inflation, 4.9064451281181665, 1e-9);
  EXPECT_NEAR(strong.degrees_of_freedom, 3.1868355824416512, 1e-9);
  EXPECT_NEAR(OfMean(12, 0.0).inflation, 1.0, kRounding);
  EXPECT_NEAR(OfMean(12, 0.0).degrees_of_freedom, 11.0, 1e-9);
}

TEST(Ar1TTest, TurnWithThePairAndScaleWithTheUnit) {
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

TEST(Ar1TTest, NeedFourUnits) {
  for (const Index units : {0, 1, 3}) {
    const MemoryTest found = OfTheFirstPair(MakeLosses(units));
    EXPECT_FALSE(found.bounds.exist());
    EXPECT_THAT(found.test.why_not, HasSubstr("at least 4 units"));
  }
  EXPECT_TRUE(OfTheFirstPair(MakeLosses(4)).bounds.exist());
}

// The same values, once level by level and once mixed: only where neighbours
// are alike do they count for fewer.
TEST(Ar1TTest, AreWiderWhereNeighboursAreAlike) {
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
  EXPECT_NEAR(of_mixed.degrees_of_freedom, 39.0, 1e-9);
  EXPECT_GT(of_alike.bounds.upper - of_alike.bounds.lower,
            3.0 * (of_mixed.bounds.upper - of_mixed.bounds.lower));
}

TEST(Ar1TTest, KnowEqualModelsAndAConstantDifference) {
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

TEST(Ar1TTest, RefuseInvalidLosses) {
  UnitLosses losses = MakeLosses(8);
  losses.mean_squares(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Ar1TTest{losses}, std::invalid_argument);
}

}  // namespace
}  // namespace errmap::stats
