#include "models/sensors/sensitivity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "models/history/history.h"
#include "models/history/with_history.h"
#include "models/recipe_catalog.h"
#include "tests/models/history/history_data.h"
#include "tests/models/model_test_data.h"

namespace errmap::models {
namespace {

using Eigen::Index;

// error = 3 t1 - 4 t2 of wandering days, raw.
data::Dataset KnownSlopes() {
  const data::Dataset days = errmap::testing::WanderingDays();
  return errmap::testing::WithTargets(
      days,
      3.0 * days.input_values().col(0) - 4.0 * days.input_values().col(1));
}

TEST(MeasureSensitivity, AddsTheSlopesOfIndependentSensorsInSquares) {
  const data::Dataset days = KnownSlopes();
  const FittedModel map =
      MakeRecipe("poly:full:degree=1:clip=none")->Fit(days, {});
  const Sensitivity found = MeasureSensitivity(map, days);
  EXPECT_NEAR(found.per_noise, 0.1 * 5.0, 1e-6);
  EXPECT_EQ(found.jump_of, "t2_degC");
  EXPECT_NEAR(
      found.largest_jump, 4.0 * days.input_values().col(1).maxCoeff(), 1e-3);
  EXPECT_EQ(found.rezero_jump, 0.0);
}

TEST(MeasureSensitivity, KnowsWhatFiltersAverageAndAZeroHolds) {
  const data::Dataset days = KnownSlopes();
  const History history{
      .time_unit = "s",
      .session = "day",
      .derived = {Ema(days.inputs()[0], 600.0, "s"), Zeroed(days.inputs()[1])},
      .form_inputs = {"ema(t1_degC,600s)", "zeroed(t2_degC)"}};
  const FittedModel map = WithHistory(
      MakeRecipe("poly:full:degree=1")->Fit(DeriveDataset(days, history), {}),
      days,
      history);
  const auto form = std::get<PolynomialForm>(map.model->Describe());
  const Sensitivity found = MeasureSensitivity(map, days);
  // The noise of t1 is averaged away; that of t2 passes with its slope.
  double slope = 0.0;
  for (const PolynomialTerm& term : form.terms) {
    if (term.powers[1] == 1) slope = term.coefficient * form.input_scale[1];
  }
  EXPECT_NEAR(found.per_noise, 0.1 * std::abs(slope), 1e-9);
  const Eigen::MatrixXd derived = map.FormInputs(days);
  EXPECT_NEAR(found.rezero_jump,
              std::abs(slope) * derived.col(1).cwiseAbs().maxCoeff(),
              1e-9);
  EXPECT_GT(found.largest_jump, 0.0);
}

TEST(MeasureSensitivity, HasNothingToTellWithoutThermometers) {
  const data::Dataset dataset = errmap::testing::ShippedMeasurements();
  const FittedModel map = MakeRecipe("poly:eq8")->Fit(dataset, {});
  const Sensitivity found = MeasureSensitivity(map, dataset);
  EXPECT_EQ(found.per_noise, 0.0);
  EXPECT_EQ(found.jump_of, "");
}

}  // namespace
}  // namespace errmap::models
