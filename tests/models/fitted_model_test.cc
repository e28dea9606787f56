#include <cmath>
#include <memory>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/error_model.h"
#include "models/recipe_catalog.h"
#include "tests/models/model_test_data.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using errmap::testing::QuadraticData;

FittedModel Guarded(const data::Dataset& training) {
  FittedModel fitted =
      MakeRecipe("poly:formula=position_mm+t1_degC")->Fit(training, {});
  fitted.guards = MakeGuards(fitted.inputs, training.target_values());
  return fitted;
}

TEST(FittedModel, ClipsNothingWithinTheWidenedRange) {
  const data::Dataset training = QuadraticData(60);
  FittedModel fitted = Guarded(training);
  fitted.guards->error_margin = 1.0;  // the linear map is no good fit
  const Prediction prediction = fitted.PredictForm(fitted.FormInputs(training));
  EXPECT_EQ(prediction.clipped.count(), 0);
  EXPECT_EQ(prediction.errors,
            fitted.model->Predict(fitted.FormInputs(training)));
  EXPECT_EQ(fitted.Predict(training), prediction.errors);
}

TEST(FittedModel, ClipsInputsAtTheTrainedRangeWidenedByTwiceItself) {
  const data::Dataset training = QuadraticData(60);
  FittedModel fitted = Guarded(training);
  fitted.guards->error_margin = 1e3;  // the inputs' guards alone
  const TrainedInput& t1 = fitted.inputs[1];
  const double most = t1.max + 2.0 * (t1.max - t1.min);
  Eigen::MatrixXd rows(3, 2);
  rows << -10.0, most, -10.0, most + 1e-6, -10.0, 1e6;
  const Prediction prediction = fitted.PredictForm(rows);
  EXPECT_EQ(prediction.errors[1], prediction.errors[0]);
  EXPECT_EQ(prediction.errors[2], prediction.errors[0]);
  EXPECT_FALSE(prediction.clipped[0]);
  EXPECT_TRUE(prediction.clipped[1]);
  EXPECT_TRUE(prediction.clipped[2]);
}

TEST(FittedModel, ClipsErrorsAtTheTrainedRangeWidenedByThreeTenths) {
  const data::Dataset training = QuadraticData(60);
  FittedModel fitted = Guarded(training);
  fitted.guards->input_margin = 1e6;
  const Prediction prediction =
      fitted.PredictForm(Eigen::RowVector2d(-10.0, 1e4));
  const double min = training.target_values().minCoeff();
  const double max = training.target_values().maxCoeff();
  EXPECT_TRUE(prediction.clipped[0]);
  EXPECT_DOUBLE_EQ(std::abs(prediction.errors[0] - 0.5 * (min + max)),
                   0.8 * (max - min));
}

TEST(FittedModel, LeavesAMissingInputMissing) {
  const FittedModel fitted = Guarded(QuadraticData(60));
  const Prediction prediction =
      fitted.PredictForm(Eigen::RowVector2d(-10.0, std::nan("")));
  EXPECT_TRUE(std::isnan(prediction.errors[0]));
}

TEST(FittedModel, RefusesGuardsOfAnotherNumberOfInputs) {
  const FittedModel fitted = Guarded(QuadraticData(60));
  EXPECT_THROW(fitted.PredictForm(Eigen::RowVector3d::Zero()),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::models
