#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"
#include "data/csv.h"
#include "models/study/given_predictions.h"
#include "models/study/judgement/judgement.h"
#include "tests/models/model_test_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;
using errmap::testing::ShippedMeasurements;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kIndifferenceMm = 2e-5;

// Groups of rows whose target is slope * x plus noise; x grows by group.
data::Dataset GroupedLine(Eigen::Index groups,
                          Eigen::Index rows_of_group,
                          double slope) {
  data::Dataset::Parts parts;
  parts.source = "line";
  parts.inputs = {{"position_mm", data::UnitOfColumn("position_mm")},
                  {"t1_degC", data::UnitOfColumn("t1_degC")}};
  const Eigen::Index rows = groups * rows_of_group;
  parts.input_values.resize(rows, 2);
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  parts.target_values.resize(rows);
  parts.groups.column = "cycle";
  for (Eigen::Index g = 0; g < groups; ++g) {
    parts.groups.labels.push_back(std::to_string(g + 1));
  }
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double k = static_cast<double>(i);
    const double t = 20.0 + std::sin(2.3 * k);
    parts.input_values.row(i) << static_cast<double>(i % rows_of_group), t;
    parts.groups.codes.push_back(i / rows_of_group);
    parts.target_values[i] =
        slope * (t - 20.0) + 1e-3 * std::sin(12.9898 * k * k);
  }
  return data::Dataset(std::move(parts));
}

Judgement JudgeSpecs(const data::Dataset& dataset,
                     const std::vector<std::string>& holdout_specs,
                     const std::vector<std::string>& model_specs,
                     StudyResult* study) {
  const auto holdouts = MakeHoldouts(dataset, holdout_specs);
  *study = RunStudy(dataset, holdouts, MakeRecipes(model_specs), {});
  return JudgeStudy(
      dataset, holdouts, *study, {.indifference = kIndifferenceMm});
}

TEST(Verdict, FollowsTheUnseenCyclesOfTheShippedMeasurements) {
  const data::Dataset dataset = ShippedMeasurements();
  StudyResult study;
  const Judgement judgement = JudgeSpecs(dataset,
                                         {"every:3", "groups:5"},
                                         {"zero",
                                          "mean",
                                          "poly:position",
                                          "poly:temperature",
                                          "poly:eq8",
                                          "poly:full:degree=3",
                                          "poly:full:degree=6:clip=none",
                                          "poly:stepwise",
                                          "net:scg"},
                                         &study);
  const Verdict& neighbours = *judgement.verdicts[0];
  EXPECT_EQ(neighbours.choice, Choice::kNeural);
  EXPECT_EQ(study.models[neighbours.best].name, "net:scg");
  const Verdict& unseen = *judgement.verdicts[1];
  EXPECT_EQ(unseen.choice, Choice::kPolynomial);
  EXPECT_EQ(study.models[unseen.best].name, "poly:full:degree=3");
  // Small if cycles were independent, but the losses of neighbouring ones
  // resemble each other.
  const auto& tests = judgement.comparisons[1];
  const auto& pair = tests.tests.Pair(*tests.PlaceOf(unseen.best),
                                      *tests.PlaceOf(*unseen.rival));
  EXPECT_LE(pair.sign_flip.test.p, stats::kSignificance);
  EXPECT_GT(pair.p_holm, stats::kSignificance);
  EXPECT_TRUE(pair.correlated);
  EXPECT_EQ(unseen.confidence, Confidence::kUnitsCorrelated);
  EXPECT_FALSE(unseen.established());
  ASSERT_TRUE(judgement.gap);
  for (const InterpolationGap::Row& row : judgement.gap->models) {
    if (row.model != "poly:full:degree=6:clip=none") continue;
    EXPECT_NEAR(1e3 * row.neighbours_rmse, 0.487, 5e-4);
    EXPECT_NEAR(1e3 * row.unseen_rmse, 10.254, 5e-4);
    EXPECT_TRUE(row.flatters);
  }
  ASSERT_TRUE(judgement.recommendation);
  const Recommendation& advice = *judgement.recommendation;
  EXPECT_EQ(advice.holdout, 1u);
  EXPECT_EQ(advice.choice, Choice::kPolynomial);
  // The same cubic with 8 of its 10 terms: the simplest of the first tier.
  EXPECT_EQ(study.models[advice.model].name, "poly:stepwise");
  EXPECT_EQ(study.models[advice.best_baseline].name, "poly:position");
  EXPECT_GT(advice.extrapolated_share, 0.3);
}

TEST(Verdict, SaysThatNothingBetterThanABaselineIsKnown) {
  StudyResult study;
  const Judgement judgement = JudgeSpecs(GroupedLine(12, 6, 0.0),
                                         {"groups:4"},
                                         {"zero", "mean", "poly:full:degree=2"},
                                         &study);
  EXPECT_EQ(judgement.verdicts[0]->choice, Choice::kBaseline);
  EXPECT_EQ(judgement.recommendation->choice, Choice::kBaseline);
  EXPECT_TRUE(study.models[judgement.recommendation->model].baseline);
}

// Predictions that are 1 % worse than the mean, by cycles of either kind: the
// mean has the lowest error, but a map that is better by far is as likely.
TEST(Verdict, AsksForABoundBeforeItCallsABaselineEstablished) {
  const data::Dataset dataset = GroupedLine(24, 6, 0.0);
  const auto holdouts = MakeHoldouts(dataset, {"groups:4"});
  StudyResult study =
      RunStudy(dataset, holdouts, MakeRecipes({"zero", "mean"}), {});
  GivenPredictions uneven{"uneven", "uneven.csv", {}, {}};
  GivenPredictions worse{"worse", "worse.csv", {}, {}};
  for (Eigen::Index i = 0; i < dataset.num_rows(); ++i) {
    const double share = i / 6 % 2 == 0 ? 0.3 : 1.4;
    uneven.by_row[i] = (1.0 - share) * dataset.target_values()[i];
    worse.by_row[i] = -0.5 * dataset.target_values()[i];
  }
  const auto judge = [&](const GivenPredictions& given) {
    StudyResult with = study;
    with.models.push_back(JudgeGivenPredictions(given, dataset, holdouts));
    return JudgeStudy(
        dataset, holdouts, with, {.indifference = kIndifferenceMm});
  };
  const Judgement unsure = judge(uneven);
  EXPECT_EQ(unsure.verdicts[0]->choice, Choice::kBaseline);
  EXPECT_EQ(unsure.verdicts[0]->confidence, Confidence::kNotShown);
  EXPECT_EQ(unsure.recommendation->against_baseline, Confidence::kNotShown);
  const Judgement sure = judge(worse);
  EXPECT_EQ(sure.verdicts[0]->choice, Choice::kBaseline);
  EXPECT_TRUE(sure.verdicts[0]->established());
}

TEST(Verdict, SaysWhetherTheMapSurelyBeatsTheBestBaseline) {
  StudyResult study;
  const Judgement clear = JudgeSpecs(GroupedLine(24, 6, 0.01),
                                     {"groups:4"},
                                     {"mean", "poly:full:degree=1"},
                                     &study);
  EXPECT_EQ(study.models[clear.recommendation->model].name,
            "poly:full:degree=1");
  EXPECT_EQ(clear.recommendation->against_baseline, Confidence::kEstablished);
  const Judgement few = JudgeSpecs(GroupedLine(8, 6, 0.01),
                                   {"groups:4"},
                                   {"mean", "poly:full:degree=1"},
                                   &study);
  EXPECT_EQ(few.recommendation->against_baseline, Confidence::kOutOfReach);
}

TEST(Verdict, TakesFewerGroupsWhereEachIsASessionOfItsOwn) {
  const auto confidence = [](const std::string& column, Eigen::Index sessions) {
    const data::Dataset line = GroupedLine(8, 6, 0.01);
    data::Dataset::Parts parts{.source = line.source(),
                               .inputs = line.inputs(),
                               .input_values = line.input_values(),
                               .target = line.target(),
                               .target_values = line.target_values(),
                               .groups = line.groups(),
                               .weights = {},
                               .rows = {}};
    data::SessionLog log;
    log.sessions.column = column;
    for (Eigen::Index i = 0; i < line.num_rows(); ++i) {
      const Eigen::Index session = i * sessions / line.num_rows();
      if (log.sessions.codes.empty() || log.sessions.codes.back() != session) {
        log.sessions.labels.push_back(std::to_string(session));
        log.first_rows.push_back(i);
      }
      log.sessions.codes.push_back(session);
      parts.log_rows.push_back(i);
    }
    log.time = Eigen::VectorXd::LinSpaced(line.num_rows(), 0.0, 47.0);
    log.time_unit = "s";
    log.input_values = line.input_values();
    parts.log = std::make_shared<const data::SessionLog>(std::move(log));
    StudyResult study;
    const Judgement judgement = JudgeSpecs(data::Dataset(std::move(parts)),
                                           {"groups:4"},
                                           {"mean", "poly:full:degree=1"},
                                           &study);
    return judgement.verdicts[0]->confidence;
  };
  EXPECT_EQ(confidence("day", 8), Confidence::kEstablished);
  EXPECT_EQ(confidence("day", 4), Confidence::kOutOfReach);
  EXPECT_EQ(confidence("day", 16), Confidence::kOutOfReach);
  EXPECT_EQ(confidence("", 8), Confidence::kOutOfReach);  // cut by time
}

TEST(Verdict, HoldsTheGoalAgainstEveryModelOfACompleteStudy) {
  const data::Dataset dataset = GroupedLine(12, 6, 0.01);
  const auto holdouts = MakeHoldouts(dataset, {"every:3", "groups:4"});
  StudyResult study = RunStudy(
      dataset, holdouts, MakeRecipes({"mean", "poly:full:degree=1"}), {});
  const auto standing = [&](std::size_t model, std::size_t h) {
    return JudgeStudy(dataset, holdouts, study, {.goal = 2e-3})
        .goals[model][h]
        .standing;
  };
  EXPECT_EQ(standing(0, 1), GoalStanding::kMissed);
  EXPECT_EQ(standing(1, 0), GoalStanding::kMet);
  EXPECT_EQ(standing(1, 1), GoalStanding::kMet);
  // A model that failed has no error, not one of 0.
  study.models[1].holdouts[1].why_failed = "fold 2: too few rows";
  study.models[1].holdouts[1].test = {};
  EXPECT_EQ(standing(1, 1), GoalStanding::kNotJudged);
  study.interrupted = true;
  EXPECT_EQ(standing(1, 0), GoalStanding::kNotJudged);
}

TEST(Verdict, CallsNoGoalMetByRezeroingWhereMapsAreRezeroed) {
  const data::Dataset dataset = GroupedLine(12, 6, 0.01);
  const auto holdouts = MakeHoldouts(dataset, {"groups:4"});
  StudyResult study = RunStudy(dataset, holdouts, MakeRecipes({"mean"}), {});
  study.models[0].holdouts[0].test.sd = 1e-3;
  const auto standing = [&](bool rezeroed) {
    return JudgeStudy(
               dataset, holdouts, study, {.goal = 2e-3, .rezeroed = rezeroed})
        .goals[0][0]
        .standing;
  };
  EXPECT_EQ(standing(false), GoalStanding::kMetAfterRezeroing);
  EXPECT_EQ(standing(true), GoalStanding::kMissed);
}

TEST(Verdict, CallsAModelAgainstItsTwinNoBetter) {
  StudyResult study;
  const data::Dataset dataset = GroupedLine(12, 6, 0.01);
  const Judgement judgement = JudgeSpecs(
      dataset,
      {"groups:4"},
      {"mean", "poly:full:degree=1", "poly:formula=position_mm+t1_degC"},
      &study);
  const auto& tiers = judgement.comparisons[0].tests.tiers;
  EXPECT_EQ(tiers[0].size(), 2u);
  EXPECT_EQ(judgement.comparisons[0].ThatItIsBetter(1, 2),
            Confidence::kNotShown);
  EXPECT_EQ(judgement.recommendation->choice, Choice::kPolynomial);
  EXPECT_TRUE(judgement.verdicts[0]->established());  // against the mean
}

TEST(Verdict, EstablishesNothingWithFewGroupsOfPerhapsOneSession) {
  for (const Eigen::Index groups : {2, 3, 5, 11}) {
    StudyResult study;
    const Judgement judgement = JudgeSpecs(GroupedLine(groups, 20, 0.05),
                                           {"leave-one-group-out"},
                                           {"mean", "poly:full:degree=1"},
                                           &study);
    EXPECT_FALSE(judgement.verdicts[0]->established()) << groups;
    EXPECT_THAT(judgement.comparisons[0].differ, Each(Confidence::kOutOfReach));
    EXPECT_TRUE(judgement.comparisons[0].obstacle.exists());
    ASSERT_TRUE(judgement.recommendation);
  }
}

// Six runs of an hour: by the clock, which starts anew, or with the date.
TEST(Verdict, TakesRunsOnDaysOfTheirOwnForSeparateSessions) {
  using Kind = Obstacle::Kind;
  const auto obstacle = [](bool dated) {
    std::string text = "time,t1_degC,error_mm\n";
    for (int run = 0; run < 6; ++run) {
      for (int minute = 0; minute < 10; ++minute) {
        text += fmt::format("{}07:{:02},{},{}\n",
                            dated ? fmt::format("{:02}.03.2024 ", 4 + run) : "",
                            minute,
                            20 + minute * (run % 3),
                            0.001 * minute + 1e-4 * ((7 * run + minute) % 5));
      }
    }
    StudyResult study;
    return JudgeSpecs(
               data::MakeDataset(data::ParseCsv(text, "log.csv"), {}).dataset,
               {"sessions:3"},
               {"mean", "poly:full:degree=1"},
               &study)
        .comparisons[0]
        .obstacle.kind;
  };
  EXPECT_NE(obstacle(true), Kind::kPerhapsOneSession);
  EXPECT_EQ(obstacle(false), Kind::kPerhapsOneSession);
}

TEST(Verdict, CountsBlocksOfRowsWhereThereAreNoGroups) {
  const data::Dataset dataset = errmap::testing::QuadraticData(120);
  StudyResult study;
  const Judgement judgement =
      JudgeSpecs(dataset, {"every:3"}, {"mean", "poly:eq8"}, &study);
  const HoldoutComparison& comparison = judgement.comparisons[0];
  EXPECT_EQ(comparison.units.name, "block of rows");
  EXPECT_EQ(comparison.tests.num_units, 8);  // 40 held-out rows, 5 in a block
  EXPECT_EQ(comparison.units.labels.front(), "rows 2-14");
  EXPECT_FALSE(judgement.gap);
}

TEST(Verdict, RecommendsNothingOnFiveRows) {
  StudyResult study;
  const Judgement judgement = JudgeSpecs(errmap::testing::QuadraticData(5),
                                         {"every:3"},
                                         {"zero", "mean", "poly:position"},
                                         &study);
  EXPECT_FALSE(judgement.recommendation);
  EXPECT_FALSE(judgement.verdicts[0]->established());
}

TEST(Verdict, PrefersTheSimplestNearTheBestWhereNothingBoundsADifference) {
  // 6 held-out rows of one cycle are one block; a thousandth of the error
  // parts the two.
  data::Dataset::Parts parts;
  parts.source = "one cycle";
  parts.inputs = {{"position_mm", data::UnitOfColumn("position_mm")},
                  {"t1_degC", data::UnitOfColumn("t1_degC")}};
  parts.input_values.resize(20, 2);
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  parts.target_values.resize(20);
  parts.groups = {"cycle", {"1"}, std::vector<Eigen::Index>(20, 0)};
  for (Eigen::Index i = 0; i < 20; ++i) {
    const double k = static_cast<double>(i);
    parts.input_values.row(i) << k, 20.0 + 0.1 * k + 1e-3 * std::sin(k * k);
    parts.target_values[i] = 1e-3 * k;
  }
  const data::Dataset dataset(std::move(parts));
  StudyResult study;
  const Judgement judgement = JudgeSpecs(
      dataset, {"every:3"}, {"poly:full:degree=1", "poly:position"}, &study);
  EXPECT_EQ(judgement.comparisons[0].units.name, kBlockOfRows);
  EXPECT_EQ(judgement.comparisons[0].tests.num_units, 1);
  EXPECT_EQ(judgement.recommendation->first_tier.size(), 2u);
  EXPECT_EQ(study.models[judgement.recommendation->model].name,
            "poly:position");
}

TEST(Verdict, LeavesOutAModelThatFailedInOneFold) {
  // Two groups of two rows are too few for six coefficients.
  StudyResult study;
  const Judgement judgement = JudgeSpecs(GroupedLine(3, 2, 0.01),
                                         {"leave-one-group-out"},
                                         {"mean", "poly:full:degree=2"},
                                         &study);
  EXPECT_FALSE(study.models[1].holdouts[0].ok());
  EXPECT_THAT(judgement.comparisons[0].models, ElementsAre(0u));
  EXPECT_EQ(judgement.comparisons[0].TierOf(1), 0);
  EXPECT_EQ(judgement.recommendation->model, 0u);
}

TEST(Verdict, HasNoneWhereEveryFitFailed) {
  StudyResult study;
  const Judgement judgement = JudgeSpecs(GroupedLine(3, 2, 0.01),
                                         {"leave-one-group-out"},
                                         {"poly:full:degree=4"},
                                         &study);
  EXPECT_FALSE(judgement.verdicts[0]);
  EXPECT_FALSE(judgement.recommendation);
}

TEST(Verdict, CountsTheCutsThatEachModelWins) {
  StudyResult study;
  const Judgement judgement =
      JudgeSpecs(ShippedMeasurements(),
                 {"groups:5:repeats=6"},
                 {"mean", "poly:full:degree=2", "poly:full:degree=3"},
                 &study);
  const auto& wins = judgement.comparisons[0].wins;
  ASSERT_FALSE(wins.empty());
  double sum = 0.0;
  for (const WinShare& win : wins) sum += win.share;
  EXPECT_DOUBLE_EQ(sum, 1.0);
  EXPECT_EQ(wins.front().model, "poly:full:degree=3");
  // Each cycle is one unit however often it was held out.
  EXPECT_EQ(judgement.comparisons[0].tests.num_units, 35);
}

TEST(Verdict, NeverRecommendsPredictionsWithoutAMap) {
  const data::Dataset dataset = GroupedLine(12, 6, 0.01);
  const auto holdouts = MakeHoldouts(dataset, {"groups:4"});
  StudyResult study = RunStudy(
      dataset, holdouts, MakeRecipes({"mean", "poly:full:degree=1"}), {});
  GivenPredictions perfect{"oracle", "oracle.csv", {}, {}};
  for (Eigen::Index i = 0; i < dataset.num_rows(); ++i) {
    perfect.by_row[i] = dataset.target_values()[i];
  }
  study.models.push_back(JudgeGivenPredictions(perfect, dataset, holdouts));
  const Judgement judgement =
      JudgeStudy(dataset, holdouts, study, {.indifference = kIndifferenceMm});
  EXPECT_EQ(study.models[judgement.verdicts[0]->best].name, "oracle");
  EXPECT_EQ(judgement.verdicts[0]->choice, Choice::kGiven);
  EXPECT_EQ(study.models[judgement.recommendation->model].name,
            "poly:full:degree=1");
  EXPECT_EQ(judgement.recommendation->better_but_no_map, 2u);
}

// A wave in one run, which no straight line follows into the next block.
TEST(Verdict, RecommendsNoBlendThatABaselineBeats) {
  data::Dataset::Parts parts;
  parts.source = "wave";
  parts.inputs = {{"t1_degC", data::UnitOfColumn("t1_degC")}};
  parts.input_values.resize(60, 1);
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  parts.target_values.resize(60);
  for (Eigen::Index i = 0; i < 60; ++i) {
    const double k = static_cast<double>(i);
    parts.input_values(i, 0) = 20.0 + k;
    parts.target_values[i] = std::sin(0.16 * k);
  }
  StudyResult study;
  const Judgement judgement =
      JudgeSpecs(data::Dataset(std::move(parts)),
                 {"blocks:5"},
                 {"mean", "blend:view=raw:terms=linear"},
                 &study);
  const auto& comparison = judgement.comparisons[0];
  ASSERT_GT(comparison.tests.rmse[1], comparison.tests.rmse[0]);
  EXPECT_EQ(study.models[judgement.recommendation->model].name, "mean");
}

// What the temperature tells here is less than what does not matter.
std::string PreferredAsSmall(Eigen::Index groups) {
  const data::Dataset dataset = GroupedLine(groups, 12, 5e-4);
  const auto holdouts = MakeHoldouts(dataset, {"groups:4"});
  const StudyResult study =
      RunStudy(dataset,
               holdouts,
               MakeRecipes({"poly:full:degree=1", "poly:position"}),
               {});
  const Judgement judgement = JudgeStudy(dataset,
                                         holdouts,
                                         study,
                                         {.indifference = 5e-4,
                                          .choose = Choose::kBest,
                                          .prefer = Prefer::kSmall});
  return study.models[judgement.recommendation->model].name;
}

// Four units bound a difference, but establish nothing.
TEST(Verdict, PrefersASmallerMapWhereItsLossIsProvenToBeSmall) {
  EXPECT_EQ(PreferredAsSmall(24), "poly:position");
  EXPECT_EQ(PreferredAsSmall(4), "poly:full:degree=1");
}

}  // namespace
}  // namespace errmap::models
