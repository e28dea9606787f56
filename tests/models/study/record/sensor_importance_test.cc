#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/study/record/component_study.h"
#include "tests/models/history/history_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using errmap::testing::ColumnNamed;
using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;
using ::testing::ElementsAre;

constexpr Index kDays = 6;
constexpr Index kSensorImportanceRows = 20;  // of a day

// The error follows t1, which t2 repeats to a tenth of a degree, and a little
// of t3; t4 is idle.
data::Dataset DaysInSensorImportance() {
  Eigen::MatrixXd values(kDays * kSensorImportanceRows, 5);
  Eigen::VectorXd time(kDays * kSensorImportanceRows);
  Eigen::VectorXd error(kDays * kSensorImportanceRows);
  std::vector<Index> codes;
  for (Index row = 0; row < values.rows(); ++row) {
    const auto k = static_cast<double>(row);
    const double position = 10.0 * static_cast<double>(row % 10);
    const double t1 = 20.0 + 4.0 * std::sin(0.11 * k);
    const double t3 = 22.0 + std::cos(0.37 * k * k);
    values.row(row) << position, t1, t1 + 0.1 * std::sin(7.0 * k), t3,
        25.0 + std::sin(0.53 * k * k);
    time[row] = 60.0 * k;
    error[row] = 0.01 * position + 2.0 * (t1 - 20.0) + 0.5 * t3 +
                 0.05 * std::sin(12.9898 * k * k);
    codes.push_back(row / kSensorImportanceRows);
  }
  const data::Dataset rows =
      errmap::testing::WithLog({ColumnNamed("position_mm"),
                                ColumnNamed("t1_degC"),
                                ColumnNamed("t2_degC"),
                                ColumnNamed("t3_degC"),
                                ColumnNamed("t4_degC")},
                               values,
                               time,
                               codes);
  data::Dataset::Parts parts;
  parts.source = "days";
  parts.inputs = rows.inputs();
  parts.input_values = rows.input_values();
  parts.target = rows.target();
  parts.target_values = error;
  parts.log = rows.log();
  parts.log_rows = rows.log_rows();
  return data::Dataset(std::move(parts));
}

struct JudgedInSensorImportance {
  StudyResult study;
  std::optional<SensorImportance> importance;
  double rmse = 0.0;
};

JudgedInSensorImportance Importance(const std::string& spec,
                                    const std::string& holdout = "sessions:3") {
  const data::Dataset dataset = DaysInSensorImportance();
  const auto holdouts = MakeHoldouts(dataset, {holdout});
  JudgedInSensorImportance judged;
  judged.study = RunStudy(dataset, holdouts, MakeRecipes({spec}), {});
  const ModelResult& model = judged.study.models.front();
  EXPECT_TRUE(model.ok()) << model.why();
  judged.rmse = model.holdouts.front().test.rmse;
  judged.importance = ImportanceOfSensors(dataset,
                                          holdouts.front(),
                                          model.holdouts.front(),
                                          *model.final_fit,
                                          nullptr);
  return judged;
}

double Without(const std::vector<SensorImportance::Without>& list,
               const std::vector<std::string>& sensors) {
  for (const auto& without : list) {
    if (without.sensors == sensors) return without.rmse;
  }
  ADD_FAILURE() << sensors.front();
  return 0.0;
}

TEST(SensorImportance, TellsAlikeSensorsApartFromNeedlessOnes) {
  const JudgedInSensorImportance judged = Importance("poly:full:degree=1");
  ASSERT_TRUE(judged.importance);
  const SensorImportance& found = *judged.importance;
  EXPECT_EQ(found.rows, kDays * kSensorImportanceRows);
  EXPECT_NEAR(found.rmse, judged.rmse, 1e-12 * judged.rmse);
  ASSERT_EQ(found.one_by_one.size(), 4U);
  // t3 has no other to stand in for it, t1 has t2, and t4 says nothing.
  EXPECT_THAT(found.one_by_one.front().sensors, ElementsAre("t3_degC"));
  EXPECT_NEAR(found.one_by_one.front().rmse, 0.5 / std::sqrt(2.0), 0.05);
  EXPECT_LT(Without(found.one_by_one, {"t1_degC"}), 0.25);
  EXPECT_NEAR(Without(found.one_by_one, {"t4_degC"}), found.rmse, 0.01);
  // Together t1 and t2 are what the map is made of.
  ASSERT_EQ(found.together.size(), 2U);
  EXPECT_THAT(found.together[0].sensors, ElementsAre("t1_degC", "t2_degC"));
  EXPECT_GT(found.together[0].rmse, 50.0 * found.rmse);
  EXPECT_EQ(found.together[1].sensors.size(), 4U);
  EXPECT_GT(found.together[1].rmse, 50.0 * found.rmse);
}

TEST(SensorImportance, RunsThroughTheMemoryOfAMap) {
  const JudgedInSensorImportance judged =
      Importance("poly:ridge:view=history:terms=linear");
  ASSERT_TRUE(judged.importance);
  const SensorImportance& found = *judged.importance;
  EXPECT_NEAR(found.rmse, judged.rmse, 1e-12 * judged.rmse);
  EXPECT_GT(Without(found.together, {"t1_degC", "t2_degC"}), 5.0 * found.rmse);
  EXPECT_NEAR(
      Without(found.one_by_one, {"t4_degC"}), found.rmse, 0.1 * found.rmse);
}

TEST(SensorImportance, IsOfMapsWithSensorsOnly) {
  EXPECT_FALSE(Importance("poly:position").importance);
  EXPECT_TRUE(Importance("poly:temperature").importance);
  // Once the maps of the folds are gone there is nothing to take away from.
  const data::Dataset dataset = DaysInSensorImportance();
  const auto holdouts = MakeHoldouts(dataset, {"sessions:3"});
  StudyResult study =
      RunStudy(dataset, holdouts, MakeRecipes({"poly:full:degree=1"}), {});
  ForgetFoldMaps(&study);
  EXPECT_FALSE(ImportanceOfSensors(dataset,
                                   holdouts.front(),
                                   study.models.front().holdouts.front(),
                                   *study.models.front().final_fit,
                                   nullptr));
}

TEST(SensorImportance, StopsWhenAskedTo) {
  const data::Dataset dataset = DaysInSensorImportance();
  const auto holdouts = MakeHoldouts(dataset, {"sessions:3"});
  const StudyResult study =
      RunStudy(dataset, holdouts, MakeRecipes({"poly:full:degree=1"}), {});
  const std::atomic<bool> stop = true;
  EXPECT_FALSE(ImportanceOfSensors(dataset,
                                   holdouts.front(),
                                   study.models.front().holdouts.front(),
                                   *study.models.front().final_fit,
                                   &stop));
}

}  // namespace
}  // namespace errmap::models
