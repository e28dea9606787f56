#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "stats/normality/normality.h"
#include "stats/normality/ordered_sample.h"
#include "stats/random.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// A normal sample as an instrument of this step gives it, in its own unit.
VectorXd Rounded(Index n, double step, Random* random) {
  const VectorXd sample = NormalSample(n, random);
  const double origin = random->Uniform();
  return 5.0 + 1e-3 * step * ((sample.array() + origin) / step).round();
}

Normality AssessRounded(const VectorXd& sample) {
  return AssessNormality(OrderedSample(sample));
}

TEST(FindStep, FindsTheStepOfRoundedValues) {
  Random random(1);
  for (const double step : {0.02, 0.1, 0.5, 1.0}) {
    const Normality found = AssessRounded(Rounded(400, step, &random));
    EXPECT_NEAR(found.step, 1e-3 * step, 1e-9 * step);
  }
}

// 0, 4, 10 and 14 stand in steps of 2, which no two of them differ by.
TEST(FindStep, IsTheCommonDivisorOfAllDifferences) {
  EXPECT_NEAR(
      FindStep(VectorXd{{0.0, 4.0, 10.0, 14.0}}).value_or(0.0), 2.0, 1e-9);
}

TEST(FindStep, FindsNoneAmongValuesWithoutSteps) {
  Random random(2);
  for (const Index n : {4, 20, 400, 5000}) {
    EXPECT_EQ(AssessRounded(NormalSample(n, &random)).step, 0.0);
  }
}

// Rounded to a thousandth of the scatter, 100 values are as good as not.
TEST(FindStep, PassesOverStepsThatDoNotMatter) {
  Random random(3);
  EXPECT_EQ(AssessRounded(Rounded(100, 0.001, &random)).step, 0.0);
}

// However coarse the steps, each test rejects as it says, and none takes ties
// for modes. In full, 3000 samples of 20 to 400 values in steps of sd/100 to
// sd: more than half of the tests reject at 1 % in 0.6 % of the samples, the
// dip in 0.9 %; each at 5 % in 3.4 to 5.8 %.
TEST(RoundedNormals, AreNotCalledOtherThanNormal) {
  constexpr std::array kSteps = {0.01, 0.033, 0.1, 0.3, 1.0};
  constexpr int kSamples = 500;
  constexpr Index kValues = 50;
  Random random(63);
  int not_normal = 0;
  int modes = 0;
  std::array<int, 5> rejections = {};
  for (int i = 0; i < kSamples; ++i) {
    const Normality found = AssessRounded(
        Rounded(kValues, kSteps[static_cast<std::size_t>(i) % 5], &random));
    const TestResult* tests[] = {&found.lilliefors,
                                 &found.shapiro_wilk,
                                 &found.anderson_darling,
                                 &found.jarque_bera,
                                 &found.normal_ppcc};
    int at_evidence = 0;
    for (std::size_t test = 0; test < 5; ++test) {
      ASSERT_TRUE(tests[test]->ok());
      if (tests[test]->p <= 0.01) ++at_evidence;
      if (tests[test]->p <= 0.05) ++rejections[test];
    }
    if (at_evidence > 2) ++not_normal;
    if (found.dip.p <= 0.01) ++modes;
  }
  std::printf("not normal %d, more than one mode %d of %d\n",
              not_normal,
              modes,
              kSamples);
  EXPECT_LE(not_normal, 0.06 * kSamples);
  EXPECT_LE(modes, 0.06 * kSamples);
  for (const int count : rejections) EXPECT_NEAR(count, 25, 15);
}

// Two groups of readings do have two modes, rounded or not.
TEST(RoundedNormals, DoNotHideASecondMode) {
  Random random(4);
  VectorXd sample(200);
  sample << Rounded(100, 0.2, &random),
      Rounded(100, 0.2, &random).array() + 6e-3;
  const Normality found = AssessRounded(sample);
  EXPECT_GT(found.step, 0.0);
  EXPECT_LE(found.dip.p, 0.01);
  EXPECT_LE(found.shapiro_wilk.p, 0.01);
}

TEST(RoundedNormals, LeaveOutWhatIsForValuesWithoutSteps) {
  Random random(5);
  const Normality found = AssessRounded(Rounded(100, 0.5, &random));
  EXPECT_EQ(found.ks.why_not, "for values without steps");
  EXPECT_TRUE(std::isfinite(found.ks.statistic));
  EXPECT_TRUE(std::isnan(found.ks.p));
  const Normality coarse =
      AssessRounded(VectorXd{{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}});
  EXPECT_EQ(coarse.dip.why_not, "steps as wide as the scatter");
}

TEST(RoundedNormals, AreSimulatedOnTheSameStepsOnRequest) {
  Random random(6);
  const OrderedSample sample(Rounded(100, 0.5, &random));
  const NormalityTests tests(100);
  const Normality found = tests(sample);
  const MonteCarloP drawn = tests.Simulate(sample, found, 2000, 9);
  EXPECT_NEAR(drawn.lilliefors, found.lilliefors.p, 0.06);
  EXPECT_NEAR(drawn.anderson_darling, found.anderson_darling.p, 0.06);
}

TEST(RoundedNormals, GiveTheSameEachTime) {
  Random random(7);
  const VectorXd sample = Rounded(60, 0.2, &random);
  EXPECT_EQ(AssessRounded(sample).dip.p, AssessRounded(sample).dip.p);
}

}  // namespace
}  // namespace errmap::stats
