#include "models/study/given_predictions.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/input_error.h"
#include "tests/models/model_test_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using data::InputError;
using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;
using errmap::testing::MessageOf;
using errmap::testing::QuadraticData;
using errmap::testing::ShippedMeasurements;
using ::testing::AllOf;
using ::testing::HasSubstr;

// What one of our own models predicts, as if another program had made it.
std::string PredictionsByFold(const HoldoutResult& result,
                              const Holdout& holdout,
                              const data::Dataset& dataset) {
  std::string text = "row,holdout,fold,predicted\n";
  for (std::size_t fold = 0; fold < holdout.folds.size(); ++fold) {
    for (std::size_t i = 0; i < holdout.folds[fold].test.size(); ++i) {
      const auto row = static_cast<std::size_t>(holdout.folds[fold].test[i]);
      text += fmt::format(
          "{},{},{},{}\n",
          dataset.rows()[row],
          holdout.name,
          fold,
          data::CsvNumber(result.folds[fold]
                              .test_predictions[static_cast<Eigen::Index>(i)]));
    }
  }
  return text;
}

TEST(GivenPredictions, AreJudgedAsTheModelThatMadeThem) {
  const data::Dataset dataset = ShippedMeasurements();
  const auto holdouts = MakeHoldouts(dataset, {"groups:5"});
  const auto recipes = MakeRecipes({"poly:eq8"});
  const StudyResult study = RunStudy(dataset, holdouts, recipes, {});
  const HoldoutResult& ours = study.models[0].holdouts[0];
  const data::CsvTable file =
      data::ParseCsv(PredictionsByFold(ours, holdouts[0], dataset), "p.csv");
  const ModelResult given = JudgeGivenPredictions(
      ReadGivenPredictions("matlab", file), dataset, holdouts);
  EXPECT_TRUE(given.ok()) << given.why();
  EXPECT_EQ(given.name, "matlab");
  EXPECT_EQ(given.kind, ModelKind::kFile);
  EXPECT_FALSE(given.final_fit);
  EXPECT_EQ(given.holdouts[0].test.rmse, ours.test.rmse);
  EXPECT_EQ(given.holdouts[0].test.r2, ours.test.r2);
  // The training rows of a fold were not predicted.
  EXPECT_TRUE(std::isnan(given.holdouts[0].train.rmse));
}

TEST(GivenPredictions, OfAllRowsServeEveryHoldout) {
  const data::Dataset dataset = QuadraticData(30);
  std::string text = "row,predicted\n";
  for (Eigen::Index i = 0; i < dataset.num_rows(); ++i) {
    text += fmt::format(
        "{},{}\n", i, data::CsvNumber(dataset.target_values()[i] - 0.001));
  }
  const ModelResult given = JudgeGivenPredictions(
      ReadGivenPredictions("off", data::ParseCsv(text, "p.csv")),
      dataset,
      MakeHoldouts(dataset, {"every:3", "kfold:5"}));
  for (const HoldoutResult& result : given.holdouts) {
    EXPECT_NEAR(result.test.rmse, 0.001, 1e-12) << result.holdout;
    EXPECT_NEAR(result.train.mean, 0.001, 1e-12);
  }
}

TEST(GivenPredictions, FailWhereATestRowIsMissing) {
  const data::Dataset dataset = QuadraticData(6);
  const auto holdouts = MakeHoldouts(dataset, {"every:3", "every:2"});
  const auto given = ReadGivenPredictions(
      "few", data::ParseCsv("row,predicted\n2,0\n5,0\n", "p.csv"));
  const ModelResult result = JudgeGivenPredictions(given, dataset, holdouts);
  EXPECT_TRUE(result.holdouts[0].ok());
  EXPECT_THAT(result.holdouts[1].why_failed,
              HasSubstr("no prediction of data row 1"));
}

TEST(GivenPredictions, SayWhatIsWrongWhere) {
  const auto refusal = [](const std::string& text) {
    return MessageOf<InputError>(
        [&] { ReadGivenPredictions("x", data::ParseCsv(text, "p.csv")); });
  };
  EXPECT_THAT(refusal("row,value\n0,1\n"), HasSubstr("no column 'predicted'"));
  EXPECT_THAT(refusal("row,fold,predicted\n0,0,1\n"),
              HasSubstr("no column 'holdout'"));
  EXPECT_THAT(refusal("row,predicted\n0,abc\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("'abc' is not a finite")));
  EXPECT_THAT(refusal("row,predicted\n0,1\n0,1\n"), HasSubstr("stands twice"));
}

}  // namespace
}  // namespace errmap::models
