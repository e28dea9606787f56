#include "stats/comparison/unit_bootstrap.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/distributions.h"
#include "stats/random.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr Index kResamples = 4999;
constexpr std::uint64_t kUnitBootstrapSeed = 1;

UnitLosses SixUnits() {
  UnitLosses losses;
  losses.mean_squares.resize(6, 2);
  losses.mean_squares << 1, 1.5,  //
      4, 2,                       //
      2, 1,                       //
      3, 3.5,                     //
      5, 2.5,                     //
      9, 4;
  losses.rows = VectorXd{{2, 1, 3, 2, 1, 1}};
  return losses;
}

UnitLosses RandomLosses(Index units, Index models) {
  Random random(3);
  UnitLosses losses;
  losses.mean_squares.resize(units, models);
  for (Index m = 0; m < models; ++m) {
    losses.mean_squares.col(m) = NormalSample(units, &random).cwiseAbs2();
  }
  losses.rows = VectorXd::Constant(units, 10.0);
  return losses;
}

// R 4.2.2, L1, L2 the losses and w the rows: M1 <- sum(w*L1)/sum(w); r1 <-
// sqrt(M1); g1 <- w*(L1-M1)/(2*r1)/mean(w); so for 2; se <- sqrt(sum(
// (g1-g2)^2)/30); r1 - r2 + c(-1, 1) * qt(.975, 5) * se.
TEST(UnitBootstrap, IsNeverNarrowerThanStudentsT) {
  constexpr double kLowerByT = -0.15838399200574355;
  constexpr double kUpperByT = 0.80351709628237078;
  const Bounds95 bounds =
      UnitBootstrap(SixUnits(), kResamples, kUnitBootstrapSeed)
          .OfDifference(0, 1);
  constexpr double kRounding = 1e-12;
  EXPECT_LE(bounds.lower, kLowerByT + kRounding);
  EXPECT_GE(bounds.upper, kUpperByT - kRounding);
  // One of the two ends is that of t itself, the other of the percentile.
  EXPECT_LT(std::min(std::abs(bounds.lower - kLowerByT),
                     std::abs(bounds.upper - kUpperByT)),
            kRounding);
  EXPECT_LT(bounds.at_most, bounds.upper);
  EXPECT_GT(bounds.at_least, bounds.lower);
  EXPECT_TRUE(bounds.exist());
}

// Three units of which one holds all the loss, an RMSE of 3: no resample can be
// worse, but another unit can.
TEST(UnitBootstrap, ReachesBeyondTheWorstUnit) {
  UnitLosses losses;
  losses.mean_squares = VectorXd{{0.0, 0.0, 9.0}};
  losses.rows = VectorXd::Ones(3);
  const Bounds95 bounds =
      UnitBootstrap(losses, kResamples, kUnitBootstrapSeed).OfRmse(0);
  // se = |(-3, -3, 6)| / (2 sqrt(3)) / sqrt(6) = sqrt(3) / 2; the quantile of t
  // with 2 degrees of freedom in closed form.
  const double t = 0.95 * std::sqrt(2.0 / (1.0 - 0.95 * 0.95));
  EXPECT_GE(bounds.upper, std::sqrt(3.0) * std::exp(0.5 * t));
  // One degree of freedom, as 9 of one unit in three tells no more.
  EXPECT_NEAR(
      bounds.upper, std::sqrt(3.0 / ChiSquaredQuantile(0.025, 1.0)), 1e-9);
  EXPECT_EQ(bounds.lower, 0.0);  // by the resamples without it
}

// Units that count for half leave half as many degrees of freedom.
TEST(UnitBootstrap, IsWiderWhereUnitsAreWorthLess) {
  const UnitBootstrap bootstrap(
      RandomLosses(20, 1), kResamples, kUnitBootstrapSeed);
  const Bounds95 all = bootstrap.OfRmse(0);
  const Bounds95 half = bootstrap.OfRmse(0, 0.5);
  EXPECT_LE(half.lower, all.lower);
  EXPECT_GT(half.upper, 1.1 * all.upper);
  EXPECT_LE(half.at_least, all.at_least);
  EXPECT_GT(half.at_most, all.at_most);
}

// With many units both methods agree with the normal interval.
TEST(UnitBootstrap, TendsToTheNormalIntervalWithManyUnits) {
  const UnitLosses losses = RandomLosses(2000, 2);
  const UnitBootstrap bootstrap(losses, kResamples, kUnitBootstrapSeed);
  const VectorXd rmse = PooledRmse(losses);
  const VectorXd g =
      (losses.mean_squares.col(0).array() - rmse[0] * rmse[0]) / (2 * rmse[0]) -
      (losses.mean_squares.col(1).array() - rmse[1] * rmse[1]) / (2 * rmse[1]);
  const double se = g.norm() / 2000.0;
  const Bounds95 bounds = bootstrap.OfDifference(0, 1);
  const double estimate = rmse[0] - rmse[1];
  constexpr double kDraws = 0.15;  // of a standard error: 4999 resamples
  EXPECT_NEAR(bounds.lower, estimate - 1.96 * se, kDraws * se);
  EXPECT_NEAR(bounds.upper, estimate + 1.96 * se, kDraws * se);
  EXPECT_NEAR(bounds.at_least, estimate - 1.645 * se, kDraws * se);
  EXPECT_NEAR(bounds.at_most, estimate + 1.645 * se, kDraws * se);
}

TEST(UnitBootstrap, TurnsSignWithTheOrderOfTheModels) {
  const UnitBootstrap bootstrap(SixUnits(), kResamples, kUnitBootstrapSeed);
  const Bounds95 ab = bootstrap.OfDifference(0, 1);
  const Bounds95 ba = bootstrap.OfDifference(1, 0);
  constexpr double kRounding = 1e-13;
  EXPECT_NEAR(ab.lower, -ba.upper, kRounding);
  EXPECT_NEAR(ab.upper, -ba.lower, kRounding);
  EXPECT_NEAR(ab.at_most, -ba.at_least, kRounding);
}

TEST(UnitBootstrap, ScalesWithTheUnitOfTheTarget) {
  UnitLosses losses = SixUnits();
  const Bounds95 in_um =
      UnitBootstrap(losses, kResamples, kUnitBootstrapSeed).OfDifference(0, 1);
  losses.mean_squares *= 1e-6;
  const Bounds95 in_mm =
      UnitBootstrap(losses, kResamples, kUnitBootstrapSeed).OfDifference(0, 1);
  EXPECT_NEAR(in_mm.lower, 1e-3 * in_um.lower, 1e-14);
  EXPECT_NEAR(in_mm.at_most, 1e-3 * in_um.at_most, 1e-14);
}

TEST(UnitBootstrap, KnowsEqualModelsToBeEqual) {
  UnitLosses losses = SixUnits();
  losses.mean_squares.col(1) = losses.mean_squares.col(0);
  const Bounds95 bounds =
      UnitBootstrap(losses, kResamples, kUnitBootstrapSeed).OfDifference(0, 1);
  EXPECT_EQ(bounds.lower, 0.0);
  EXPECT_EQ(bounds.upper, 0.0);
  EXPECT_TRUE(bounds.exist());
  EXPECT_FALSE(bounds.ExcludeZero());
}

TEST(UnitBootstrap, CopesWithAPerfectModel) {
  UnitLosses losses = SixUnits();
  losses.mean_squares.col(1).setZero();
  const UnitBootstrap bootstrap(losses, kResamples, kUnitBootstrapSeed);
  EXPECT_EQ(bootstrap.OfRmse(1).upper, 0.0);
  EXPECT_EQ(bootstrap.OfRmse(1).lower, 0.0);
  EXPECT_TRUE(bootstrap.OfDifference(0, 1).ExcludeZero());
}

TEST(UnitBootstrap, HasNoBoundsBelowTwoUnits) {
  for (const Index units : {0, 1}) {
    const UnitBootstrap bootstrap(
        RandomLosses(units, 2), kResamples, kUnitBootstrapSeed);
    EXPECT_FALSE(bootstrap.OfRmse(0).exist());
    EXPECT_FALSE(bootstrap.OfDifference(0, 1).exist());
    EXPECT_FALSE(bootstrap.OfDifference(0, 1).ExcludeZero());
  }
  EXPECT_TRUE(UnitBootstrap(RandomLosses(2, 2), kResamples, kUnitBootstrapSeed)
                  .OfRmse(0)
                  .exist());
}

TEST(UnitBootstrap, GivesTheSameForTheSameSeedOnly) {
  const auto lower = [](std::uint64_t seed) {
    return UnitBootstrap(RandomLosses(40, 1), 999, seed).OfRmse(0).lower;
  };
  EXPECT_EQ(lower(1), lower(1));
  EXPECT_NE(lower(1), lower(2));
}

TEST(UnitBootstrap, RefusesTooFewResamplesAndInvalidLosses) {
  EXPECT_THAT([] { UnitBootstrap(SixUnits(), 98, kUnitBootstrapSeed); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("at least 99 resamples, found 98")));
  UnitLosses losses = SixUnits();
  losses.mean_squares(2, 1) = -1.0;
  EXPECT_THROW(UnitBootstrap(losses, kResamples, kUnitBootstrapSeed),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::stats
