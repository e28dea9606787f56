#include "models/sensors/applicability.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "models/history/history.h"
#include "models/history/with_history.h"
#include "models/model_file.h"
#include "models/recipe_catalog.h"
#include "models/uncertainty/add_uncertainty.h"
#include "stats/random.h"
#include "tests/models/history/history_data.h"
#include "tests/models/model_test_data.h"
#include "tests/models/simulated_days.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::SimulatedDays;

// A map of four simulated days, of every other row of them.
class FlagsOfAThermalMachine : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const data::Dataset days = SimulatedDays(3, 4, 16);
    std::vector<Index> even;
    std::vector<Index> odd;
    for (Index row = 0; row < days.num_rows(); ++row) {
      (row % 2 == 0 ? even : odd).push_back(row);
    }
    const data::Dataset training = days.SelectRows(even);
    map_ = new FittedModel(MakeRecipe("poly:full:degree=1")->Fit(training, {}));
    AddExperience(training, map_);
    between_ = new MatrixXd(days.SelectRows(odd).input_values());
  }
  static void TearDownTestSuite() {
    delete map_;
    delete between_;
  }

  // Rows of the second day.
  static MatrixXd OneDay() {
    return between_->middleRows(between_->rows() / 4, between_->rows() / 4);
  }
  static Index ColumnOf(const std::string& name) {
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
      if (map_->inputs[i].column.name == name) return static_cast<Index>(i);
    }
    ADD_FAILURE() << name;
    return 0;
  }
  // Share of rows flagged, and of those the share that names `column`.
  struct Shares {
    double flagged = 0.0;
    double named = 0.0;
  };
  static Shares SharesOf(const MatrixXd& inputs, const std::string& column) {
    const std::vector<RowFlag> flags = FlagRows(*map_, inputs, inputs);
    const auto flagged =
        static_cast<double>(std::ranges::count_if(flags, &RowFlag::outside));
    const auto named = static_cast<double>(std::ranges::count_if(
        flags,
        [&](const RowFlag& flag) { return flag.column.name == column; }));
    return {flagged / static_cast<double>(flags.size()),
            named / std::max(flagged, 1.0)};
  }

  static FittedModel* map_;
  static MatrixXd* between_;
};

FittedModel* FlagsOfAThermalMachine::map_ = nullptr;
MatrixXd* FlagsOfAThermalMachine::between_ = nullptr;

TEST_F(FlagsOfAThermalMachine, LeavesRowsBetweenTrainedOnesAlone) {
  EXPECT_LT(SharesOf(*between_, "").flagged, 0.02);
}

TEST_F(FlagsOfAThermalMachine, FindsASensorRaisedByFiveDegrees) {
  MatrixXd inputs = OneDay();
  inputs.col(ColumnOf("t12_degC")).array() += 5.0;
  const Shares shares = SharesOf(inputs, "t12_degC");
  EXPECT_GT(shares.flagged, 0.99);
  EXPECT_GT(shares.named, 0.95);
}

// The coolant tank too, with which no other reading goes.
TEST_F(FlagsOfAThermalMachine, FindsEverySensorThatIsDeadOrBeyondItsRange) {
  for (const TrainedInput& input : map_->inputs) {
    const std::string& name = input.column.name;
    if (input.column.unit.symbol != "degC") continue;
    for (const bool dead : {true, false}) {
      MatrixXd inputs = OneDay();
      auto readings = inputs.col(ColumnOf(name));
      if (dead) {
        readings.setZero();
      } else {
        readings.array() += input.max + 5.0 - readings.maxCoeff();
      }
      const Shares shares = SharesOf(inputs, name);
      EXPECT_EQ(shares.flagged, 1.0) << name;
      EXPECT_GT(shares.named, 0.95) << name;
    }
  }
}

TEST_F(FlagsOfAThermalMachine, FindsSwappedColumns) {
  // Both within the range of the other: the relation alone tells.
  MatrixXd inputs = OneDay();
  inputs.col(ColumnOf("t12_degC")).swap(inputs.col(ColumnOf("t27_degC")));
  EXPECT_GT(SharesOf(inputs, "").flagged, 0.9);
}

TEST_F(FlagsOfAThermalMachine, FindsKelvinForCelsius) {
  MatrixXd inputs = OneDay();
  for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
    if (map_->inputs[i].column.unit.symbol == "degC") {
      inputs.col(static_cast<Index>(i)).array() += 273.15;
    }
  }
  const std::vector<RowFlag> flags = FlagRows(*map_, inputs, inputs);
  for (const RowFlag& flag : flags) {
    EXPECT_TRUE(flag.outside());
    EXPECT_NE(flag.column.name, "");
  }
}

TEST_F(FlagsOfAThermalMachine, IsTheSameFromAFile) {
  const FittedModel loaded =
      ModelFromJson(ModelToJson(*map_, {}), "saved.json");
  MatrixXd inputs = *between_;
  inputs.col(ColumnOf("t12_degC")).array() += 0.7;
  const std::vector<RowFlag> fresh = FlagRows(*map_, inputs, inputs);
  const std::vector<RowFlag> read = FlagRows(loaded, inputs, inputs);
  Index differing = 0;
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    differing += fresh[i].why != read[i].why ? 1 : 0;
  }
  // Six digits are kept of limits, so that a row on one may fall either way.
  EXPECT_LE(differing, 2);
  EXPECT_EQ(ModelToJson(loaded, {}), ModelToJson(*map_, {}));
}

TEST(MeasureStates, AgreesWithTheConditionalMeanOfTwoColumns) {
  // x' = W z + rest with W = (2, 1)', rest (0.5, 0.25): covariance
  // [4.5 2; 2 1.25], so that E(x1 | x2) = 2 / 1.25 x2 and its variance is
  // 4.5 - 4 / 1.25.
  Applicability trained;
  trained.columns = {0, 1};
  trained.mean = VectorXd::Zero(2);
  trained.scale = VectorXd::Ones(2);
  trained.directions = MatrixXd{{2.0}, {1.0}};
  trained.rest = VectorXd{{0.5, 0.25}};
  trained.states = MatrixXd{{0.0}, {1.0}};
  trained.rows = 11;
  const StateMeasures found = MeasureStates(trained, MatrixXd{{3.0, 1.0}});
  EXPECT_NEAR(found.expected(0, 0), 1.6, 1e-12);
  EXPECT_NEAR(found.relation(0, 0), 1.4 / std::sqrt(4.5 - 3.2), 1e-12);
  // Score (2 * 3 + 1) / 5, nearest the state at 1.
  EXPECT_NEAR(found.distance[0], 0.4, 1e-12);
  EXPECT_NEAR(found.leverage[0], 1.0 / 11.0 + 1.4 * 1.4 / 10.0, 1e-12);
}

TEST(MakeApplicability, HasNothingForAMapOfPositionsAlone) {
  const data::Dataset dataset = errmap::testing::ShippedMeasurements();
  const FittedModel fitted = MakeRecipe("poly:position")->Fit(dataset, {});
  EXPECT_FALSE(MakeApplicability(fitted, dataset).has_value());
}

TEST(FlagRows, KnowsTheRangesOfWhatIsDerived) {
  const data::Dataset days = errmap::testing::WanderingDays();
  const History history{
      .time_unit = "s",
      .session = "day",
      .derived = {Ema(days.inputs()[0], 600.0, "s"), Zeroed(days.inputs()[1])},
      .form_inputs = {"ema(t1_degC,600s)", "zeroed(t2_degC)"}};
  const data::Dataset derived = DeriveDataset(days, history);
  FittedModel fitted = WithHistory(
      MakeRecipe("poly:full:degree=1")->Fit(derived, {}), days, history);
  AddExperience(days, &fitted);
  ASSERT_EQ(fitted.applicability->derived.size(), 2U);
  const MatrixXd inputs = days.input_values().topRows(1);
  MatrixXd form = fitted.FormInputs(days).topRows(1);
  EXPECT_FALSE(FlagRows(fitted, inputs, form)[0].outside());
  form(0, 1) += 50.0;
  const RowFlag flag = FlagRows(fitted, inputs, form)[0];
  EXPECT_EQ(flag.why, Outside::kRange);
  EXPECT_EQ(flag.column.name, "zeroed(t2_degC)");
}

// A fold knows of no other session than those it was trained on.
TEST(InsideOfFolds, HoldsEachRowAgainstTheTrainingOfItsOwnFold) {
  const data::Dataset days = SimulatedDays(3, 4, 16);
  FittedModel fitted = MakeRecipe("poly:full:degree=1")->Fit(days, {});
  AddExperience(days, &fitted);
  const Index per_day = days.num_rows() / 4;
  Holdout holdout;
  stats::Fold fold;
  for (Index row = 0; row < days.num_rows(); ++row) {
    (row / per_day == 2 ? fold.test : fold.train).push_back(row);
  }
  holdout.folds.push_back(fold);
  const std::vector<bool> inside = InsideOfFolds(fitted, days, holdout);
  const data::Dataset others = days.SelectRows(fold.train);
  FittedModel of_others = MakeRecipe("poly:full:degree=1")->Fit(others, {});
  AddExperience(others, &of_others);
  const MatrixXd held = days.SelectRows(fold.test).input_values();
  const std::vector<RowFlag> flags = FlagRows(of_others, held, held);
  ASSERT_EQ(inside.size(), flags.size());
  for (std::size_t row = 0; row < flags.size(); ++row) {
    EXPECT_EQ(inside[row], !flags[row].outside()) << row;
  }
  EXPECT_GT(std::ranges::count(inside, false), 0);
  EXPECT_LT(
      std::ranges::count_if(FlagRows(fitted, held, held), &RowFlag::outside),
      std::ranges::count(inside, false));
}

TEST(InsideOfFolds, HoldsTheRowsOfAnotherFileAgainstAllOfTraining) {
  const data::Dataset days = SimulatedDays(3, 4, 16);
  std::vector<Index> first;
  std::vector<Index> last;
  for (Index row = 0; row < days.num_rows(); ++row) {
    (row < 3 * days.num_rows() / 4 ? first : last).push_back(row);
  }
  const data::Dataset training = days.SelectRows(first);
  const auto test =
      std::make_shared<const data::Dataset>(days.SelectRows(last));
  FittedModel fitted = MakeRecipe("poly:full:degree=1")->Fit(training, {});
  AddExperience(training, &fitted);
  const Holdout holdout =
      MakeHoldout(stats::ParseHoldout("file:last.csv"), training, 1, test);
  const std::vector<bool> inside = InsideOfFolds(fitted, training, holdout);
  const std::vector<RowFlag> flags =
      FlagRows(fitted, test->input_values(), test->input_values());
  ASSERT_EQ(inside.size(), flags.size());
  for (std::size_t row = 0; row < flags.size(); ++row) {
    EXPECT_EQ(inside[row], !flags[row].outside()) << row;
  }
}

}  // namespace
}  // namespace errmap::models
