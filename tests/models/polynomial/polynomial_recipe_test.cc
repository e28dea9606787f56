#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"
#include "models/polynomial/polynomial_basis.h"
#include "models/polynomial/polynomial_model.h"
#include "models/polynomial/polynomial_options.h"
#include "models/recipe_catalog.h"
#include "tests/models/model_test_data.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using errmap::testing::QuadraticData;
using errmap::testing::ShippedMeasurements;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

FittedModel FitSpecInPolynomialRecipe(const std::string& spec,
                                      const data::Dataset& dataset) {
  return MakeRecipe(spec)->Fit(dataset, {});
}

// Coefficients of poly:eq8 on all 397 rows, computed independently with an
// extended-precision QR in T = elapsed_cycles + 1.
TEST(PolynomialRecipe, FitsEq8ToTheShippedMeasurementsToEveryPrintedDigit) {
  constexpr double kPrinted = 5e-9;  // half a unit of the ninth digit
  const FittedModel fitted =
      FitSpecInPolynomialRecipe("poly:eq8", ShippedMeasurements());
  const auto* model = dynamic_cast<const PolynomialModel*>(fitted.model.get());
  ASSERT_NE(model, nullptr);
  const auto terms = ExpandToPhysicalUnits(model->form());
  ASSERT_EQ(terms.size(), 5U);  // 1, x, c, x^2, x c with c = T - 1
  const double x = terms[1].coefficient;
  const double c = terms[2].coefficient;
  const double xx = terms[3].coefficient;
  const double xc = terms[4].coefficient;
  const auto expect = [&](double found, double expected) {
    EXPECT_NEAR(found, expected, kPrinted * std::abs(expected));
  };
  expect(terms[0].coefficient - c, 3.79060810e-03);
  expect(x - xc, 1.81768672e-04);
  expect(xx, 3.34501809e-07);
  expect(c, -3.44191606e-05);
  expect(xc, -1.00389845e-06);
}

TEST(PolynomialRecipe, RecoversAKnownPolynomialAndItsTemperature) {
  const data::Dataset dataset = QuadraticData(60);
  const FittedModel fitted = FitSpecInPolynomialRecipe("poly:eq8", dataset);
  ASSERT_EQ(fitted.inputs.size(), 2U);
  EXPECT_EQ(fitted.inputs[0].column.name, "position_mm");
  EXPECT_EQ(fitted.inputs[1].column.name, "t1_degC");
  EXPECT_LT(
      (fitted.Predict(dataset) - dataset.target_values()).cwiseAbs().maxCoeff(),
      1e-15);
  EXPECT_EQ(fitted.model->num_parameters(), 5);
}

// An error that is quadratic in a temperature from 0 to 10 and goes with it
// times a position from 0 to 1.
data::Dataset BentRows(double lowest, double highest) {
  constexpr Index kRows = 200;
  data::Dataset::Parts parts;
  parts.source = "bent";
  parts.inputs = {{"position_mm", data::UnitOfColumn("position_mm")},
                  {"t_degC", data::UnitOfColumn("t_degC")}};
  parts.input_values.resize(kRows, 2);
  parts.input_values.col(0) =
      Eigen::VectorXd::LinSpaced(kRows, 0.0, 60.0).array().sin().abs();
  parts.input_values.col(1) =
      Eigen::VectorXd::LinSpaced(kRows, lowest, highest);
  parts.target = {"error_um", data::UnitOfColumn("error_um")};
  const Eigen::ArrayXd x = parts.input_values.col(0);
  const Eigen::ArrayXd t = parts.input_values.col(1);
  parts.target_values = 0.1 * t.square() + 0.7 * x * t;
  return data::Dataset(std::move(parts));
}

TEST(PolynomialRecipe, GoesOnStraightBeyondATenthOfWhereItWasTrained) {
  const data::Dataset training = BentRows(0.0, 10.0);
  const data::Dataset near = BentRows(-1.0, 11.0);
  for (const std::string spec :
       {"poly:ridge:terms=full:degree=2:penalty=1e-9",
        "poly:lasso:terms=full:degree=2:penalty=1e-9"}) {
    const FittedModel fitted = FitSpecInPolynomialRecipe(spec, training);
    const Eigen::VectorXd within = fitted.Predict(near) - near.target_values();
    EXPECT_LT(within.cwiseAbs().maxCoeff(), 1e-4) << spec;
    // At one position equal steps of temperature are equal steps of error,
    // which the position still decides.
    const auto at = [&](double position, double temperature) {
      return fitted.PredictForm(Eigen::RowVector2d(position, temperature))
          .errors[0];
    };
    for (const double position : {0.0, 0.25}) {
      const double step = at(position, 13.0) - at(position, 12.0);
      EXPECT_NEAR(at(position, 14.0) - at(position, 13.0), step, 1e-9) << spec;
      EXPECT_NEAR(step, 1.0 + 0.7 * position, 0.08) << spec;
    }
    EXPECT_NEAR(FitSpecInPolynomialRecipe(spec + ":clip=none", training)
                    .PredictForm(Eigen::RowVector2d(0.5, 30.0))
                    .errors[0],
                0.1 * 900.0 + 0.7 * 15.0,
                1e-2)
        << spec;
  }
}

TEST(PolynomialRecipe, TakesTheTemperatureThatIsNamed) {
  const FittedModel fitted =
      FitSpecInPolynomialRecipe("poly:eq9:T=t2_degC", QuadraticData(60));
  EXPECT_EQ(fitted.inputs[1].column.name, "t2_degC");
  EXPECT_THROW(
      FitSpecInPolynomialRecipe("poly:eq9:T=t3_degC", QuadraticData(60)),
      std::invalid_argument);
}

TEST(PolynomialRecipe, StepwiseLeavesOutAnInputWithoutAPart) {
  const data::Dataset dataset = QuadraticData(60);
  const FittedModel fitted =
      FitSpecInPolynomialRecipe("poly:stepwise:degree=2", dataset);
  for (const TrainedInput& input : fitted.inputs) {
    EXPECT_NE(input.column.name, "t2_degC");
  }
  EXPECT_LT(
      (fitted.Predict(dataset) - dataset.target_values()).cwiseAbs().maxCoeff(),
      1e-9);
}

TEST(PolynomialRecipe, BaselinesAreZeroAndTheMean) {
  const data::Dataset dataset = QuadraticData(10);
  EXPECT_TRUE(
      FitSpecInPolynomialRecipe("zero", dataset).Predict(dataset).isZero());
  EXPECT_EQ(FitSpecInPolynomialRecipe("zero", dataset).model->num_parameters(),
            0);
  const FittedModel mean = FitSpecInPolynomialRecipe("mean", dataset);
  EXPECT_NEAR(mean.Predict(dataset)[3], dataset.target_values().mean(), 1e-15);
  EXPECT_EQ(mean.kind, ModelKind::kBaseline);
}

TEST(PolynomialRecipe, NamesTermsThatFollowFromOthers) {
  // Seven positions carry powers up to the sixth: the seventh is aliased.
  const data::Dataset all = QuadraticData(40);
  data::Dataset::Parts parts;
  parts.source = "positions";
  parts.inputs = {all.inputs()[0]};
  parts.input_values = all.input_values().col(0);
  parts.target = all.target();
  parts.target_values = all.target_values();
  const FittedModel fitted = FitSpecInPolynomialRecipe(
      "poly:full:degree=7", data::Dataset(std::move(parts)));
  EXPECT_EQ(fitted.model->num_parameters(), 7);
  ASSERT_EQ(fitted.remarks.size(), 1U);
  EXPECT_THAT(fitted.remarks[0], HasSubstr("1 of 7 terms"));
}

TEST(PolynomialRecipe, RefusesMoreCoefficientsThanRows) {
  try {
    FitSpecInPolynomialRecipe("poly:full:degree=2", QuadraticData(9));
    FAIL() << "10 coefficients were fitted to 9 rows";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("10 coefficients"));
    EXPECT_THAT(error.what(), HasSubstr("9 training rows"));
  }
  EXPECT_THROW(FitSpecInPolynomialRecipe("poly:stepwise", QuadraticData(2)),
               std::invalid_argument);
}

TEST(PolynomialRecipe, SaysThatAPositionIsMissing) {
  const data::Dataset all = QuadraticData(20);
  data::Dataset::Parts parts;
  parts.source = "temperatures";
  parts.inputs = {all.inputs()[1], all.inputs()[2]};
  parts.input_values = all.input_values().rightCols(2);
  parts.target = all.target();
  parts.target_values = all.target_values();
  const data::Dataset dataset(std::move(parts));
  EXPECT_THAT(MakeRecipe("poly:eq8")->WhatIsMissing(dataset).value_or(""),
              HasSubstr("a position"));
  EXPECT_EQ(MakeRecipe("poly:temperature")->WhatIsMissing(dataset),
            std::nullopt);
  const DefaultRecipes defaults = MakeDefaultRecipes(dataset, 20);
  EXPECT_THAT(defaults.left_out,
              ElementsAre(HasSubstr("poly:position, poly:eq7, poly:eq8, "
                                    "poly:eq9 are left out")));
}

TEST(PolynomialRecipe, TakesNoSecondAxisForATemperature) {
  const data::Dataset all = QuadraticData(20);
  data::Dataset::Parts parts;
  parts.source = "two axes";
  parts.inputs = {all.inputs()[0], all.inputs()[0]};
  parts.inputs[1].name = "y_mm";
  parts.input_values = all.input_values()(Eigen::all, {0, 0});
  parts.target = all.target();
  parts.target_values = all.target_values();
  EXPECT_THAT(MakeRecipe("poly:temperature")
                  ->WhatIsMissing(data::Dataset(std::move(parts)))
                  .value_or(""),
              HasSubstr("a temperature"));
}

TEST(PolynomialRecipe, CountsARowOfWeightThreeAsThreeRows) {
  const data::Dataset all = ShippedMeasurements();
  std::vector<Eigen::Index> rows;
  data::Dataset::Parts weighted;
  weighted.source = "weighted";
  weighted.inputs = all.inputs();
  weighted.input_values = all.input_values().topRows(30);
  weighted.target = all.target();
  weighted.target_values = all.target_values().head(30);
  weighted.weights = Eigen::VectorXd::Ones(30);
  for (Eigen::Index i = 0; i < 30; ++i) {
    rows.push_back(i);
    if (i % 4 == 0) {
      weighted.weights[i] = 3.0;
      rows.insert(rows.end(), 2, i);
    }
  }
  const data::Dataset repeated = all.SelectRows(rows);
  const Eigen::VectorXd a =
      FitSpecInPolynomialRecipe("poly:eq8", data::Dataset(std::move(weighted)))
          .Predict(all);
  const Eigen::VectorXd b =
      FitSpecInPolynomialRecipe("poly:eq8", repeated).Predict(all);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace errmap::models
