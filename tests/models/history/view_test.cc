#include "models/history/view.h"

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/model_options.h"
#include "models/polynomial/polynomial_options.h"
#include "models/recipe_catalog.h"
#include "tests/models/history/history_data.h"

namespace errmap::models {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::optional<ViewOptions> ViewIn(const std::string& text) {
  return OptionsOf<PenalizedOptions>("poly:ridge" + text).basis.view;
}

std::vector<std::string> NamesOfInView(const data::Dataset& dataset) {
  std::vector<std::string> names;
  for (const data::ColumnInfo& input : dataset.inputs()) {
    names.push_back(input.name);
  }
  return names;
}

TEST(View, AModelWithoutAWordOfViewsReadsItsInputsAsTheyAre) {
  const auto views =
      MakeViews(errmap::testing::WanderingDays(), ViewIn(""), 0.0);
  ASSERT_EQ(views.size(), 1U);
  EXPECT_EQ(views[0].view, View::kRaw);
  EXPECT_EQ(views[0].history, nullptr);
  EXPECT_TRUE(views[0].intercept);
}

TEST(View, AutoOffersRawHistoryAndHistoryWithZero) {
  const auto views =
      MakeViews(errmap::testing::WanderingDays(), ViewIn(":view=auto"), 0.0);
  ASSERT_EQ(views.size(), 3U);
  EXPECT_EQ(views[0].view, View::kRaw);
  EXPECT_EQ(views[1].view, View::kHistory);
  EXPECT_EQ(views[2].view, View::kHistoryAndZero);
  // Two inputs, and each through three filters.
  EXPECT_EQ(views[1].rows->num_inputs(), 8);
  EXPECT_EQ(views[2].rows->num_inputs(), 8);
}

// Two runs of two rotary axes; `span` is how far the second turns, in deg.
data::Dataset TurningAxes(double span) {
  constexpr Eigen::Index kRows = 40;
  Eigen::MatrixXd values(2 * kRows, 2);
  std::vector<Eigen::Index> codes;
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    const double k = static_cast<double>(row);
    values.row(row) << 0.1 * std::sin(k),
        span * 0.5 * (1.0 + std::cos(0.3 * k));
    codes.push_back(row / kRows);
  }
  return errmap::testing::WithLog(
      {errmap::testing::ColumnNamed("tilt_mrad"),
       errmap::testing::ColumnNamed("c_deg")},
      values,
      Eigen::VectorXd::LinSpaced(2 * kRows, 0.0, 790.0),
      codes);
}

TEST(View, AutoTriesSineAndCosineOfAnglesThatTurnFar) {
  const auto near = MakeViews(TurningAxes(20.0), ViewIn(":view=auto"), 0.0);
  const auto far = MakeViews(TurningAxes(180.0), ViewIn(":view=auto"), 0.0);
  EXPECT_EQ(far.size(), 2 * near.size());
  ASSERT_GE(far.size(), 2U);
  EXPECT_EQ(far[0].label(), "raw");
  EXPECT_EQ(far[1].label(), "raw with sine and cosine");
  EXPECT_THAT(
      NamesOfInView(*far[1].rows),
      ElementsAre(
          "sin(tilt_mrad)", "cos(tilt_mrad)", "sin(c_deg)", "cos(c_deg)"));
  const data::Dataset axes = TurningAxes(180.0);
  EXPECT_NEAR(far[1].rows->input_values()(7, 3),
              std::cos(axes.input_values()(7, 1) * std::acos(-1.0) / 180.0),
              1e-15);
  EXPECT_EQ(MakeViews(axes, ViewIn(":view=auto:angles=none"), 0.0).size(),
            near.size());
  EXPECT_EQ(MakeViews(axes, ViewIn(":view=raw"), 0.0).size(), 1U);
}

TEST(View, NamesAndUnitsSayWhatADerivedInputIs) {
  const auto views = MakeViews(errmap::testing::WanderingDays(),
                               ViewIn(":history=300:zero=session"),
                               0.0);
  ASSERT_EQ(views.size(), 1U);
  EXPECT_THAT(NamesOfInView(*views[0].rows),
              ElementsAre("zeroed(t1_degC)",
                          "zeroed(t2_degC)",
                          "zeroed(ema(t1_degC,300s))",
                          "zeroed(ema(t2_degC,300s))"));
  EXPECT_EQ(views[0].rows->inputs()[2].unit.symbol, "degC");
}

TEST(View, TimeConstantsAreSharesOfTheMedianSession) {
  // Sessions of some 3900 s.
  const std::vector<double> constants =
      MakeTimeConstants(errmap::testing::WanderingDays());
  ASSERT_EQ(constants.size(), 3U);
  EXPECT_NEAR(constants[0], 39.0, 1.0);
  EXPECT_NEAR(constants[1], 130.0, 3.0);
  EXPECT_NEAR(constants[2], 390.0, 10.0);
}

TEST(View, AZeroNeedsTwoSessionsAndAFilterMoreThanPositions) {
  const data::Dataset days = errmap::testing::WanderingDays();
  std::vector<Eigen::Index> first(40);
  for (Eigen::Index i = 0; i < 40; ++i) {
    first[static_cast<std::size_t>(i)] = i;
  }
  const data::Dataset one = days.SelectRows(first);
  const auto views = MakeViews(one, ViewIn(":view=auto"), 0.0);
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[1].view, View::kHistory);
  try {
    MakeViews(one, ViewIn(":view=zero"), 0.0);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("two sessions"));
  }
}

TEST(View, AZeroedMapHasNoInterceptOnlyWhereSessionsBeginAtZero) {
  // The target is the row's number: day 1 begins at 0, days 2 and 3 do not.
  const data::Dataset days = errmap::testing::WanderingDays();
  EXPECT_EQ(LargestFirstError(days), 80.0);
  const auto zero = ViewIn(":view=history+zero");
  EXPECT_TRUE(MakeViews(days, zero, 1.0)[0].intercept);
  EXPECT_FALSE(MakeViews(days, zero, 80.0)[0].intercept);
  EXPECT_FALSE(
      MakeViews(days, ViewIn(":view=zero:intercept=no"), 1.0)[0].intercept);
}

TEST(View, RefusesTimeConstantsThatAreNone) {
  for (const char* text : {":history=0",
                           ":history=-3",
                           ":history=10+x",
                           ":history=10+",
                           ":history=inf"}) {
    EXPECT_THROW(ViewIn(text), std::invalid_argument) << text;
  }
}

TEST(View, PositionsStayAsTheyAreInAnyCase) {
  EXPECT_TRUE(data::IsPosition({"Position_mm", {}}));
  EXPECT_TRUE(data::IsPosition({"position", {}}));
  EXPECT_FALSE(data::IsPosition({"posit", {}}));
  EXPECT_FALSE(data::IsPosition({"t_position", {}}));
}

// Ten rows a day of an age, a temperature that comes and goes, and one that
// rises by the day but falls again within each.
data::Dataset AgeingDays(Eigen::Index days,
                         const std::function<double(double)>& error_of_age) {
  constexpr Eigen::Index kRows = 10;
  Eigen::MatrixXd values(days * kRows, 3);
  Eigen::VectorXd errors(values.rows());
  std::vector<Eigen::Index> codes;
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    const auto k = static_cast<double>(row);
    const auto day = static_cast<double>(row / kRows);
    values.row(row) << 0.1 * k, 20.0 + std::sin(k),
        20.0 + 0.1 * day + std::sin(k);
    errors[row] = error_of_age(values(row, 0)) + 0.2 * std::sin(k);
    codes.push_back(row / kRows);
  }
  const data::Dataset logged = errmap::testing::WithLog(
      {errmap::testing::ColumnNamed("age_days"),
       errmap::testing::ColumnNamed("t1_degC"),
       errmap::testing::ColumnNamed("t2_degC")},
      values,
      Eigen::VectorXd::LinSpaced(
          values.rows(), 0.0, 60.0 * static_cast<double>(values.rows() - 1)),
      codes);
  return errmap::testing::WithTargets(logged, errors);
}

TEST(ColumnsThatOnlyGrow, AreThoseThatNeverReturnOverThreeSessions) {
  const auto level = [](double /*age*/) { return 0.0; };
  EXPECT_THAT(ColumnsThatOnlyGrow(AgeingDays(4, level)),
              ElementsAre(true, false, false));
  EXPECT_THAT(ColumnsThatOnlyGrow(AgeingDays(2, level)),
              ElementsAre(false, false, false));
}

// Whatever the error did within the days known.
TEST(ColumnsThatOnlyGrow, AreStraightLinesUntilTheErrorHasLeftItsRangeByOne) {
  constexpr double kRounding = 1e-9;
  for (const auto& error_of_age : std::vector<std::function<double(double)>>{
           [](double age) { return age; },
           [](double age) { return age * age; },
           [](double age) { return 4.0 - 4.0 * std::exp(-age); }}) {
    const data::Dataset days = AgeingDays(5, error_of_age);
    for (const char* spec : {"poly:ridge:view=raw:terms=squares",
                             "poly:lasso:view=raw",
                             "blend:view=raw",
                             "poly:full:degree=1"}) {
      const FittedModel fitted = MakeRecipe(spec)->Fit(days, {});
      ASSERT_EQ(fitted.inputs[0].column.name, "age_days") << spec;
      Eigen::MatrixXd inputs = fitted.FormInputs(days).bottomRows(1);
      inputs = inputs.replicate(4, 1).eval();
      inputs.col(0) << 5.0, 6.0, 7.0, 1e3;
      const Eigen::VectorXd errors = fitted.PredictForm(inputs).errors;
      EXPECT_NEAR(errors[2] - errors[1], errors[1] - errors[0], kRounding)
          << spec;
      const double most = days.target_values().maxCoeff();
      const double range = most - days.target_values().minCoeff();
      EXPECT_LE(errors[3], most + range + kRounding) << spec;
      EXPECT_GT(errors[3], errors[2]) << spec;
    }
  }
}

}  // namespace
}  // namespace errmap::models
