#include "stats/comparison/paired_comparison.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/comparison/holm.h"
#include "stats/random.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

// `units` of 10 rows, model m with an RMSE of about scale[m].
UnitLosses MakeLossesInPairedComparison(Index units, const VectorXd& scale) {
  Random random(8);
  UnitLosses losses;
  losses.mean_squares.resize(units, scale.size());
  for (Index unit = 0; unit < units; ++unit) {
    for (Index model = 0; model < scale.size(); ++model) {
      losses.mean_squares(unit, model) =
          scale[model] * scale[model] *
          NormalSample(10, &random).squaredNorm() / 10.0;
    }
  }
  losses.rows = VectorXd::Constant(units, 10.0);
  return losses;
}

FoldLosses MakeFolds(Index folds, Index models) {
  FoldLosses losses;
  losses.mean_squares = MatrixXd::Ones(folds, models);
  for (Index fold = 0; fold < folds; ++fold) {
    losses.mean_squares(fold, 0) = 2.0 + static_cast<double>(fold);
  }
  losses.test_rows = VectorXd::Constant(folds, 20.0);
  losses.train_rows = VectorXd::Constant(folds, 80.0);
  return losses;
}

TEST(CompareModels, FindsAClearDifference) {
  const UnitLosses losses =
      MakeLossesInPairedComparison(12, VectorXd{{1.0, 1.02, 2.0}});
  const Comparison found = CompareModels(losses, nullptr, {});
  EXPECT_EQ(found.num_units, 12);
  ASSERT_EQ(found.pairs.size(), 3U);
  ASSERT_EQ(found.rmse_bounds.size(), 3U);
  const PairComparison& clear = found.Pair(2, 0);
  EXPECT_EQ(clear.a, 0);
  EXPECT_EQ(clear.b, 2);
  EXPECT_LT(clear.bounds.upper, 0.0);
  EXPECT_DOUBLE_EQ(clear.difference, found.rmse[0] - found.rmse[2]);
  EXPECT_DOUBLE_EQ(clear.sign_flip.test.p, 2.0 / 4096.0);
  EXPECT_DOUBLE_EQ(clear.p_holm, 6.0 / 4096.0);
  EXPECT_GT(found.Pair(0, 1).p_holm, kSignificance);
  // Not told apart is no reason to be alike.
  EXPECT_THAT(found.tiers, testing::SizeIs(3));
}

TEST(CompareModels, TestsFiveRunsOfUnitsAsIfEachWereHeldOut) {
  const UnitLosses losses =
      MakeLossesInPairedComparison(12, VectorXd{{1.0, 1.5}});
  const VectorXd d = losses.mean_squares.col(0) - losses.mean_squares.col(1);
  const VectorXd runs{{d.segment(0, 3).mean(),
                       d.segment(3, 3).mean(),
                       d.segment(6, 2).mean(),
                       d.segment(8, 2).mean(),
                       d.segment(10, 2).mean()}};
  EXPECT_NEAR(CompareModels(losses, nullptr, {}).pairs[0].block_t.test.p,
              CorrectedResampledT(runs, 0.3).test.p,
              1e-12);
}

TEST(CompareModels, AdjustsOverAllPairs) {
  const Comparison found = CompareModels(
      MakeLossesInPairedComparison(9, VectorXd{{1.0, 1.2, 1.4, 1.6}}),
      nullptr,
      {});
  std::vector<double> p;
  std::vector<double> p_memory;
  for (const PairComparison& pair : found.pairs) {
    p.push_back(pair.p);
    p_memory.push_back(pair.memory.test.p);
  }
  const std::vector<double> adjusted = AdjustByHolm(p);
  const std::vector<double> memory_adjusted = AdjustByHolm(p_memory);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_EQ(found.pairs[i].p_holm, adjusted[i]);
    EXPECT_EQ(found.pairs[i].p_memory_holm, memory_adjusted[i]);
  }
}

TEST(CompareModels, FindsEveryPairWhicheverComesFirst) {
  const Comparison found = CompareModels(
      MakeLossesInPairedComparison(7, VectorXd::Ones(5)), nullptr, {});
  for (Index a = 0; a < 5; ++a) {
    for (Index b = 0; b < 5; ++b) {
      if (a == b) continue;
      EXPECT_EQ(found.Pair(a, b).a, std::min(a, b));
      EXPECT_EQ(found.Pair(a, b).b, std::max(a, b));
      EXPECT_GT(found.Pair(a, b).bounds.ExcessAtMost(a < b),
                found.rmse[a] - found.rmse[b]);
    }
  }
  EXPECT_THROW(found.Pair(2, 2), std::out_of_range);
  EXPECT_THROW(found.Pair(0, 5), std::out_of_range);
  EXPECT_THROW(found.Pair(-1, 2), std::out_of_range);
}

TEST(CompareModels, TestsFoldsAndTimeOnlyWhereTheyAreGiven) {
  UnitLosses losses = MakeLossesInPairedComparison(10, VectorXd{{1.0, 1.5}});
  const Comparison without = CompareModels(losses, nullptr, {});
  EXPECT_FALSE(without.pairs[0].corrected_t.has_value());
  EXPECT_FALSE(without.pairs[0].diebold_mariano.has_value());
  losses.time_ordered = true;
  const FoldLosses folds = MakeFolds(5, 2);
  const Comparison with = CompareModels(losses, &folds, {});
  const VectorXd d = losses.mean_squares.col(0) - losses.mean_squares.col(1);
  EXPECT_EQ(with.pairs[0].diebold_mariano->test.p, DieboldMariano(d).test.p);
  EXPECT_EQ(with.pairs[0].corrected_t->test.p,
            CorrectedResampledT(VectorXd{{1, 2, 3, 4, 5}}, 0.25).test.p);
}

// The answer does not hang on the order of models, nor on the unit of length.
TEST(CompareModels, KeepsItsAnswerWithOtherOrderAndScale) {
  const UnitLosses losses =
      MakeLossesInPairedComparison(40, VectorXd{{1.0, 1.15, 1.6}});
  UnitLosses turned = losses;
  turned.mean_squares = 1e-6 * losses.mean_squares.rowwise().reverse();
  const Comparison a = CompareModels(losses, nullptr, {});
  const Comparison b = CompareModels(turned, nullptr, {});
  constexpr double kRounding = 1e-12;
  for (Index i = 0; i < 3; ++i) {
    for (Index j = i + 1; j < 3; ++j) {
      const PairComparison& one = a.Pair(i, j);
      const PairComparison& other = b.Pair(2 - i, 2 - j);
      EXPECT_NEAR(one.difference, -1e3 * other.difference, kRounding);
      EXPECT_NEAR(one.bounds.lower, -1e3 * other.bounds.upper, kRounding);
      EXPECT_EQ(one.sign_flip.test.p, other.sign_flip.test.p);
      EXPECT_NEAR(one.p_holm, other.p_holm, kRounding);
      EXPECT_EQ(one.wilcoxon.test.p, other.wilcoxon.test.p);
      EXPECT_NEAR(one.p_memory_holm, other.p_memory_holm, kRounding);
    }
  }
}

TEST(CompareModels, BoundsDifferencesFromTwoUnitsOnAndWithMemoryFromFour) {
  for (const Index units : {1, 2, 3, 5}) {
    const Comparison found = CompareModels(
        MakeLossesInPairedComparison(units, VectorXd{{1.0, 100.0}}),
        nullptr,
        {});
    EXPECT_EQ(found.pairs[0].bounds.exist(), units >= 2);
    EXPECT_EQ(found.pairs[0].memory.bounds.exist(), units >= 4);
  }
}

TEST(CompareModels, PutsModelsAloneWhereNoBoundExists) {
  UnitLosses losses =
      MakeLossesInPairedComparison(1, VectorXd{{1.0, 1.0, 1.0}});
  losses.mean_squares << 1.0, 1.0, 1.001;
  const Comparison found = CompareModels(losses, nullptr, {});
  EXPECT_THAT(found.tiers, ElementsAre(ElementsAre(0, 1), ElementsAre(2)));
}

TEST(CompareModels, CallsEqualModelsEqual) {
  UnitLosses losses = MakeLossesInPairedComparison(20, VectorXd{{1.0, 1.0}});
  losses.mean_squares.col(1) = losses.mean_squares.col(0);
  losses.time_ordered = true;
  const FoldLosses folds{.mean_squares = MatrixXd::Ones(5, 2),
                         .test_rows = VectorXd::Ones(5),
                         .train_rows = VectorXd::Ones(5)};
  const Comparison found = CompareModels(losses, &folds, {});
  const PairComparison& pair = found.pairs[0];
  EXPECT_EQ(pair.difference, 0.0);
  EXPECT_TRUE(pair.tied);
  for (const double p : {pair.sign_flip.test.p,
                         pair.p,
                         pair.p_holm,
                         pair.wilcoxon.test.p,
                         pair.corrected_t->test.p,
                         pair.block_t.test.p,
                         pair.diebold_mariano->test.p,
                         pair.memory.test.p,
                         pair.p_memory_holm}) {
    EXPECT_TRUE(std::isnan(p));
  }
  EXPECT_EQ(found.num_tested, 0);
  EXPECT_EQ(pair.bounds.upper, 0.0);
  EXPECT_FALSE(pair.lag1.ok());
  EXPECT_FALSE(pair.correlated);
  EXPECT_THAT(found.tiers, ElementsAre(ElementsAre(0, 1)));
}

// Two fits of one map by different orders of arithmetic.
TEST(CompareModels, TestsNothingBetweenMapsThatDifferByRounding) {
  const UnitLosses two = MakeLossesInPairedComparison(12, VectorXd{{1.0, 2.0}});
  UnitLosses three = two;
  three.mean_squares.conservativeResize(Eigen::NoChange, 3);
  three.mean_squares.col(2) = (1.0 + 1e-13) * two.mean_squares.col(0);
  const Comparison found = CompareModels(three, nullptr, {});
  EXPECT_TRUE(found.Pair(0, 2).tied);
  EXPECT_TRUE(std::isnan(found.Pair(0, 2).p_holm));
  EXPECT_EQ(found.num_tested, 2);
  // Of two tests the smaller p counts twice, not three times.
  const PairComparison& pair = found.Pair(0, 1);
  EXPECT_FALSE(pair.tied);
  EXPECT_EQ(pair.p_holm, 2.0 * pair.p);
  EXPECT_EQ(found.num_asked, 3);
  EXPECT_EQ(found.tiers, (std::vector<std::vector<Index>>{{0, 2}, {1}}));
}

// Two pairs in turn, the lower error first, then Holm's adjustment of all
// others.
TEST(CompareModels, TestsWhatItIsAboutAgainstEachYardstickBeforeAllElse) {
  const UnitLosses losses =
      MakeLossesInPairedComparison(12, VectorXd{{1.0, 1.5, 2.0, 1.4, 1.6}});
  const Comparison found =
      CompareModels(losses, nullptr, {.first = 0, .yardsticks = {4, 3}});
  const PairComparison& one = found.Pair(0, 3);
  const PairComparison& two = found.Pair(0, 4);
  ASSERT_LT(found.rmse[3], found.rmse[4]);
  // In one direction: that the first is better.
  EXPECT_EQ(one.p_holm, 0.5 * one.p);
  EXPECT_TRUE(one.one_sided);
  EXPECT_EQ(one.num_adjusted, 1);
  EXPECT_EQ(two.p_holm, 0.5 * std::max(one.p, two.p));
  EXPECT_EQ(two.p_memory_holm,
            0.5 * std::max(one.memory.test.p, two.memory.test.p));
  std::vector<double> p;
  for (const PairComparison& pair : found.pairs) {
    if (&pair != &one && &pair != &two) p.push_back(pair.p);
  }
  ASSERT_EQ(p.size(), 8U);
  EXPECT_EQ(found.num_tested, 8);
  EXPECT_EQ(found.num_asked, 8);
  const std::vector<double> adjusted = AdjustByHolm(p);
  std::size_t i = 0;
  for (const PairComparison& pair : found.pairs) {
    if (&pair == &one || &pair == &two) continue;
    EXPECT_EQ(pair.p_holm, std::max(two.p_holm, adjusted[i++]));
    EXPECT_EQ(pair.num_adjusted, 8);
  }
  EXPECT_EQ(CompareModels(losses, nullptr, {.yardsticks = {3, 4}}).num_tested,
            10);
  EXPECT_EQ(
      CompareModels(losses, nullptr, {.first = 0, .yardsticks = {1, 2, 3, 4}})
          .num_asked,
      0);
}

// However clear the others are: the error of the whole stays at the level.
TEST(CompareModels, ShowsNothingBehindAYardstickThatIsNotBeaten) {
  const Comparison found = CompareModels(
      MakeLossesInPairedComparison(20, VectorXd{{1.0, 9.0, 1.0, 0.1}}),
      nullptr,
      {.first = 0, .yardsticks = {1, 2, 3}});
  EXPECT_LE(found.Pair(0, 3).p, kSignificance);
  // That the yardstick is the better one was not asked.
  const double not_beaten = found.Pair(0, 3).p_holm;
  EXPECT_GT(not_beaten, 1.0 - kSignificance);
  for (const auto& [a, b] : {std::pair(0, 1), {0, 2}, {1, 2}, {1, 3}, {2, 3}}) {
    EXPECT_GE(found.Pair(a, b).p_holm, not_beaten);
  }
}

// A gain over a distant yardstick that differs much from unit to unit does not
// hide the one over the yardstick that matters.
TEST(CompareModels, ShowsTheGainOverTheBestYardstickWhateverADistantOneHides) {
  UnitLosses losses =
      MakeLossesInPairedComparison(8, VectorXd{{1.0, 1.0, 2.0}});
  losses.mean_squares.col(1).setConstant(0.1);
  losses.mean_squares(3, 1) = 300.0;
  const Comparison found =
      CompareModels(losses, nullptr, {.first = 0, .yardsticks = {1, 2}});
  EXPECT_GT(found.Pair(0, 1).p_holm, kSignificance);
  EXPECT_LE(found.Pair(0, 2).p_holm, kSignificance);
}

// A yardstick that is the first model itself but for rounding has no turn.
TEST(CompareModels, PassesOverAYardstickThatIsTied) {
  UnitLosses losses =
      MakeLossesInPairedComparison(12, VectorXd{{1.0, 1.0, 2.0}});
  losses.mean_squares.col(1) = losses.mean_squares.col(0);
  const Comparison found =
      CompareModels(losses, nullptr, {.first = 0, .yardsticks = {1, 2}});
  EXPECT_TRUE(std::isnan(found.Pair(0, 1).p_holm));
  EXPECT_EQ(found.Pair(0, 2).p_holm, 0.5 * found.Pair(0, 2).p);
}

// Units of 1 to 500 rows: what is tested is what is shown.
TEST(CompareModels, HasOneSideForDifferenceIntervalAndTests) {
  Random random(63);
  int significant = 0;
  for (int repetition = 0; repetition < 300; ++repetition) {
    UnitLosses losses;
    losses.mean_squares.resize(12, 2);
    losses.rows.resize(12);
    for (Index unit = 0; unit < 12; ++unit) {
      const VectorXd z = NormalSample(3, &random);
      losses.rows[unit] = std::ceil(std::exp(2.0 * std::abs(z[0])));
      losses.mean_squares.row(unit) << std::exp(z[1]),
          std::exp(z[2]) * (repetition % 2 == 0 ? 1.0 : 3.0);
    }
    const Comparison found = CompareModels(losses, nullptr, {.resamples = 199});
    const PairComparison& pair = found.pairs[0];
    EXPECT_GT(pair.sign_flip.test.statistic * pair.difference, 0.0);
    EXPECT_LT(pair.bounds.lower, pair.difference);
    EXPECT_GT(pair.bounds.upper, pair.difference);
    if (pair.p <= kSignificance) ++significant;
  }
  EXPECT_GT(significant, 50);
}

TEST(CompareModels, AllowsForTheMemoryThatUnitsShow) {
  UnitLosses alike = MakeLossesInPairedComparison(40, VectorXd{{1.0, 1.0}});
  UnitLosses mixed = alike;
  for (Index unit = 0; unit < 40; ++unit) {
    alike.mean_squares(unit, 0) += unit < 24 ? 1.2 : -0.3;
    mixed.mean_squares(unit, 0) += (7 * unit) % 40 < 24 ? 1.2 : -0.3;
  }
  alike.mean_squares = alike.mean_squares.cwiseAbs();
  mixed.mean_squares = mixed.mean_squares.cwiseAbs();
  const PairComparison of_alike = CompareModels(alike, nullptr, {}).pairs[0];
  const PairComparison of_mixed = CompareModels(mixed, nullptr, {}).pairs[0];
  EXPECT_EQ(of_mixed.memory_shown, 0.0);
  EXPECT_EQ(of_mixed.p, of_mixed.sign_flip.test.p);
  EXPECT_GT(of_alike.memory_shown, 0.5);
  EXPECT_LT(of_alike.sign_flip.test.p, kSignificance);
  EXPECT_GT(of_alike.p, kSignificance);
  EXPECT_GT(of_alike.bounds.upper - of_alike.bounds.lower,
            1.5 * (of_mixed.bounds.upper - of_mixed.bounds.lower));
}

// Units that wander off: those measured vary less than what is to come. What
// independent ones show must not be lost for it.
TEST(CompareModels, BoundsTheErrorToComeWhateverTheMemoryOfUnits) {
  constexpr int kSets = 1000;
  constexpr Index kUnits = 10;
  constexpr double kWithin = 0.25;  // mean square
  for (const double memory : {0.0, 0.9}) {
    Random random(1);
    int shown = 0;
    int held = 0;
    for (int set = 0; set < kSets; ++set) {
      const VectorXd x = AutoregressionSample(kUnits, memory, &random);
      // What the mean of all others leaves of each.
      const double n = kUnits;
      const VectorXd left = (x.array() - x.mean()) * n / (n - 1.0);
      const Bounds95 bounds =
          CompareModels({.mean_squares = left.array().square() + kWithin,
                         .rows = VectorXd::Ones(kUnits),
                         .means = left},
                        nullptr,
                        {.flips = 99, .resamples = 199})
              .rmse_bounds[0];
      const double truth = std::sqrt(1.0 + kWithin + x.mean() * x.mean());
      shown += bounds.exist();
      held += bounds.lower <= truth && truth <= bounds.upper;
    }
    EXPECT_GE(shown, 0.95 * kSets) << memory;
    EXPECT_GE(held, 0.9 * shown) << memory;
  }
}

// Far apart and few: a bound of ten times the error is none.
TEST(CompareModels, BoundsNoErrorByThreeUnitsFarApart) {
  UnitLosses losses = MakeLossesInPairedComparison(3, VectorXd{{1.0, 1.0}});
  losses.means = MatrixXd::Zero(3, 2);
  losses.means.col(0) << 3.0, -3.0, 0.0;
  losses.mean_squares = losses.means.cwiseAbs2().array() + 1.0;
  const Comparison found = CompareModels(losses, nullptr, {});
  EXPECT_FALSE(found.rmse_bounds[0].exist());
  EXPECT_TRUE(found.rmse_bounds[1].exist());
}

TEST(CompareModels, WarnsOfUnitsThatResembleTheirNeighbours) {
  UnitLosses losses = MakeLossesInPairedComparison(35, VectorXd{{1.0, 1.0}});
  EXPECT_FALSE(CompareModels(losses, nullptr, {}).pairs[0].correlated);
  for (Index unit = 0; unit < 35; ++unit) {
    losses.mean_squares(unit, 0) += unit < 17 ? 2.0 : 0.0;
  }
  const Comparison drifting = CompareModels(losses, nullptr, {});
  EXPECT_TRUE(drifting.pairs[0].correlated);
  EXPECT_GT(drifting.pairs[0].lag1.statistic, 0.5);
  // Alternation is memory too, but makes no p too small.
  for (Index unit = 0; unit < 35; ++unit) {
    losses.mean_squares(unit, 0) = unit % 2 == 0 ? 3.0 : 1.0;
  }
  EXPECT_FALSE(CompareModels(losses, nullptr, {}).pairs[0].correlated);
}

TEST(CompareModels, GivesTheSameForTheSameSeedOnly) {
  const UnitLosses losses =
      MakeLossesInPairedComparison(40, VectorXd{{1.0, 1.05}});
  const auto run = [&losses](std::uint64_t seed) {
    return CompareModels(losses, nullptr, {.seed = seed}).pairs[0];
  };
  EXPECT_EQ(run(1).sign_flip.test.p, run(1).sign_flip.test.p);
  EXPECT_EQ(run(1).bounds.upper, run(1).bounds.upper);
  EXPECT_NE(run(1).sign_flip.test.p, run(2).sign_flip.test.p);
}

TEST(CompareModels, ComparesNoUnitsNoModelsAndOne) {
  const Comparison no_units = CompareModels(
      MakeLossesInPairedComparison(0, VectorXd::Ones(2)), nullptr, {});
  EXPECT_TRUE(std::isnan(no_units.rmse[0]));
  EXPECT_EQ(no_units.pairs[0].sign_flip.test.why_not, "no units");
  EXPECT_THAT(no_units.tiers, IsEmpty());
  const Comparison no_models =
      CompareModels(MakeLossesInPairedComparison(9, VectorXd()), nullptr, {});
  EXPECT_THAT(no_models.pairs, IsEmpty());
  EXPECT_THAT(no_models.tiers, IsEmpty());
  const Comparison one = CompareModels(
      MakeLossesInPairedComparison(9, VectorXd::Ones(1)), nullptr, {});
  EXPECT_THAT(one.pairs, IsEmpty());
  EXPECT_THAT(one.tiers, ElementsAre(ElementsAre(0)));
  EXPECT_TRUE(one.rmse_bounds[0].exist());
}

TEST(CompareModels, RefusesInvalidLossesFoldsAndOptions) {
  const UnitLosses losses = MakeLossesInPairedComparison(8, VectorXd::Ones(2));
  UnitLosses bad = losses;
  bad.mean_squares(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(
      [&] { CompareModels(bad, nullptr, {}); },
      ThrowsMessage<std::invalid_argument>(HasSubstr("unit 3, model 1")));
  const FoldLosses other_models = MakeFolds(5, 3);
  EXPECT_THAT(
      [&] { CompareModels(losses, &other_models, {}); },
      ThrowsMessage<std::invalid_argument>(HasSubstr("5 folds of 3 models")));
  FoldLosses folds = MakeFolds(5, 2);
  folds.train_rows[2] = 0.0;
  EXPECT_THAT([&] { CompareModels(losses, &folds, {}); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("rows must be finite and above 0")));
  folds = MakeFolds(5, 2);
  folds.mean_squares(0, 0) = -1.0;
  EXPECT_THAT([&] { CompareModels(losses, &folds, {}); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("mean square must be finite and at least 0")));
}

TEST(ComparisonOptions, AreCheckedFieldByField) {
  EXPECT_NO_THROW(ComparisonOptions().Validate());
  EXPECT_THAT([] { ComparisonOptions{.flips = 0}.Validate(); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("flips must be at least 1, found 0")));
  EXPECT_THAT([] { ComparisonOptions{.resamples = 98}.Validate(); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("resamples must be at least 99, found 98")));
  EXPECT_THROW(ComparisonOptions{.margin = {.share = -1.0}}.Validate(),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::stats
