#include "models/study/shuffled_target_fit.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/interruption.h"
#include "models/recipe_catalog.h"
#include "tests/models/model_test_data.h"
#include "tests/numbers.h"
#include "tests/random_matrix.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using errmap::testing::ChoicesAsOptions;
using errmap::testing::QuadraticData;
using errmap::testing::RandomMatrix;
using errmap::testing::ShippedMeasurements;
using ::testing::HasSubstr;

ShuffledTargetFit Assess(const std::string& spec,
                         const data::Dataset& training,
                         const FitContext& context = {}) {
  const auto recipe = MakeRecipe(spec);
  return FitShuffledTargets(
      *recipe, training, recipe->Fit(training, context), context);
}

TEST(ShuffleTargets, KeepsAllButTheOrderOfTheTargets) {
  const data::Dataset all = ShippedMeasurements();
  const data::Dataset shuffled = ShuffleTargets(all, 4);
  EXPECT_EQ(shuffled.input_values(), all.input_values());
  EXPECT_EQ(shuffled.groups().codes, all.groups().codes);
  EXPECT_EQ(shuffled.rows(), all.rows());
  EXPECT_NE(shuffled.target_values(), all.target_values());
  Eigen::VectorXd a = all.target_values();
  Eigen::VectorXd b = shuffled.target_values();
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  EXPECT_EQ(a, b);
  EXPECT_EQ(ShuffleTargets(all, 4).target_values(), shuffled.target_values());
  EXPECT_NE(ShuffleTargets(all, 5).target_values(), shuffled.target_values());
}

TEST(ShuffledTargetFit, IsThatOfItsCoefficientsForALinearFit) {
  // 20 coefficients (degree 3 in 3 inputs) on 200 rows follow 0.1 of noise,
  // give or take sqrt(2 * 20) / 200 = 0.03 in one order.
  data::Dataset::Parts parts;
  parts.source = "random";
  parts.inputs = {{"a", {}}, {"b", {}}, {"c", {}}};
  parts.input_values = RandomMatrix(200, 3, 1);
  parts.target = {"error_mm", {}};
  parts.target_values = parts.input_values.col(0) + parts.input_values.col(1);
  const data::Dataset dataset(std::move(parts));
  const ShuffledTargetFit found = Assess("poly:full:degree=3", dataset);
  EXPECT_NEAR(found.shuffled_r2, 19.0 / 199.0, 0.09);
  EXPECT_NEAR(found.train_r2, 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(found.weights_per_row, 0.1);
  EXPECT_TRUE(std::isnan(found.effective_parameters));
  EXPECT_EQ(found.learning(), NoiseLearning::kLittle);
  EXPECT_EQ(found.why_not, "");
}

TEST(ShuffledTargetFit, TellsANetThatLearnsNoiseFromOneThatCannot) {
  data::Dataset::Parts parts;
  parts.source = "random";
  parts.inputs = {{"a", {}}, {"b", {}}, {"c", {}}};
  parts.input_values = RandomMatrix(40, 3, 8);
  parts.target = {"error_mm", {}};
  parts.target_values = parts.input_values.col(0);
  const data::Dataset few(std::move(parts));
  const ShuffledTargetFit free = Assess("net:scg:hidden=20:wfactor=1e-8", few);
  EXPECT_GT(free.shuffled_r2, 0.8);
  EXPECT_DOUBLE_EQ(free.weights_per_row, 101.0 / 40.0);
  EXPECT_GT(free.effective_per_row, kMuchNoise);
  EXPECT_DOUBLE_EQ(free.effective_per_row, free.effective_parameters / 40.0);
  EXPECT_EQ(free.learning(), NoiseLearning::kMuch);

  const ShuffledTargetFit bound = Assess("net:scg:hidden=20:wfactor=10", few);
  EXPECT_LT(bound.shuffled_r2, 0.1);
  EXPECT_LT(bound.effective_per_row, 0.1);
  EXPECT_EQ(bound.learning(), NoiseLearning::kLittle);
  EXPECT_EQ(bound.why_not, "");
}

TEST(ShuffledTargetFit, CountsTheRowsThatWereLearntFrom) {
  const ShuffledTargetFit found =
      Assess("net:scg:rows=100:iterations=5:hidden=2", ShippedMeasurements());
  // 2 inputs: 2 * 3 + 3 weights.
  EXPECT_DOUBLE_EQ(found.weights_per_row, 9.0 / 100.0);
}

TEST(ShuffledTargetFit, ClassifiesByTheLargerShare) {
  struct Case {
    double shuffled_r2;
    double effective_per_row;
    NoiseLearning expected;
  };
  for (const Case& c : {Case{kNaN, kNaN, NoiseLearning::kUnknown},
                        Case{-0.1, kNaN, NoiseLearning::kLittle},
                        Case{0.199, 0.1, NoiseLearning::kLittle},
                        Case{0.2, 0.1, NoiseLearning::kSome},
                        Case{0.1, 0.3, NoiseLearning::kSome},
                        Case{kNaN, 0.49, NoiseLearning::kSome},
                        Case{0.5, 0.1, NoiseLearning::kMuch},
                        Case{0.0, 0.9, NoiseLearning::kMuch}}) {
    ShuffledTargetFit memorisation;
    memorisation.shuffled_r2 = c.shuffled_r2;
    memorisation.effective_per_row = c.effective_per_row;
    EXPECT_EQ(memorisation.learning(), c.expected)
        << c.shuffled_r2 << " " << c.effective_per_row;
  }
  EXPECT_EQ(ToString(NoiseLearning::kUnknown), "unknown");
  EXPECT_EQ(ToString(NoiseLearning::kLittle), "little");
  EXPECT_EQ(ToString(NoiseLearning::kSome), "some");
  EXPECT_EQ(ToString(NoiseLearning::kMuch), "much");
}

// Tuned again on shuffled targets, hidden nodes and wfactor would be others,
// and the net judged not the one at hand.
TEST(ShuffledTargetFit, FixesWhatTheFitHasTuned) {
  const data::Dataset dataset = QuadraticData(60);
  const auto tuned =
      MakeRecipe("net:scg:hidden=cv:wfactor=cv:starts=3:iterations=40");
  const FittedModel fitted =
      tuned->Fit(dataset, {.seed = 3, .inner_holdout = InnerHoldout::kRows});
  const ShuffledTargetFit found =
      FitShuffledTargets(*tuned, dataset, fitted, {.seed = 3});
  const auto fixed = MakeRecipe("net:scg" + ChoicesAsOptions(fitted));
  std::uint64_t seed = 0;
  for (const StartResult& start : fitted.starts) {
    if (start.chosen) seed = start.seed;
  }
  const FittedModel same = fixed->Fit(dataset, {.seed = seed});
  ASSERT_EQ(same.Predict(dataset), fitted.Predict(dataset));
  // The order of the targets is the seed's, whichever start was chosen.
  FittedModel with_start = same;
  with_start.starts = fitted.starts;
  const ShuffledTargetFit expected =
      FitShuffledTargets(*fixed, dataset, with_start, {.seed = 3});
  EXPECT_EQ(found.shuffled_r2, expected.shuffled_r2);
  EXPECT_EQ(found.effective_parameters, expected.effective_parameters);
  EXPECT_TRUE(std::isfinite(found.shuffled_r2));
  EXPECT_TRUE(std::isfinite(found.effective_parameters));
}

TEST(ShuffledTargetFit, IsTheSameForEverySlopeAndPrecisionAsForTheWeights) {
  // The form of a net has the slope in its weights; it must come out again.
  const data::Dataset dataset = QuadraticData(60);
  for (const std::string options :
       {":slope=2", ":slope=0.5:output=linear", ":precision=single"}) {
    const ShuffledTargetFit found =
        Assess("net:scg:hidden=4:iterations=100:wfactor=0" + options, dataset);
    // All weights count where nothing holds them, but for rounding.
    EXPECT_GT(found.effective_parameters, 12.0) << options;
    EXPECT_LE(found.effective_parameters, 21.0) << options;
    EXPECT_GT(found.train_r2, 0.9) << options;
  }
}

TEST(ShuffledTargetFit, LeavesFiguresOutWhereTheFitIsInterrupted) {
  const data::Dataset dataset = QuadraticData(60);
  const auto recipe = MakeRecipe("net:scg:hidden=4:iterations=20");
  const FittedModel fitted = recipe->Fit(dataset, {});
  const std::atomic<bool> stop = true;
  const fitting::InterruptionScope interrupted(&stop);
  const ShuffledTargetFit found =
      FitShuffledTargets(*recipe, dataset, fitted, {});
  EXPECT_TRUE(std::isnan(found.shuffled_r2));
  EXPECT_TRUE(std::isnan(found.effective_parameters));
  EXPECT_EQ(found.why_not, "interrupted");
  EXPECT_EQ(found.learning(), NoiseLearning::kUnknown);
  EXPECT_TRUE(std::isfinite(found.train_r2));
}

TEST(ShuffledTargetFit, GivesAReasonWhereTheRefitFails) {
  // Fitted elsewhere, to rows of other inputs.
  const auto recipe = MakeRecipe("poly:position");
  const FittedModel fitted = recipe->Fit(QuadraticData(60), {});
  data::Dataset::Parts parts;
  parts.source = "elsewhere";
  parts.inputs = {{"a", {}}};
  parts.input_values = RandomMatrix(20, 1, 1);
  parts.target = {"error_mm", {}};
  parts.target_values = parts.input_values.col(0);
  const ShuffledTargetFit found =
      FitShuffledTargets(*recipe, data::Dataset(std::move(parts)), fitted, {});
  EXPECT_THAT(found.why_not, HasSubstr("position_mm"));
  EXPECT_TRUE(std::isnan(found.shuffled_r2));
}

}  // namespace
}  // namespace errmap::models
