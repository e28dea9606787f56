// Hold-outs of sessions, what decides, and what counts as a unit.

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/study/judgement/judgement.h"
#include "models/study/study.h"
#include "models/study/study_defaults.h"
#include "tests/models/history/history_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;
using ::testing::ElementsAre;
using ::testing::Pair;

// `days` of 24 rows, each of four cycles, whose offset differs by the day.
data::Dataset DaysInSessionHoldouts(Index days, bool with_cycles) {
  constexpr Index kRows = 24;
  const Index rows = days * kRows;
  Eigen::MatrixXd values(rows, 1);
  std::vector<Index> codes;
  for (Index row = 0; row < rows; ++row) {
    values(row, 0) = 20.0 + std::sin(0.7 * static_cast<double>(row));
    codes.push_back(row / kRows);
  }
  const data::Dataset dataset = errmap::testing::WithLog(
      {errmap::testing::ColumnNamed("t1_degC")},
      values,
      Eigen::VectorXd::LinSpaced(
          rows, 0.0, 60.0 * static_cast<double>(rows - 1)),
      codes);
  data::Dataset::Parts parts;
  parts.source = "days";
  parts.inputs = dataset.inputs();
  parts.input_values = values;
  parts.target = dataset.target();
  parts.target_values = 3.0 * values.col(0);
  for (Index row = 0; row < rows; ++row) {
    parts.target_values[row] += 0.5 * static_cast<double>(row / kRows % 3);
    if (!with_cycles) continue;
    parts.groups.column = "cycle";
    parts.groups.codes.push_back(row / 6);
    if (row % 6 == 0) parts.groups.labels.push_back(std::to_string(row / 6));
  }
  parts.log = dataset.log();
  parts.log_rows = dataset.log_rows();
  return data::Dataset(std::move(parts));
}

// What the map is chosen by, and what it promises by.
std::pair<std::string, std::string> Decisive(
    const data::Dataset& dataset, const std::vector<std::string>& specs) {
  const auto holdouts = MakeHoldouts(dataset, specs);
  const StudyResult study = RunStudy(
      dataset, holdouts, MakeRecipes({"mean", "poly:temperature"}), {});
  const Judgement judgement = JudgeStudy(dataset, holdouts, study, {});
  const Recommendation& advice = *judgement.recommendation;
  return {holdouts[advice.decided_by].name, holdouts[advice.holdout].name};
}

TEST(DefaultHoldouts, HoldOutWhateverCanBeHeldOutWhole) {
  EXPECT_THAT(DefaultHoldouts(DaysInSessionHoldouts(3, true)),
              ElementsAre("every:3", "groups:5", "sessions:3"));
  EXPECT_THAT(DefaultHoldouts(DaysInSessionHoldouts(6, false)),
              ElementsAre("every:3", "sessions:5", "forward:3"));
  EXPECT_THAT(DefaultHoldouts(DaysInSessionHoldouts(2, false)),
              ElementsAre("every:3", "sessions:2", "blocks:5"));
  // Five runs of four cycles, or of eight, are days.
  for (const Index days : {5, 10}) {
    EXPECT_THAT(DefaultHoldouts(DaysInSessionHoldouts(days, true)),
                ElementsAre("every:3", "sessions:5", "forward:3"));
  }
}

TEST(StudyDefaults, GiveLengthsAnIndifference) {
  EXPECT_DOUBLE_EQ(DefaultIndifference(data::UnitOfSymbol("mm")), 0.02e-3);
  EXPECT_EQ(DefaultIndifference(data::UnitOfSymbol("arcsec")), 0.0);
}

TEST(SessionHoldouts, PromiseFromTwoSessionsOnAndDecideFromFour) {
  const std::vector<std::string> grouped = {
      "every:3", "groups:5", "sessions:2"};
  EXPECT_THAT(Decisive(DaysInSessionHoldouts(2, true), grouped),
              Pair("groups:5", "sessions:2"));
  EXPECT_THAT(Decisive(DaysInSessionHoldouts(3, true), grouped),
              Pair("groups:5", "sessions:2"));
  EXPECT_THAT(Decisive(DaysInSessionHoldouts(4, true), grouped),
              Pair("sessions:2", "sessions:2"));
  const std::vector<std::string> plain = {"every:3", "sessions:3", "blocks:5"};
  EXPECT_THAT(Decisive(DaysInSessionHoldouts(3, false), plain),
              Pair("blocks:5", "sessions:3"));
  EXPECT_THAT(Decisive(DaysInSessionHoldouts(4, false), plain),
              Pair("sessions:3", "sessions:3"));
  EXPECT_THAT(
      Decisive(DaysInSessionHoldouts(3, false), {"every:3", "sessions:3"}),
      Pair("sessions:3", "sessions:3"));
}

// What looks back over all sessions tells more than what looks forward only.
TEST(SessionHoldouts, LookForwardOverWholeSessionsBesideThem) {
  const data::Dataset dataset = DaysInSessionHoldouts(5, true);
  EXPECT_THAT(Decisive(dataset, {"forward:3", "sessions:5"}),
              Pair("sessions:5", "sessions:5"));
  const auto holdouts = MakeHoldouts(dataset, {"forward:3"});
  EXPECT_TRUE(holdouts[0].forward);
  EXPECT_TRUE(holdouts[0].whole_sessions);
  const std::vector<Index> days = dataset.session_codes();
  for (const stats::Fold& fold : holdouts[0].folds) {
    EXPECT_LT(days[static_cast<std::size_t>(fold.train.back())],
              days[static_cast<std::size_t>(fold.test.front())]);
  }
}

TEST(SessionHoldouts, CountSessionsInTheTests) {
  const data::Dataset dataset = DaysInSessionHoldouts(5, true);
  const auto holdouts = MakeHoldouts(dataset, {"groups:5", "sessions:5"});
  EXPECT_FALSE(holdouts[0].among_neighbours);
  EXPECT_TRUE(holdouts[1].whole_sessions);
  const StudyResult study = RunStudy(
      dataset, holdouts, MakeRecipes({"mean", "poly:temperature"}), {});
  const auto comparisons = CompareHoldouts(dataset, holdouts, study, 0.0, 1);
  EXPECT_EQ(comparisons[1].units.name, "day");
  EXPECT_TRUE(comparisons[1].units.are_sessions);
  EXPECT_THAT(comparisons[1].units.labels,
              ElementsAre("1", "2", "3", "4", "5"));
}

TEST(SessionHoldouts, TellWhetherFoldsKeepSessionsWhole) {
  const data::Dataset dataset = DaysInSessionHoldouts(4, true);
  const auto holdouts = MakeHoldouts(
      dataset, {"every:3", "groups:4", "groups:5", "blocks:4", "blocks:5"});
  EXPECT_FALSE(holdouts[0].whole_sessions);
  EXPECT_TRUE(holdouts[1].whole_sessions);  // four runs of four cycles: days
  EXPECT_FALSE(holdouts[2].whole_sessions);
  EXPECT_TRUE(holdouts[3].whole_sessions);
  EXPECT_FALSE(holdouts[4].whole_sessions);
  EXPECT_TRUE(IsOfSessions(holdouts[1], dataset));
  EXPECT_EQ(holdouts[1].inner, InnerHoldout::kWholeSessions);
  EXPECT_EQ(holdouts[2].inner, InnerHoldout::kWholeGroups);
  EXPECT_EQ(holdouts[3].inner, InnerHoldout::kWholeSessions);
  // One session is not two: nothing is held out whole.
  EXPECT_FALSE(MakeHoldouts(DaysInSessionHoldouts(1, true), {"groups:2"})[0]
                   .whole_sessions);
}

// Weeks that are held out whole are not days, though no day is parted.
TEST(SessionHoldouts, LeaveCoarserGroupsWhatTheyAre) {
  const data::Dataset days = DaysInSessionHoldouts(6, false);
  data::Dataset::Parts parts;
  parts.inputs = days.inputs();
  parts.input_values = days.input_values();
  parts.target = days.target();
  parts.target_values = days.target_values();
  parts.groups.column = "week";
  parts.groups.labels = {"1", "2", "3"};
  for (const Index day : days.session_codes()) {
    parts.groups.codes.push_back(day / 2);
  }
  parts.log = days.log();
  parts.log_rows = days.log_rows();
  const data::Dataset weeks(std::move(parts));
  const auto holdouts = MakeHoldouts(weeks, {"groups:3"});
  EXPECT_TRUE(holdouts[0].whole_sessions);
  EXPECT_FALSE(IsOfSessions(holdouts[0], weeks));
  EXPECT_EQ(holdouts[0].inner, InnerHoldout::kWholeGroups);
  EXPECT_THAT(DefaultHoldouts(weeks),
              ElementsAre("every:3", "groups:3", "sessions:5", "forward:3"));
}

TEST(SessionHoldouts, RefuseDataWithoutSessions) {
  data::Dataset::Parts parts;
  parts.inputs = {errmap::testing::ColumnNamed("t1_degC")};
  parts.input_values = Eigen::VectorXd::LinSpaced(9, 0.0, 1.0);
  parts.target = errmap::testing::ColumnNamed("error_um");
  parts.target_values = Eigen::VectorXd::LinSpaced(9, 0.0, 1.0);
  EXPECT_THROW(MakeHoldouts(data::Dataset(parts), {"sessions:2"}),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::models
