#include "models/study/rezero/rezeroed_study.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "models/comparison/compare.h"
#include "models/map_experience.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;
using ::testing::HasSubstr;

// Six days of eight hours whose error is 10 um/K of a temperature that swings,
// an offset of the day that no input shows, and 1 um an hour.
data::Dataset DriftingDays() {
  std::string text = "time_s,day,t1_degC,error_um\n";
  for (int day = 1; day <= 6; ++day) {
    for (int i = 0; i <= 48; ++i) {
      const double hour = i / 6.0;
      const double t1 = 20.0 + std::sin(0.9 * hour + day);
      text += fmt::format("{},{},{},{}\n",
                          86400 * day + 600 * i,
                          day,
                          t1,
                          10.0 * t1 + 30.0 * (day % 3) + hour);
    }
  }
  return data::MakeDataset(data::ParseCsv(text, "drifting"), {}).dataset;
}

RezeroRule RuleOfDays(const char* text) {
  std::string noise;
  return ParseRezero(text, &noise);
}

class RezeroedDays : public ::testing::Test {
 protected:
  data::Dataset dataset = DriftingDays();
  std::vector<Holdout> holdouts = MakeHoldouts(dataset, {"sessions:6"});
  StudyResult study = RunStudy(
      dataset, holdouts, MakeRecipes({"zero", "poly:full:degree=1"}), {});
};

TEST_F(RezeroedDays, AreJudgedLessTheOffsetOfTheDay) {
  const double before = study.models[1].holdouts[0].test.rmse;
  EXPECT_GT(before, 20.0);
  RezeroStudy(dataset, RuleOfDays("2h"), 1, &holdouts, &study);
  // What is left grows by 1 um an hour for up to two.
  EXPECT_LT(study.models[1].holdouts[0].test.rmse, 1.5);
  EXPECT_GT(study.models[0].holdouts[0].test.rmse, 3.0);
  for (const Holdout& holdout : holdouts) {
    for (const stats::Fold& fold : holdout.folds) {
      EXPECT_EQ(fold.test.size(), 48);  // less the first row
    }
  }
}

TEST_F(RezeroedDays, KeepWhatTheyWere) {
  const Eigen::VectorXd old =
      study.models[1].holdouts[0].folds[2].test_predictions;
  const BeforeRezero before =
      RezeroStudy(dataset, RuleOfDays("session"), 1, &holdouts, &study);
  EXPECT_EQ(before.results[1][0].folds[2].test_predictions, old);
  EXPECT_EQ(before.holdouts[0].folds[2].test.size(), 49);
}

TEST_F(RezeroedDays, StandBesideNoMap) {
  const RezeroRule rule = RuleOfDays("2h");
  const BeforeRezero before = RezeroStudy(dataset, rule, 1, &holdouts, &study);
  const RezeroWorth worth = WorthOfRezero(dataset, rule, 1, before, 0);
  EXPECT_NEAR(
      worth.models[1].rmse, study.models[1].holdouts[0].test.rmse, 1e-9);
  EXPECT_EQ(worth.no_map, worth.models[0].rmse);
  EXPECT_GT(worth.models[1].never, 20.0);
}

TEST_F(RezeroedDays, RefuseAnIntervalThatLeavesNothingToJudge) {
  try {
    RequireRezero(dataset, holdouts, RuleOfDays("5min"));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("leaves no row of a fold"));
  }
  EXPECT_NO_THROW(RequireRezero(dataset, holdouts, RuleOfDays("10min")));
}

TEST_F(RezeroedDays, PromiseWhatHoldsWithoutRezeroing) {
  std::vector<HeldOutErrors> promised;
  for (const bool rezero : {false, true}) {
    ComponentPlan plan = PlanModels(
        {.name = "days",
         .files = {{.file = "days.csv", .sha256 = ""}},
         .indifference = 0.0,
         .data =
             {.dataset = dataset, .dropped = {}, .remarks = {}, .faults = {}},
         .holdouts = MakeHoldouts(dataset, {"sessions:6"}),
         .study = {},
         .judgement = {}},
        {"poly:full:degree=1"},
        nullptr);
    if (rezero) plan.comparison.rezero = RuleOfDays("2h");
    RunComponent(&plan, {});
    const ComponentStudy& component = plan.comparison;
    EXPECT_EQ(component.rezero_worth.has_value(), rezero);
    promised.push_back(*component.study.models[0].final_fit->held_out);
  }
  EXPECT_EQ(promised[0].rmse, promised[1].rmse);
  EXPECT_EQ(promised[0].units[0].residuals, promised[1].units[0].residuals);
}

}  // namespace
}  // namespace errmap::models
