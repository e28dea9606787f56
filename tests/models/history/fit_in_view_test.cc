#include "models/history/fit_in_view.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/recipe_catalog.h"
#include "tests/models/history/history_data.h"

namespace errmap::models {
namespace {

using ::testing::HasSubstr;

// Five runs whose error is a line in one temperature as it was some time ago:
// 600 s through a filter.
data::Dataset LaggingDaysInFitInView() {
  const data::Dataset wandering = errmap::testing::WanderingDays();
  History history;
  history.time_unit = "s";
  history.session = "day";
  const DerivedInput lag = Ema(wandering.inputs()[0], 600.0, "s");
  history.derived.push_back(lag);
  history.form_inputs.push_back(lag.column.name);
  const Eigen::VectorXd slow = DeriveInputs(wandering, history).col(0);
  return testing::WithTargets(wandering, 3.0 * slow.array() - 50.0);
}

FittedModel FitSpec(const std::string& spec, const data::Dataset& dataset) {
  return MakeRecipe(spec)->Fit(dataset, {});
}

double RmseOf(const FittedModel& fitted, const data::Dataset& dataset) {
  return std::sqrt(
      (dataset.target_values() - fitted.Predict(dataset)).squaredNorm() /
      static_cast<double>(dataset.num_rows()));
}

TEST(FitInView, StepwiseFindsTheFilterThatTheErrorFollows) {
  const data::Dataset dataset = LaggingDaysInFitInView();
  const FittedModel raw = FitSpec("poly:stepwise:terms=linear", dataset);
  const FittedModel chosen =
      FitSpec("poly:stepwise:terms=linear:view=auto:history=600", dataset);
  EXPECT_GT(RmseOf(raw, dataset), 0.1);
  EXPECT_LT(RmseOf(chosen, dataset), 1e-9);
  ASSERT_NE(chosen.history, nullptr);
  EXPECT_THAT(chosen.remarks.back(), HasSubstr("view history by inner"));
  ASSERT_TRUE(chosen.guards.has_value());
  EXPECT_FALSE(
      FitSpec("poly:stepwise:terms=linear:view=history:history=600:clip=none",
              dataset)
          .guards.has_value());
}

TEST(FitInView, AFormulaNamesDerivedInputs) {
  const data::Dataset dataset = LaggingDaysInFitInView();
  const FittedModel fitted = FitSpec(
      "poly:formula=\"ema(t1_degC,600s)\":view=history:history=600", dataset);
  EXPECT_LT(RmseOf(fitted, dataset), 1e-9);
  EXPECT_EQ(fitted.model->num_parameters(), 2);
  EXPECT_TRUE(fitted.guards.has_value());
  EXPECT_THROW(MakeRecipe("poly:formula=t1_degC:view=auto"),
               std::invalid_argument);
  EXPECT_THROW(
      FitSpec("poly:formula=\"ema(t1_degC,60s)\":view=history:history=600",
              dataset),
      std::invalid_argument);
}

TEST(FitInView, AMapOfNoTermsNeedsNoHistory) {
  data::Dataset dataset = errmap::testing::WanderingDays();
  const FittedModel fitted =
      FitSpec("poly:stepwise:max_terms=0:view=history:history=600", dataset);
  EXPECT_EQ(fitted.history, nullptr);
  EXPECT_EQ(fitted.model->num_parameters(), 1);
}

TEST(FitInView, TermSetsBoundWhatStepwiseMayChoose) {
  const data::Dataset dataset = errmap::testing::WanderingDays();
  const auto message = [&](const std::string& options) {
    return FitSpec("poly:stepwise:" + options, dataset).summary.message;
  };
  EXPECT_THAT(message("terms=linear"), HasSubstr("of 2 candidate terms"));
  EXPECT_THAT(message("terms=squares"), HasSubstr("of 4 candidate terms"));
  EXPECT_THAT(message("degree=2"), HasSubstr("of 5 candidate terms"));
  EXPECT_THROW(MakeRecipe("poly:stepwise:terms=cubes"), std::invalid_argument);
  EXPECT_THROW(MakeRecipe("poly:stepwise:view=auto:intercept=no"),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::models
