#include "models/study/judgement/confidence.h"

#include <cmath>

#include <gtest/gtest.h>

#include "stats/random.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = Obstacle::Kind;

// `units` of 10 rows, model m with an RMSE of about scale[m].
stats::UnitLosses MakeLosses(Index units, const VectorXd& scale) {
  stats::Random random(8);
  stats::UnitLosses losses;
  losses.mean_squares.resize(units, scale.size());
  for (Index unit = 0; unit < units; ++unit) {
    for (Index model = 0; model < scale.size(); ++model) {
      losses.mean_squares(unit, model) =
          scale[model] * scale[model] *
          stats::NormalSample(10, &random).squaredNorm() / 10.0;
    }
  }
  losses.rows = VectorXd::Constant(units, 10.0);
  return losses;
}

// All pairs of losses that agree in all but `difference` (units).
stats::Comparison CompareTwo(const VectorXd& difference) {
  stats::UnitLosses losses;
  losses.mean_squares = MatrixXd::Constant(difference.size(), 2, 10.0);
  losses.mean_squares.col(1) += difference;
  losses.rows = VectorXd::Constant(difference.size(), 10.0);
  return stats::CompareModels(losses, nullptr, {});
}

Confidence OfTheFirstPair(const stats::Comparison& tests,
                          bool separate_sessions = false) {
  return ThatTheyDiffer(tests, tests.pairs[0], separate_sessions);
}

TEST(Confidence, EstablishesAClearDifference) {
  const stats::Comparison found = stats::CompareModels(
      MakeLosses(12, VectorXd{{1.0, 1.02, 2.0}}), nullptr, {});
  EXPECT_FALSE(FindObstacle(found, false).exists());
  EXPECT_EQ(ThatTheyDiffer(found, found.Pair(0, 2), false),
            Confidence::kEstablished);
  EXPECT_EQ(ThatTheyDiffer(found, found.Pair(0, 1), false),
            Confidence::kNotShown);
}

TEST(Confidence, CountsHowManyPairsWereTested) {
  const stats::Comparison found = stats::CompareModels(
      MakeLosses(12, VectorXd{{1.0, 1.02, 2.0}}), nullptr, {});
  stats::PairComparison pair = found.Pair(0, 2);
  ASSERT_EQ(ThatTheyDiffer(found, pair, false), Confidence::kEstablished);
  // The same p among so many that one as small is to be expected.
  pair.p_holm = 0.2;
  EXPECT_EQ(ThatTheyDiffer(found, pair, false), Confidence::kNotShown);
}

TEST(Confidence, EstablishesNothingBelowSixUnits) {
  for (const Index units : {1, 2, 3, 5}) {
    const stats::Comparison found = stats::CompareModels(
        MakeLosses(units, VectorXd{{1.0, 100.0}}), nullptr, {});
    const Obstacle obstacle = FindObstacle(found, true);
    EXPECT_EQ(obstacle.kind, Kind::kTooFewUnits);
    EXPECT_EQ(obstacle.units, units);
    EXPECT_EQ(obstacle.needed, 6);
    EXPECT_EQ(OfTheFirstPair(found, true), Confidence::kOutOfReach);
    EXPECT_EQ(ThatItLosesAtMost(1.0, found, 0, 1, true),
              Confidence::kOutOfReach);
  }
}

// Who measures what was asked for is not asked for more.
TEST(Confidence, AsksForTheSameNumberOfUnitsHoweverFewThereAre) {
  for (const Index models : {2, 5, 9, 12}) {
    VectorXd scale = VectorXd::LinSpaced(models, 1.0, 2.0);
    Index needed = 0;
    for (const Index units : {2, 4, 6, 8}) {
      const Obstacle obstacle = FindObstacle(
          stats::CompareModels(MakeLosses(units, scale), nullptr, {}), true);
      if (!obstacle.exists()) continue;
      if (needed == 0) needed = obstacle.needed;
      EXPECT_EQ(obstacle.needed, needed) << units << " units";
    }
    EXPECT_FALSE(
        FindObstacle(
            stats::CompareModels(MakeLosses(needed, scale), nullptr, {}), true)
            .exists());
  }
}

TEST(Confidence, AsksForTwelveUnitsUnlessTheyAreSeparateSessions) {
  for (const Index units : {6, 11}) {
    const stats::Comparison found = stats::CompareModels(
        MakeLosses(units, VectorXd{{1.0, 100.0}}), nullptr, {});
    const Obstacle obstacle = FindObstacle(found, false);
    EXPECT_EQ(obstacle.kind, Kind::kPerhapsOneSession);
    EXPECT_EQ(obstacle.needed, 12);
    EXPECT_EQ(OfTheFirstPair(found), Confidence::kOutOfReach);
    EXPECT_EQ(ThatItLosesAtMost(1.0, found, 0, 1, false),
              Confidence::kOutOfReach);
    EXPECT_FALSE(FindObstacle(found, true).exists());
    EXPECT_EQ(OfTheFirstPair(found, true), Confidence::kEstablished);
    EXPECT_EQ(ThatItLosesAtMost(1.0, found, 0, 1, true),
              Confidence::kEstablished);
  }
}

// 2/2^12 * 105 pairs is above 5 %, 2/2^13 * 105 below.
TEST(Confidence, SaysWhenThereAreTooFewUnitsForSoManyPairs) {
  VectorXd scale = VectorXd::LinSpaced(15, 0.0, 14.0);
  for (double& value : scale) value = std::pow(10.0, value);
  const stats::Comparison twelve =
      stats::CompareModels(MakeLosses(12, scale), nullptr, {});
  const Obstacle obstacle = FindObstacle(twelve, false);
  EXPECT_EQ(obstacle.kind, Kind::kTooManyPairs);
  EXPECT_EQ(obstacle.units, 12);
  EXPECT_EQ(obstacle.pairs, 105);
  EXPECT_EQ(obstacle.needed, 13);
  EXPECT_EQ(OfTheFirstPair(twelve), Confidence::kOutOfReach);
  const stats::Comparison thirteen =
      stats::CompareModels(MakeLosses(13, scale), nullptr, {});
  EXPECT_FALSE(FindObstacle(thirteen, false).exists());
  EXPECT_EQ(ThatTheyDiffer(thirteen, thirteen.Pair(0, 14), false),
            Confidence::kEstablished);
  const stats::Comparison few_draws =
      stats::CompareModels(MakeLosses(40, scale), nullptr, {.flips = 99});
  EXPECT_EQ(FindObstacle(few_draws, false).kind, Kind::kTooFewSignPatterns);
}

// Half of the units favour the second model by more than the others do the
// first: a level that lasts is not independent evidence.
TEST(Confidence, TakesUnitsThatResembleTheirNeighboursForNoEvidence) {
  VectorXd lasting(35);
  for (Index unit = 0; unit < 35; ++unit) {
    lasting[unit] =
        (unit / 9 % 2 == 0 ? 2.0 : 0.2) + 0.05 * static_cast<double>(unit % 3);
  }
  const stats::Comparison found = CompareTwo(lasting);
  EXPECT_TRUE(found.pairs[0].correlated);
  EXPECT_LE(found.pairs[0].sign_flip.test.p, stats::kSignificance);
  EXPECT_GT(found.pairs[0].p_holm, stats::kSignificance);
  EXPECT_EQ(OfTheFirstPair(found), Confidence::kUnitsCorrelated);
  EXPECT_EQ(ThatItLosesAtMost(5.0, found, 1, 0, false),
            Confidence::kUnitsCorrelated);
}

// In 14 units a lag-1 correlation may hide that would make as much.
TEST(Confidence, AllowsForTheMemoryThatFewUnitsCannotExclude) {
  const VectorXd uneven{{6.0,
                         4.0,
                         5.0,
                         -2.0,
                         -1.0,
                         0.0,
                         6.0,
                         1.5,
                         2.0,
                         -1.0,
                         3.0,
                         -1.0,
                         5.0,
                         2.5}};
  const stats::Comparison found = CompareTwo(uneven);
  EXPECT_FALSE(found.pairs[0].correlated);
  EXPECT_LE(found.pairs[0].p_holm, stats::kSignificance);
  EXPECT_TRUE(found.pairs[0].bounds.ExcludeZero());
  EXPECT_EQ(OfTheFirstPair(found), Confidence::kMemoryNotExcluded);
}

// Three runs of seven units agree, two do not, with no correlation of single
// neighbours: noise hides it.
TEST(Confidence, AsksRunsOfNeighboursToAgree) {
  VectorXd uneven(35);
  for (Index unit = 0; unit < 35; ++unit) {
    uneven[unit] = (unit / 7 < 3 ? 1.3 : 0.1) + (unit % 2 == 0 ? 1.0 : -1.0);
  }
  const stats::Comparison found = CompareTwo(uneven);
  EXPECT_FALSE(found.pairs[0].correlated);
  EXPECT_LE(found.pairs[0].p_holm, stats::kSignificance);
  EXPECT_LE(found.pairs[0].p_memory_holm, stats::kSignificance);
  EXPECT_EQ(OfTheFirstPair(found), Confidence::kBlocksDisagree);
}

TEST(Confidence, BoundsALossByTheMargin) {
  const stats::Comparison found = CompareTwo(VectorXd{
      {0.1, -0.1, 0.2, -0.2, 0.1, 0.0, -0.1, 0.1, -0.2, 0.2, 0.0, -0.1}});
  EXPECT_EQ(ThatItLosesAtMost(0.1, found, 0, 1, false),
            Confidence::kEstablished);
  EXPECT_EQ(ThatItLosesAtMost(0.1, found, 1, 0, false),
            Confidence::kEstablished);
  EXPECT_EQ(ThatItLosesAtMost(0.001, found, 0, 1, false),
            Confidence::kNotShown);
}

TEST(Confidence, BoundsTheLossOfTheWorseOneOnly) {
  // The second errs by a tenth more.
  const stats::Comparison found = CompareTwo(
      VectorXd{{2.1, 1.9, 2.2, 1.8, 2.1, 2.0, 1.9, 2.1, 1.8, 2.2, 2.0, 1.9}});
  EXPECT_EQ(ThatItLosesAtMost(0.001, found, 0, 1, false),
            Confidence::kEstablished);
  EXPECT_EQ(ThatItLosesAtMost(0.001, found, 1, 0, false),
            Confidence::kNotShown);
}

// One unit of 1000 rows outweighs eleven of 5 that point the other way: all
// figures are of the pooled error, and a single unit establishes nothing.
TEST(Confidence, EstablishesNothingWhereRowsAndUnitsDisagree) {
  stats::UnitLosses losses;
  losses.mean_squares = MatrixXd::Constant(12, 2, 1.0);
  losses.rows = VectorXd::Constant(12, 5.0);
  for (Index unit = 0; unit < 12; ++unit) {
    losses.mean_squares(unit, 1) = 2.0 + 0.01 * static_cast<double>(unit);
  }
  losses.rows[11] = 1000.0;
  losses.mean_squares(11, 1) = 0.9;
  const stats::Comparison found = stats::CompareModels(losses, nullptr, {});
  EXPECT_GT(found.pairs[0].p_holm, stats::kSignificance);
  EXPECT_EQ(OfTheFirstPair(found), Confidence::kNotShown);
}

TEST(Confidence, NeedsUnitsAndAPair) {
  const stats::Comparison no_units =
      stats::CompareModels(MakeLosses(0, VectorXd::Ones(2)), nullptr, {});
  EXPECT_EQ(OfTheFirstPair(no_units), Confidence::kOutOfReach);
  const stats::Comparison one_model =
      stats::CompareModels(MakeLosses(12, VectorXd::Ones(1)), nullptr, {});
  EXPECT_FALSE(FindObstacle(one_model, false).exists());
}

TEST(Confidence, CallsEqualModelsEqual) {
  const stats::Comparison found = CompareTwo(VectorXd::Zero(20));
  EXPECT_EQ(OfTheFirstPair(found), Confidence::kNotShown);
  EXPECT_EQ(ThatItLosesAtMost(0.0, found, 0, 1, false),
            Confidence::kEstablished);
}

}  // namespace
}  // namespace errmap::models
