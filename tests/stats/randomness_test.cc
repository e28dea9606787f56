#include "stats/randomness.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/bias.h"
#include "stats/random.h"
#include "tests/models/serial_reference.h"
#include "tests/stats/golden_samples.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const std::vector<std::string>& OrderedSampleNames() {
  static const std::vector<std::string> names(GoldenSampleNames().begin(),
                                              GoldenSampleNames().end() - 1);
  return names;
}

TEST(TestSerially, ReproducesROnEverySample) {
  constexpr double kStatistic = 1e-10;
  constexpr double kRelativeP = 1e-9;
  for (const std::string& name : OrderedSampleNames()) {
    const auto& r = SerialReference(name);
    const SerialTests found = TestSerially({GoldenSample(name)});
    EXPECT_NEAR(found.lag1.statistic, r.at("acf1"), kStatistic) << name;
    EXPECT_NEAR(
        found.durbin_watson.statistic, r.at("durbin_watson"), kStatistic)
        << name;
    EXPECT_NEAR(found.ljung_box.statistic,
                r.at("ljung_box"),
                kStatistic * r.at("ljung_box"))
        << name;
    EXPECT_NEAR(found.ljung_box.p, r.at("ljung_box_p"), kRelativeP) << name;
    EXPECT_NEAR(found.runs.statistic, r.at("runs_z"), kStatistic) << name;
    if (name.find("_20") == std::string::npos) {  // exact p below that
      EXPECT_NEAR(found.runs.p, r.at("runs_p"), kRelativeP) << name;
    }
  }
}

// By enumeration of the C(6, 3) = 20 orders of three values above and three
// below: 2, 3, 4, 5, 6 runs in 2, 4, 8, 4, 2 of them.
TEST(TestSerially, RunsPIsExactForFewValues) {
  const auto p = [](const VectorXd& x) { return TestSerially({x}).runs.p; };
  constexpr double kRounding = 1e-14;
  EXPECT_NEAR(p(VectorXd{{-1, -2, -3, 1, 2, 3}}), 0.2, kRounding);
  EXPECT_NEAR(p(VectorXd{{-1, -2, 1, 2, 3, -3}}), 0.6, kRounding);
  EXPECT_NEAR(p(VectorXd{{-1, 1, -2, 2, -3, 3}}), 0.2, kRounding);
  EXPECT_NEAR(p(VectorXd{{-1, -2, 1, 2, -3, 3}}), 1.0, kRounding);
}

TEST(TestSerially, CountsRunsWithinGroupsApart) {
  const VectorXd x{{-1, -2, 5, 6, -3, 7, -4, 8}};
  // In order - - + + - + - +; in the groups {0 .. 3} and {4 .. 7} 2 and 4 runs.
  EXPECT_EQ(TestSerially({x}).num_runs, 6);
  const SerialTests within =
      TestSerially(SegmentsByGroup(x, {0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(within.num_runs, 6);
  EXPECT_DOUBLE_EQ(within.expected_runs, 6.0);
  // Interleaved groups keep their own order.
  EXPECT_EQ(TestSerially(SegmentsByGroup(x, {0, 0, 1, 1, 0, 1, 0, 1})).num_runs,
            2);
}

// Offsets of whole groups are memory in the order, none within the groups.
TEST(TestSerially, TellsGroupOffsetsFromMemoryWithinGroups) {
  constexpr Index kGroups = 40;
  constexpr Index kEach = 10;
  Random random(3);
  VectorXd x = NormalSample(kGroups * kEach, &random);
  std::vector<Index> codes;
  for (Index i = 0; i < x.size(); ++i) {
    codes.push_back(i / kEach);
    x[i] += 3.0 * static_cast<double>((i / kEach) % 2);
  }
  EXPECT_LT(TestSerially({x}).lag1.p, 1e-6);
  const SerialTests within = TestSerially(SegmentsByGroup(x, codes));
  EXPECT_GT(within.lag1.p, 0.01);
  EXPECT_GT(within.durbin_watson.p, 0.01);
  EXPECT_GT(within.ljung_box.p, 0.01);
}

TEST(TestSerially, DependsOnOrderButNotOnShiftOrScale) {
  constexpr double kRounding = 1e-9;
  const VectorXd x = GoldenSample("appendix_b_residual");
  const SerialTests a = TestSerially({x});
  const SerialTests b = TestSerially({VectorXd(1e-200 * x)});
  const SerialTests c = TestSerially({VectorXd(1e3 * x.array() + 2.0)});
  for (const SerialTests* other : {&b, &c}) {
    EXPECT_NEAR(other->lag1.statistic, a.lag1.statistic, kRounding);
    EXPECT_NEAR(
        other->durbin_watson.statistic, a.durbin_watson.statistic, kRounding);
    EXPECT_EQ(other->num_runs, a.num_runs);
  }
  VectorXd sorted = x;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(TestSerially({sorted}).num_runs, 2);
  EXPECT_GT(TestSerially({sorted}).lag1.statistic, 0.9);
}

TEST(TestSerially, SaysWhyWhereItDoesNotApply) {
  const auto why = [](const VectorXd& x) {
    return TestSerially({x}).lag1.why_not;
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(why(VectorXd()), "needs at least 4 values, found 0");
  EXPECT_EQ(why(VectorXd{{1, 2, 3}}), "needs at least 4 values, found 3");
  EXPECT_EQ(why(VectorXd::Constant(9, 1.0)), "the values do not vary");
  EXPECT_EQ(why(VectorXd{{1, 2, 3, kInfinity}}), "values that are not finite");
  // Groups of one and two: nothing to correlate, and no NaN.
  const VectorXd x{{1, 2, 3, 4, 5}};
  const SerialTests lonely = TestSerially(SegmentsByGroup(x, {0, 1, 2, 3, 4}));
  EXPECT_FALSE(lonely.lag1.ok());
  EXPECT_FALSE(lonely.durbin_watson.ok());
  EXPECT_FALSE(lonely.ljung_box.ok());
  EXPECT_FALSE(lonely.runs.ok());
  EXPECT_THAT(
      [&] {
        SegmentsByGroup(x, {0, 1});
      },
      ThrowsMessage<std::invalid_argument>(
          HasSubstr("2 group codes for 5 values")));
}

// Twenty values with an order that is one in a million, and one like any.
TEST(ShuffleSerially, FindsThePOfTheOrder) {
  constexpr Index kDraws = 2000;
  const VectorXd rising = VectorXd::LinSpaced(20, 0.0, 1.0);
  const SerialShuffles found = ShuffleSerially({rising}, kDraws, 1);
  EXPECT_EQ(found.draws, kDraws);
  EXPECT_LT(found.runs, 0.003);
  EXPECT_LT(found.lag1, 0.003);
  EXPECT_LT(found.durbin_watson, 0.003);
  EXPECT_LT(found.ljung_box, 0.003);
  Random random(2);
  const VectorXd x = NormalSample(40, &random);
  const SerialTests tests = TestSerially({x});
  const SerialShuffles shuffled = ShuffleSerially({x}, kDraws, 1);
  constexpr double kThreeSigmaAndApproximation = 0.05;
  EXPECT_NEAR(shuffled.lag1, tests.lag1.p, kThreeSigmaAndApproximation);
  EXPECT_NEAR(shuffled.durbin_watson,
              tests.durbin_watson.p,
              kThreeSigmaAndApproximation);
  EXPECT_EQ(shuffled.lag1, ShuffleSerially({x}, kDraws, 1).lag1);
  EXPECT_TRUE(
      std::isnan(ShuffleSerially({VectorXd::Constant(9, 1.0)}, 10, 1).lag1));
}

TEST(CompareHalves, ReproducesROnEverySample) {
  constexpr double kStatistic = 1e-12;
  constexpr double kP = 1e-9;
  for (const std::string& name : OrderedSampleNames()) {
    const auto& r = SerialReference(name);
    const TestResult found = CompareHalves(GoldenSample(name));
    EXPECT_NEAR(found.statistic, r.at("halves_d"), kStatistic) << name;
    if (r.contains("halves_p")) {
      EXPECT_NEAR(found.p, r.at("halves_p"), kP) << name;
    }
  }
  EXPECT_FALSE(CompareHalves(VectorXd{{1, 2, 3}}).ok());
}

TEST(ComputeBias, ReproducesRsAnalysisOfVariance) {
  constexpr double kRelative = 1e-9;
  const VectorXd residuals = AppendixB("residual_mm");
  const auto& r = SerialReference("appendix_b_residual");
  for (const std::string by : {"cycle", "position_mm"}) {
    std::vector<double> levels;
    const BiasByLevel bias =
        ComputeBias(residuals, CodesOfValues(AppendixB(by), &levels));
    EXPECT_EQ(levels.size(), bias.levels.size());
    const double f = r.at("anova_f_" + by);
    const double p = r.at("anova_p_" + by);
    EXPECT_NEAR(bias.anova.statistic, f, kRelative * f) << by;
    EXPECT_NEAR(bias.anova.p, p, 1e-7 * p) << by;
    if (by == "cycle") {
      EXPECT_NEAR(bias.levels[6].mean, r.at("cycle7_mean"), 1e-15);
      EXPECT_NEAR(bias.levels[6].standard_error, r.at("cycle7_se"), 1e-15);
    }
  }
}

TEST(ComputeBias, SaysWhyWhereItDoesNotApply) {
  const VectorXd x{{1, 2, 3, 4}};
  EXPECT_EQ(ComputeBias(x, {0, 0, 0, 0}).anova.why_not,
            "needs at least 2 levels, found 1");
  EXPECT_EQ(ComputeBias(x, {0, 1, 2, 3}).anova.why_not,
            "no level has 2 values");
  EXPECT_EQ(ComputeBias(VectorXd::Ones(4), {0, 0, 1, 1}).anova.why_not,
            "the values do not vary");
  EXPECT_EQ(ComputeBias(VectorXd{{1, 1, 2, 2}}, {0, 0, 1, 1}).anova.why_not,
            "the values do not vary within any level");
  const BiasByLevel gap = ComputeBias(x, {0, 0, 2, 2});
  EXPECT_TRUE(gap.anova.ok());
  EXPECT_EQ(gap.levels[1].n, 0);
  EXPECT_THAT(
      [&] {
        ComputeBias(x, {0, 1});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("2 codes for 4 values")));
  EXPECT_THAT(
      [&] {
        ComputeBias(x, {0, 0, -1, 0});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("negative")));
}

TEST(BreuschPagan, ReproducesR) {
  constexpr double kStatistic = 1e-9;
  const auto& r = SerialReference("appendix_b_residual");
  const TestResult found =
      BreuschPagan(AppendixB("residual_mm"), AppendixB("predicted_mm"));
  EXPECT_NEAR(
      found.statistic, r.at("breusch_pagan_given_residuals"), kStatistic);
  EXPECT_NEAR(found.p, r.at("breusch_pagan_given_residuals_p"), kStatistic);
}

TEST(BreuschPagan, SaysWhyWhereItDoesNotApply) {
  const VectorXd x{{1, 2, 3, 5}};
  EXPECT_EQ(BreuschPagan(x, VectorXd::Ones(4)).why_not,
            "the fitted values do not vary");
  EXPECT_EQ(BreuschPagan(VectorXd::Zero(4), x).why_not, "all residuals are 0");
  EXPECT_EQ(BreuschPagan(VectorXd{{1, -1, 1, -1}}, x).why_not,
            "the squared residuals do not vary");
  EXPECT_EQ(BreuschPagan(VectorXd{{1, 2}}, VectorXd{{1, 2}}).why_not,
            "needs at least 4 values, found 2");
  EXPECT_THROW(BreuschPagan(x, VectorXd{{1, 2}}), std::invalid_argument);
}

}  // namespace
}  // namespace errmap::stats
