#include "models/study/study.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/recipe_catalog.h"
#include "tests/models/model_test_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using errmap::testing::ShippedMeasurements;
using ::testing::HasSubstr;

using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;
using errmap::testing::Recipes;

// Micrometres as printed: half a unit of the fourth decimal.
constexpr double kPrinted = 5e-5;

// Computed independently on the shipped measurements.
TEST(Study, ReproducesTheReferenceFiguresOfTheShippedMeasurements) {
  const data::Dataset dataset = ShippedMeasurements();
  const StudyResult study = RunStudy(
      dataset,
      MakeHoldouts(dataset, {"every:3", "groups:5"}),
      MakeRecipes({"mean", "poly:eq8", "poly:eq9", "poly:full:degree=3"}),
      {});
  const auto um = [&](std::size_t model, std::size_t holdout) {
    return 1e3 * study.models[model].holdouts[holdout].test.rmse;
  };
  EXPECT_NEAR(um(0, 0), 5.8805, kPrinted);
  EXPECT_NEAR(um(0, 1), 5.9359, kPrinted);
  EXPECT_NEAR(um(1, 0), 1.5022, kPrinted);
  EXPECT_NEAR(um(1, 1), 2.6608, kPrinted);
  EXPECT_NEAR(um(2, 0), 1.6516, kPrinted);
  EXPECT_NEAR(um(2, 1), 2.7504, kPrinted);
  EXPECT_NEAR(um(3, 0), 0.5460, kPrinted);
  EXPECT_NEAR(um(3, 1), 0.9378, kPrinted);
  const HoldoutResult& eq8 = study.models[1].holdouts[0];
  EXPECT_NEAR(1e3 * eq8.train.rmse, 1.5277, kPrinted);
  EXPECT_EQ(eq8.test.n, 132);
  EXPECT_NEAR(1e3 * eq8.test.mean, -0.0042, kPrinted);
  EXPECT_NEAR(1e3 * eq8.test.sd, 1.5079, kPrinted);
}

TEST(Study, GivesTheSameBitsForAnyNumberOfJobs) {
  const data::Dataset dataset = ShippedMeasurements();
  const auto holdouts = MakeHoldouts(dataset, {"every:3", "groups:5"});
  const auto recipes = MakeRecipes(
      {"poly:stepwise", "net:scg:iterations=40", "poly:full:degree=4"});
  const StudyResult one = RunStudy(dataset, holdouts, recipes, {.jobs = 1});
  const StudyResult five = RunStudy(dataset, holdouts, recipes, {.jobs = 5});
  for (std::size_t m = 0; m < recipes.size(); ++m) {
    for (std::size_t h = 0; h < holdouts.size(); ++h) {
      const auto& a = one.models[m].holdouts[h];
      const auto& b = five.models[m].holdouts[h];
      EXPECT_EQ(a.test.rmse, b.test.rmse);
      for (std::size_t f = 0; f < a.folds.size(); ++f) {
        EXPECT_EQ(a.folds[f].test_predictions, b.folds[f].test_predictions);
      }
    }
  }
}

TEST(Study, NeverLetsTestRowsTouchAFit) {
  // Targets of the test rows are ruined: no prediction may change.
  const data::Dataset dataset = ShippedMeasurements();
  data::Dataset::Parts parts;
  parts.source = "ruined";
  parts.inputs = dataset.inputs();
  parts.input_values = dataset.input_values();
  parts.target = dataset.target();
  parts.target_values = dataset.target_values();
  parts.groups = dataset.groups();
  for (Eigen::Index row = 2; row < dataset.num_rows(); row += 3) {
    parts.target_values[row] = 1e3;
  }
  const data::Dataset ruined(std::move(parts));
  const std::vector<std::string> specs = {
      "mean", "poly:eq7", "poly:stepwise", "net:scg:iterations=40"};
  const auto run = [&](const data::Dataset& rows) {
    return RunStudy(
        rows, MakeHoldouts(rows, {"every:3"}), MakeRecipes(specs), {});
  };
  const StudyResult clean = run(dataset);
  const StudyResult spoilt = run(ruined);
  for (std::size_t m = 0; m < specs.size(); ++m) {
    EXPECT_EQ(clean.models[m].holdouts[0].folds[0].test_predictions,
              spoilt.models[m].holdouts[0].folds[0].test_predictions)
        << specs[m];
  }
}

TEST(Study, TellsR2AboutTheTrainingMeanAndAveragesAllFolds) {
  const data::Dataset dataset = ShippedMeasurements();
  const std::vector<Holdout> holdouts = MakeHoldouts(dataset, {"groups:5"});
  const StudyResult study =
      RunStudy(dataset, holdouts, MakeRecipes({"mean", "zero"}), {});
  constexpr double kRounding = 1e-12;
  // The mean of the training rows is what R2 on held-out rows begins with.
  EXPECT_NEAR(study.models[0].holdouts[0].test.r2, 0.0, kRounding);
  const Eigen::VectorXd& targets = dataset.target_values();
  double mean = 0.0;
  double mae = 0.0;
  double rmse = 0.0;
  for (const stats::Fold& fold : holdouts[0].folds) {
    const Eigen::VectorXd training = targets(fold.train);
    mean += training.mean() / 5.0;
    mae += training.cwiseAbs().mean() / 5.0;
    rmse += std::sqrt(training.squaredNorm() /
                      static_cast<double>(training.size())) /
            5.0;
  }
  const stats::ErrorMetrics& train = study.models[1].holdouts[0].train;
  EXPECT_NEAR(train.mean, mean, kRounding);
  EXPECT_NEAR(train.mae, mae, kRounding);
  EXPECT_NEAR(train.rmse, rmse, kRounding);
}

TEST(Study, KeepsGoingWhereAFitFailsAndSaysWhy) {
  const data::Dataset dataset = errmap::testing::QuadraticData(12);
  const StudyResult study =
      RunStudy(dataset,
               MakeHoldouts(dataset, {"every:3"}),
               MakeRecipes({"poly:full:degree=3", "poly:position"}),
               {});
  EXPECT_FALSE(study.models[0].ok());
  EXPECT_THAT(study.models[0].why(), HasSubstr("20 coefficients"));
  EXPECT_TRUE(study.models[1].ok());
}

TEST(Study, StopsBetweenFitsWhenAsked) {
  const data::Dataset dataset = ShippedMeasurements();
  const std::atomic<bool> stop{true};
  const StudyResult study = RunStudy(dataset,
                                     MakeHoldouts(dataset, {"every:3"}),
                                     MakeRecipes({"mean"}),
                                     {.stop = &stop});
  EXPECT_TRUE(study.interrupted);
  EXPECT_THAT(study.models[0].why(), HasSubstr("interrupted"));
}

TEST(Study, JudgesTheRowsOfAnotherFile) {
  const data::Dataset dataset = ShippedMeasurements();
  std::vector<Eigen::Index> rows = {5, 9, 11};
  auto test = std::make_shared<const data::Dataset>(dataset.SelectRows(rows));
  std::vector<Holdout> holdouts;
  holdouts.push_back(
      MakeHoldout(stats::ParseHoldout("file:other.csv"), dataset, 1, test));
  const StudyResult study =
      RunStudy(dataset, holdouts, MakeRecipes({"poly:eq8"}), {});
  const FoldResult& fold = study.models[0].holdouts[0].folds[0];
  EXPECT_EQ(fold.test_predictions, study.models[0].final_fit->Predict(*test));
}

TEST(Study, RefusesToRunOnNothing) {
  const data::Dataset dataset = ShippedMeasurements();
  EXPECT_THROW(RunStudy(dataset, {}, MakeRecipes({"mean"}), {}),
               std::invalid_argument);
  EXPECT_THROW(RunStudy(dataset, MakeHoldouts(dataset, {"every:3"}), {}, {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::models
