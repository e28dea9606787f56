// Columns that only grow, and how far a line in them is believed.
#include "models/history/growth.h"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/history/growth_beyond.h"
#include "models/recipe_catalog.h"
#include "tests/models/history/history_data.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// An age, a temperature that comes and goes, and one that rises by the session
// but falls again within each.
data::Dataset AgeingDays(Index days) {
  constexpr Index kRows = 10;
  Eigen::MatrixXd values(days * kRows, 3);
  std::vector<Index> codes;
  for (Index row = 0; row < values.rows(); ++row) {
    const auto k = static_cast<double>(row);
    const auto day = static_cast<double>(row / kRows);
    values.row(row) << 0.1 * k, 20.0 + std::sin(k),
        20.0 + 0.1 * day + std::sin(k);
    codes.push_back(row / kRows);
  }
  return testing::WithLog(
      {testing::ColumnNamed("age_days"),
       testing::ColumnNamed("t1_degC"),
       testing::ColumnNamed("t2_degC")},
      values,
      Eigen::VectorXd::LinSpaced(
          values.rows(), 0.0, 60.0 * static_cast<double>(values.rows() - 1)),
      codes);
}

TEST(ColumnsThatOnlyGrow, AreThoseThatNeverReturnOverThreeSessions) {
  EXPECT_THAT(ColumnsThatOnlyGrow(AgeingDays(4)),
              ElementsAre(true, false, false));
  EXPECT_THAT(ColumnsThatOnlyGrow(AgeingDays(2)),
              ElementsAre(false, false, false));
}

// What bends is not extrapolated, what is straight may go on for long.
TEST(ColumnsThatOnlyGrow, HaveNoSquaresAndRoomToGoOn) {
  const data::Dataset days = AgeingDays(5);
  for (const char* spec : {"poly:ridge:view=raw:terms=squares",
                           "blend:view=raw",
                           "poly:full:degree=1"}) {
    const FittedModel fitted = MakeRecipe(spec)->Fit(days, {});
    Eigen::MatrixXd inputs = fitted.FormInputs(days).topRows(3);
    const Index age = 0;
    ASSERT_EQ(fitted.inputs[0].column.name, "age_days") << spec;
    const double range = fitted.inputs[0].max - fitted.inputs[0].min;
    inputs(0, age) = fitted.inputs[0].max + range;
    inputs.row(1) = inputs.row(0);
    inputs.row(2) = inputs.row(0);
    inputs(1, age) += range;
    inputs(2, age) += 2.0 * range;
    const Eigen::VectorXd errors = fitted.PredictForm(inputs).errors;
    EXPECT_NEAR(errors[2] - errors[1], errors[1] - errors[0], 1e-9) << spec;
  }
}

// The same days, of an error that is a function of the age in spans of them
// all.
data::Dataset DaysOfError(Index days, const std::function<double(double)>& of) {
  const data::Dataset made = AgeingDays(days);
  Eigen::VectorXd errors(made.num_rows());
  for (Index row = 0; row < errors.size(); ++row) {
    errors[row] =
        of(made.input_values()(row, 0) / static_cast<double>(days)) +
        0.2 * std::sin(static_cast<double>(row));  // the temperature's
  }
  return testing::WithTargets(made, errors);
}

TEST(RoomBeyond, IsAllOfItWhereALineWentOn) {
  EXPECT_EQ(RoomBeyond(DaysOfError(6, [](double age) { return 4.0 * age; })),
            3.0);
  // Nothing that grows tells of the error: no slope is to go on.
  EXPECT_EQ(RoomBeyond(DaysOfError(6, [](double) { return 0.0; })), 0.0);
}

// An F test has no degrees of freedom there; the days themselves tell.
TEST(RoomBeyond, AsksTheDaysWhereRowsAreNoMoreThanColumns) {
  data::Dataset days = DaysOfError(3, [](double age) { return 40.0 * age; });
  std::vector<Index> rows;
  for (Index row = 0; row < days.num_rows(); row += days.num_rows() / 3) {
    rows.push_back(row);
  }
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(RoomBeyond(days.SelectRows(rows)), 3.0);
}

TEST(RoomBeyond, IsLittleWhereWhatGrewDidNotGoOn) {
  const auto saturates = [](double age) {
    return 4.0 * (1.0 - std::exp(-3.0 * age));
  };
  EXPECT_LE(RoomBeyond(DaysOfError(6, saturates)), 0.5);
}

double Parabola(double age) { return 4.0 * age * age; }

TEST(GrowthBeyond, BendsWhereThatForetoldAllLaterDays) {
  EXPECT_EQ(GrowthBeyond(DaysOfError(10, Parabola)), Growth::kBending);
  EXPECT_EQ(GrowthBeyond(DaysOfError(10, [](double age) { return 4.0 * age; })),
            Growth::kStraight);
  // A parabola foretells that these come back.
  EXPECT_EQ(
      GrowthBeyond(DaysOfError(
          10, [](double age) { return 4.0 - 4.0 * std::exp(-9.0 * age); })),
      Growth::kStraight);
  // Of five days the fourth and the fifth alone are foretold from enough.
  EXPECT_EQ(GrowthBeyond(DaysOfError(5, Parabola)), Growth::kStraight);
}

TEST(GrowthBeyond, LetsASlopeFollowTheTemperature) {
  const data::Dataset days = AgeingDays(10);
  const auto& values = days.input_values();
  const Eigen::VectorXd errors =
      values.col(0).array() * (3.0 + 0.5 * (values.col(1).array() - 20.0));
  EXPECT_EQ(GrowthBeyond(testing::WithTargets(days, errors)),
            Growth::kWithOthers);
}

data::Dataset InUnits(const data::Dataset& days, double per_unit) {
  return testing::WithTargets(
      testing::WithLog(days.inputs(),
                       per_unit * days.input_values(),
                       Eigen::VectorXd::LinSpaced(days.num_rows(), 0.0, 6e3),
                       days.session_codes()),
      days.target_values());
}

TEST(GrowthBeyond, DependsOnNoUnit) {
  const data::Dataset bends = DaysOfError(10, Parabola);
  const data::Dataset goes_on =
      DaysOfError(6, [](double age) { return 4.0 * age; });
  for (const double per_unit : {1e-9, 1e9, 1e100}) {
    EXPECT_EQ(GrowthBeyond(InUnits(bends, per_unit)), Growth::kBending)
        << per_unit;
    EXPECT_EQ(RoomBeyond(InUnits(goes_on, per_unit)), 3.0) << per_unit;
  }
}

TEST(GrowthBeyond, IsHowMapsGoOn) {
  const data::Dataset days = DaysOfError(10, Parabola);
  for (const char* spec : {"poly:ridge:view=raw:terms=squares",
                           "poly:lasso:view=raw",
                           "blend:view=raw"}) {
    const FittedModel fitted = MakeRecipe(spec)->Fit(days, {});
    Eigen::MatrixXd inputs = fitted.FormInputs(days).bottomRows(1);
    ASSERT_EQ(fitted.inputs[0].column.name, "age_days") << spec;
    inputs(0, 0) *= 2.0;
    EXPECT_NEAR(fitted.PredictForm(inputs).errors[0], Parabola(2.0), 0.8)
        << spec;
    EXPECT_THAT(
        fitted.remarks,
        Contains(HasSubstr("in a parabola of what only grows (age_days)")))
        << spec;
  }
}

TEST(RoomBeyond, EndsAMapThereAndNotAtOnce) {
  const data::Dataset days = DaysOfError(
      6, [](double age) { return 4.0 * (1.0 - std::exp(-3.0 * age)); });
  const double room = RoomBeyond(days);
  const FittedModel fitted = MakeRecipe("blend:view=raw")->Fit(days, {});
  ASSERT_EQ(fitted.inputs[0].column.name, "age_days");
  const double last = fitted.inputs[0].max;
  const double range = last - fitted.inputs[0].min;
  Eigen::MatrixXd inputs = fitted.FormInputs(days).topRows(3);
  for (Index row = 0; row < 3; ++row) inputs.row(row) = inputs.row(0);
  inputs(0, 0) = last;
  inputs(1, 0) = last + room * range;
  inputs(2, 0) = last + 3.0 * range;
  const Eigen::VectorXd errors = fitted.PredictForm(inputs).errors;
  EXPECT_NEAR(errors[2], errors[1], 1e-9);
  if (room > 0.0) {
    EXPECT_GT(errors[1], errors[0]);
  }
}

}  // namespace
}  // namespace errmap::models
