#include <cmath>
#include <memory>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/error_model.h"
#include "models/export/program/map_program.h"
#include "models/model_file.h"
#include "models/recipe_catalog.h"
#include "models/study/record/make_study_record.h"
#include "tests/models/model_test_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using errmap::testing::QuadraticData;

FittedModel Guarded(const data::Dataset& training) {
  FittedModel fitted =
      MakeRecipe("poly:formula=position_mm+t1_degC")->Fit(training, {});
  fitted.guards = MakeClampLimits(fitted.inputs, training.target_values());
  return fitted;
}

TEST(FittedModel, ClipsNothingWithinTheWidenedRange) {
  const data::Dataset training = QuadraticData(60);
  FittedModel fitted = Guarded(training);
  fitted.guards->error_margin = 1.0;  // the linear map is not a good fit
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

TEST(FittedModel, PredictsARowAsItPredictsAllToTheLastBit) {
  const data::Dataset training = QuadraticData(60);
  for (const char* spec :
       {"poly:full:degree=3",
        "net:scg:hidden=3:iterations=20",
        "blend:view=raw:terms=linear",
        "net:scg:view=raw:wfactor=0.01:hidden=2:iterations=20"}) {
    FittedModel fitted = MakeRecipe(spec)->Fit(training, {});
    for (const bool guarded : {false, true}) {
      if (guarded) {
        fitted.guards =
            MakeClampLimits(fitted.inputs, training.target_values());
        fitted.guards->error_margin = 0.0;
        fitted.guards->input_margin = -0.1;
      } else {
        fitted.guards.reset();
      }
      const Eigen::MatrixXd inputs = fitted.FormInputs(training);
      const Prediction all = fitted.PredictForm(inputs);
      for (Index row = 0; row < inputs.rows(); ++row) {
        const Eigen::VectorXd one = inputs.row(row);
        bool clipped = false;
        EXPECT_EQ(
            fitted.PredictFormRow(
                {one.data(), static_cast<std::size_t>(one.size())}, &clipped),
            all.errors[row])
            << spec << " " << row;
        EXPECT_EQ(clipped, all.clipped[row]) << spec << " " << row;
      }
      EXPECT_EQ(all.clipped.any(), guarded) << spec;
    }
  }
}

// Ten ranges away every form that bends goes astray, and a line may.
TEST(FittedModel, IsGuardedWhateverItsFamilyUnlessAskedNotToBe) {
  const data::Dataset training = QuadraticData(60);
  const double low = training.target_values().minCoeff();
  const double high = training.target_values().maxCoeff();
  for (const std::string spec : {"poly:position",
                                 "poly:temperature",
                                 "poly:eq8",
                                 "poly:full:degree=3",
                                 "poly:stepwise",
                                 "poly:best:terms=squares",
                                 "poly:ridge",
                                 "poly:lasso:view=raw",
                                 "poly:formula=position_mm^2+t1_degC",
                                 "net:scg:hidden=2:iterations=20",
                                 "blend:view=raw:terms=linear"}) {
    const FittedModel fitted = MakeRecipe(spec)->Fit(training, {});
    ASSERT_TRUE(fitted.guards.has_value()) << spec;
    Eigen::MatrixXd far = fitted.FormInputs(training);
    for (Index j = 0; j < far.cols(); ++j) {
      far.col(j).array() +=
          10.0 * (far.col(j).maxCoeff() - far.col(j).minCoeff());
    }
    const Eigen::VectorXd errors = fitted.PredictForm(far).errors;
    const double margin = fitted.guards->error_margin * (high - low);
    EXPECT_GE(errors.minCoeff(), low - margin - 1e-12) << spec;
    EXPECT_LE(errors.maxCoeff(), high + margin + 1e-12) << spec;
    EXPECT_FALSE(
        MakeRecipe(spec + ":clip=none")->Fit(training, {}).guards.has_value())
        << spec;
  }
  EXPECT_FALSE(MakeRecipe("mean")->Fit(training, {}).guards.has_value());
}

TEST(FittedModel, RefusesARowOfAnotherSize) {
  const data::Dataset training = QuadraticData(60);
  FittedModel fitted = Guarded(training);
  const std::vector<double> row(3, 1.0);
  EXPECT_THROW(fitted.PredictFormRow(row, nullptr), std::invalid_argument);
  fitted.guards.reset();
  EXPECT_THROW(fitted.PredictFormRow(row, nullptr), std::invalid_argument);
}

// A model of somebody's own, without a form.
struct Constant final : ErrorModel {
  Index num_inputs() const override { return 3; }
  Index num_parameters() const override { return 1; }
  double DoPredictRow(const double* /*inputs*/) const override { return 0.5; }
};

struct ConstantRecipe final : ModelRecipe {
  std::string name() const override { return "my:constant"; }
  ModelKind kind() const override { return ModelKind::kFile; }
  FittedModel Fit(const data::Dataset& training,
                  const FitContext& /*context*/) const override {
    return MapOfModel(*this, training, std::make_shared<Constant>());
  }
};

TEST(OpaqueModel, PredictsButNoFileHoldsIt) {
  const data::Dataset training = QuadraticData(60);
  const FittedModel fitted = ConstantRecipe().Fit(training, {});
  EXPECT_EQ(fitted.Predict(training), Eigen::VectorXd::Constant(60, 0.5));
  EXPECT_TRUE(std::holds_alternative<OpaqueForm>(fitted.model->Describe()));
  EXPECT_THAT([&] { ModelToJson(fitted, {}); },
              ::testing::ThrowsMessage<std::invalid_argument>(
                  ::testing::HasSubstr("a model file needs a map's formula")));
  EXPECT_THROW(MakeMapProgram(fitted), std::invalid_argument);
}

TEST(OpaqueModel, TakesPartInAStudyAndIsFittedAgainOnResume) {
  const data::Dataset training = QuadraticData(60);
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  recipes.push_back(std::make_unique<ConstantRecipe>());
  recipes.push_back(MakeRecipe("mean"));
  const auto holdouts = errmap::testing::MakeHoldouts(training, {"every:3"});
  const StudyResult study = RunStudy(training, holdouts, recipes, {});
  ASSERT_TRUE(study.models[0].ok()) << study.models[0].why();
  const Judgement judgement = JudgeStudy(training, holdouts, study, {});
  EXPECT_TRUE(judgement.recommendation);
  ComponentStudy component{
      .name = "x",
      .files = {{.file = "x.csv", .sha256 = ""}},
      .data = {.dataset = training, .dropped = {}, .remarks = {}, .faults = {}},
      .holdouts = holdouts,
      .study = study,
      .judgement = judgement};
  const ComponentRecord record = MakeComponentRecord(component);
  EXPECT_EQ(record.models[0].name, "my:constant");
}

}  // namespace
}  // namespace errmap::models
