#include "cli/study_setup/plan/study_forecast.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/study_setup/study_config.h"
#include "tests/places.h"

namespace errmap::study_setup {
namespace {

constexpr std::size_t kFirst = 0;

// Four fits of each of two polynomials: to all rows, and of three folds.
StudyPlan PlanOf(const std::vector<std::string>& models,
                 const std::string& data = "nistir5367_xdisp_down.csv") {
  StudyConfig config;
  config.holdouts = {"groups:3"};
  config.models = models;
  ComponentConfig component;
  component.data = errmap::tests::SourceDir() + "/data/sets/" + data;
  config.components = {component};
  return PlanStudy(config);
}

models::FitProgress Fit(std::size_t model,
                        std::ptrdiff_t holdout,
                        std::size_t fold,
                        double seconds) {
  models::FitProgress fit;
  fit.task = {model, holdout, fold};
  fit.seconds = seconds;
  return fit;
}

TEST(StudyForecast, LearnsFromTheFitsOfEachModel) {
  const StudyPlan plan = PlanOf({"poly:eq8", "net:scg:iterations=100"});
  StudyForecast forecast(plan, 1);
  const double before = forecast.SecondsLeft();
  EXPECT_GT(before, 0.0);
  // The folds of a model take as long as its fit to all rows, by their rows.
  forecast.Note(kFirst, Fit(1, -1, 0, 30.0));
  const double left = forecast.SecondsLeft();
  EXPECT_GT(left, 3 * 0.5 * 30.0);
  EXPECT_LT(left, 3 * 30.0 + 1.0);
  forecast.Note(kFirst, Fit(1, 0, 0, 20.0));
  forecast.Note(kFirst, Fit(1, 0, 1, 20.0));
  const double last = forecast.SecondsLeft();
  EXPECT_NEAR(last, 20.0, 3.0);
  forecast.Note(kFirst, Fit(1, 0, 2, 20.0));
  EXPECT_LT(forecast.SecondsLeft(), 1.0);
  // Two at a time take half as long.
  StudyForecast together(plan, 2);
  EXPECT_NEAR(together.SecondsLeft(), 0.5 * before, 1e-9 * before);
}

TEST(StudyForecast, LearnsOfAModelFromOthersOfItsKind) {
  const StudyPlan plan =
      PlanOf({"net:scg:iterations=100", "net:scg:iterations=200"});
  StudyForecast forecast(plan, 1);
  const double before = forecast.SecondsLeft();
  // A machine a thousand times slower than was thought.
  StudyForecast alone(PlanOf({"net:scg:iterations=100"}), 1);
  const double rough = alone.SecondsLeft();
  forecast.Note(kFirst, Fit(0, -1, 0, 1000.0 * rough / 3.1));
  EXPECT_GT(forecast.SecondsLeft(), 300.0 * before);
}

TEST(StudyForecast, LearnsLittleOfAMuchLargerModel) {
  const std::string kManyInputs = "turning_centre/x_displacement_down.csv";
  const StudyPlan plan =
      PlanOf({"poly:position", "poly:full:degree=2"}, kManyInputs);
  StudyForecast forecast(plan, 1);
  const double before = forecast.SecondsLeft();
  StudyForecast alone(PlanOf({"poly:position"}, kManyInputs), 1);
  forecast.Note(kFirst, Fit(0, -1, 0, 20.0 * alone.SecondsLeft() / 3.1));
  EXPECT_LT(forecast.SecondsLeft(), 20.0 * before);
}

TEST(StudyForecast, KnowsThatNetsTrainOnABoundedNumberOfRows) {
  const StudyForecast all(PlanOf({"net:scg:rows=all"}), 1);
  const StudyForecast few(PlanOf({"net:scg:rows=100"}), 1);
  // 264 rows and more of 397 in each fold.
  EXPECT_LT(few.SecondsLeft(), 0.5 * all.SecondsLeft());
}

TEST(StudyForecast, TellsTheBestOnWhatIsUnseen) {
  StudyForecast forecast(PlanOf({"mean", "poly:eq8"}), 1);
  EXPECT_EQ(forecast.BestSoFar().map, "");
  models::FitProgress fit = Fit(1, 0, 2, 0.1);
  fit.holdout_rmse = 0.002661;
  forecast.Note(kFirst, fit);
  EXPECT_EQ(forecast.BestSoFar().map, "poly:eq8 2.66 um");
  EXPECT_EQ(forecast.BestSoFar().holdout, "groups:3");
  fit = Fit(0, 0, 2, 0.1);
  fit.holdout_rmse = 0.006;
  forecast.Note(kFirst, fit);
  EXPECT_THAT(forecast.BestSoFar().map, ::testing::StartsWith("poly:eq8"));
}

}  // namespace
}  // namespace errmap::study_setup
