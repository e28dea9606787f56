#include "models/promise/sensor_check.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "models/promise/promise.h"
#include "models/recipe_catalog.h"
#include "tests/models/promise/simulated_days.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using errmap::testing::FirstSessions;
using errmap::testing::SimulatedDays;

constexpr int kTrained = 6;
constexpr int kLater = 4;

// A map with a memory of six simulated days, and four later ones.
class SensorsOfAThermalMachine : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const data::Dataset days = SimulatedDays(3, kTrained + kLater, 8);
    const data::Dataset training = FirstSessions(days, kTrained);
    map_ = new FittedModel(
        MakeRecipe("poly:ridge:view=history:terms=linear")->Fit(training, {}));
    AddExperience(training, map_);
    later_ = new data::Dataset(FirstSessions(days, kTrained, false));
  }
  static void TearDownTestSuite() {
    delete map_;
    delete later_;
  }

  static MatrixXd Day(Index day) {
    std::vector<Index> rows;
    const std::vector<Index> sessions = later_->session_codes();
    for (std::size_t i = 0; i < sessions.size(); ++i) {
      if (sessions[i] == kTrained + day) rows.push_back(static_cast<Index>(i));
    }
    std::vector<Index> columns;
    for (const TrainedInput& input : map_->inputs) {
      columns.push_back(later_->FindInput(input.column.name));
    }
    return later_->input_values()(rows, columns);
  }
  static Index At(const std::string& name) {
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
      if (map_->inputs[i].column.name == name) return static_cast<Index>(i);
    }
    ADD_FAILURE() << name;
    return 0;
  }
  static std::string Found(const MatrixXd& readings) {
    const auto found = FindSensorFault(*map_, readings, true);
    if (!found) return "";
    std::string text(ToString(found->fault));
    for (const data::ColumnInfo& column : found->columns) {
      text += " " + column.name;
    }
    return text;
  }

  static inline FittedModel* map_ = nullptr;
  static inline data::Dataset* later_ = nullptr;
};

TEST_F(SensorsOfAThermalMachine, AreSoundOnDaysLikeThoseOfTraining) {
  for (Index day = 0; day < kLater; ++day) {
    EXPECT_EQ(Found(Day(day)), "") << day;
    EXPECT_EQ(Found(Day(day).topRows(5)), "") << day;
  }
}

TEST_F(SensorsOfAThermalMachine, AreNamedWhereOneIsOffDeadOrFrozen) {
  for (const char* name : {"t05_degC", "t13_degC", "t28_degC"}) {
    for (Index day = 0; day < kLater; ++day) {
      MatrixXd off = Day(day);
      off.col(At(name)).array() += 10.0;
      EXPECT_EQ(Found(off), std::string("off ") + name) << day;
      EXPECT_EQ(Found(off.topRows(5)), std::string("off ") + name) << day;
      MatrixXd dead = Day(day);
      dead.col(At(name)).setZero();
      EXPECT_EQ(Found(dead), std::string("dead ") + name) << day;
      MatrixXd frozen = Day(day);
      frozen.col(At(name)).setConstant(frozen(0, At(name)));
      const std::string found = Found(frozen);
      EXPECT_NE(found.find(name), std::string::npos) << found;
    }
  }
}

TEST_F(SensorsOfAThermalMachine, AreNamedInTheUnitThatTheirFiguresFit) {
  MatrixXd kelvin = Day(0);
  kelvin.col(At("t05_degC")).array() += 273.15;
  const auto found = FindSensorFault(*map_, kelvin, true);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->fault, SensorFault::kUnit);
  EXPECT_EQ(found->looks_like, "K");
}

TEST_F(SensorsOfAThermalMachine, AreNamedWhereTwoAreSwapped) {
  MatrixXd swapped = Day(1);
  swapped.col(At("t05_degC")).swap(swapped.col(At("t28_degC")));
  EXPECT_EQ(Found(swapped), "swapped t05_degC t28_degC");
}

}  // namespace
}  // namespace errmap::models
