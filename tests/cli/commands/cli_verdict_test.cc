// The verdict of `errmap compare`, and models made elsewhere.

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

TEST_F(Cli, RecommendsWhatHoldsOnUnseenCyclesAndSaysWhy) {
  const Json component = Compare({"--quiet"});
  const Json& verdicts = component["verdict"];
  EXPECT_EQ(verdicts[0]["choice"], "neural");
  EXPECT_EQ(verdicts[1]["choice"], "blend");
  EXPECT_EQ(verdicts[1]["model"], "blend");
  // Neighbouring cycles resemble each other too much for more.
  EXPECT_EQ(verdicts[1]["established"], false);
  EXPECT_EQ(verdicts[0]["established"], false);
  EXPECT_THAT(verdicts[0]["why"].get<std::string>(),
              HasSubstr(" Not established"));
  const Json& advice = component["recommendation"];
  EXPECT_EQ(advice["holdout"], "groups:5");
  EXPECT_EQ(advice["choice"], "blend");
  EXPECT_EQ(advice["model"], "blend");
  EXPECT_NEAR(advice["rmse"].get<double>() * kUmPerMm, 0.704, 5e-4);
  EXPECT_LT(advice["ci95"][0], advice["rmse"]);
  EXPECT_GT(advice["ci95"][1], advice["rmse"]);
  EXPECT_EQ(advice["meets_goal"], nullptr);
  EXPECT_EQ(advice["goal_standing"], "no goal");
  EXPECT_EQ(advice["against_baseline"], "units correlated");
  EXPECT_FALSE(advice["reasons"].empty());
  EXPECT_FALSE(advice["caveats"].empty());
  for (const Json& row : component["gap"]["models"]) {
    if (row["model"] != "poly:full:degree=6") continue;
    EXPECT_EQ(row["flatters"], true);
    // 21.1 without guards (clip=none).
    EXPECT_NEAR(row["ratio"].get<double>(), 11.5, 0.1);
  }
  // Every pair of models under every hold-out, by cycles.
  const std::size_t models = component["models"].size();
  EXPECT_EQ(component["comparisons"].size(), models * (models - 1));
  for (const Json& pair : component["comparisons"]) {
    EXPECT_EQ(pair["unit_of_analysis"], "cycle");
    EXPECT_EQ(pair["units"], 35);
    // The blend against a baseline: in the direction that was fixed before.
    EXPECT_GE(2.0 * pair["p_holm"].get<double>(), pair["p"].get<double>());
    // One definition: what neighbours that resemble each other show is never
    // called established, here or in any sentence.
    EXPECT_EQ(pair["established"], pair["confidence"] == "established");
    if (pair["correlated"] == true || pair["holdout"] == "groups:5") {
      EXPECT_EQ(pair["established"], false) << pair;
    }
  }
  EXPECT_THAT(advice["reasons"].dump(),
              HasSubstr("Best single map: poly:ridge:view=auto (0.9"));
  std::set<std::string> tiered;
  for (const Json& tier : component["tiers"]["groups:5"]) {
    for (const Json& name : tier) tiered.insert(name);
  }
  EXPECT_EQ(tiered.size(), models);
}

TEST_F(Cli, AlwaysShowsTheBaselines) {
  const Json component = Compare({"--models", "poly:eq8", "--quiet"});
  ASSERT_EQ(component["models"].size(), 5u);
  EXPECT_EQ(component["models"][0]["baseline"], false);
  for (const std::size_t i : {1u, 2u, 3u, 4u}) {
    EXPECT_EQ(component["models"][i]["baseline"], true);
  }
}

TEST_F(Cli, FailsWhereOnlyTheBaselinesThatNobodyAskedForSucceed) {
  WriteWithoutPosition("t.csv", 12);
  const Outcome outcome =
      Run({"compare", "t.csv", "--models", "poly:full:degree=4", "--quiet"});
  EXPECT_EQ(outcome.status, kEveryFitFailed);
}

TEST_F(Cli, JudgesByTheSplitThatItSaved) {
  const std::vector<std::string> models{"--models", "mean,poly:eq8", "--quiet"};
  std::vector<std::string> save = models;
  save.insert(save.end(), {"--save-split", "split.csv"});
  std::vector<std::string> use = models;
  use.insert(use.end(), {"--split", "split.csv"});
  const Json saved = Compare(save);
  const Json used = Compare(use);
  for (const char* holdout : {"every:3", "groups:5"}) {
    EXPECT_EQ(Model(saved, "poly:eq8")["results"][holdout]["test"],
              Model(used, "poly:eq8")["results"][holdout]["test"]);
  }
  EXPECT_EQ(saved["recommendation"]["model"], used["recommendation"]["model"]);
}

TEST_F(Cli, TakesPredictionsFromElsewhereIntoTheTable) {
  // Our own cubic's held-out predictions, as if another program had made them.
  ASSERT_EQ(Run({"compare",
                 kDown,
                 "--models",
                 "poly:full:degree=3",
                 "--quiet",
                 "--out",
                 "study"})
                .status,
            0);
  std::string text = "row,holdout,fold,predicted\n";
  for (const auto& record : Records(Read("study/residuals.csv"))) {
    text += record.at("row") + "," + record.at("holdout") + "," +
            record.at("fold") + "," + record.at("poly:full:degree=3") + "\n";
  }
  Write("matlab.csv", text);
  const Json component = Compare({"--models",
                                  "poly:full:degree=3",
                                  "--quiet",
                                  "--predictions",
                                  "matlab=matlab.csv"});
  const Json ours = Model(component, "poly:full:degree=3");
  const Json theirs = Model(component, "matlab");
  EXPECT_EQ(theirs["kind"], "file");
  EXPECT_EQ(theirs["status"], "ok");
  EXPECT_EQ(theirs["results"]["groups:5"]["test"],
            ours["results"]["groups:5"]["test"]);
  EXPECT_EQ(theirs["parameters"], nullptr);
  // Predictions alone are not a map to compensate with.
  EXPECT_EQ(component["recommendation"]["model"], "poly:full:degree=3");
}

TEST_F(Cli, JudgesLastYearsMapOnTodaysRows) {
  Fit("poly:eq8", "map.json");
  const Json component = Compare({"--models", "mean,file:map.json", "--quiet"});
  const Json map = Model(component, "file:map.json");
  EXPECT_EQ(map["kind"], "file");
  EXPECT_EQ(map["choice"], "polynomial");
  EXPECT_EQ(map["parameters"], 5);
  EXPECT_EQ(map["status"], "ok");
}

TEST_F(Cli, RefusesWrongJudgingOptionsInOneLine) {
  const auto expect =
      [&](const std::vector<std::string>& more, int status, const char* what) {
        std::vector<std::string> words{
            "compare", kDown, "--models", "mean", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = Run(words);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(what));
        EXPECT_EQ(SplitLines(outcome.err).size(), 1u) << outcome.err;
      };
  expect({"--predictions", "matlab"}, kWrongCommandLine, "NAME=FILE");
  expect({"--predictions", "mean=p.csv"},
         kWrongCommandLine,
         "two models are named mean");
  expect({"--predictions", "m=none.csv"}, kUnusable, "none.csv");
  expect({"--split", "none.csv"}, kUnusable, "none.csv");
  expect({"--indifference", "-1"}, kWrongCommandLine, "--indifference");
  expect({"--model", "file:none.json"}, kUnusable, "none.json");
  Write("split.csv", "row,holdout,fold,role\n999,a,0,train\n");
  expect({"--split", "split.csv"}, kUnusable, "no data row 999");
}

TEST_F(Cli, SaysWhereHoldOutsOfUnseenCyclesDisagree) {
  const Json component = Compare({"--models",
                                  "poly:full:degree=3",
                                  "--holdout",
                                  "groups:5",
                                  "--holdout",
                                  "forward:5",
                                  "--quiet"});
  EXPECT_EQ(component["recommendation"]["model"], "poly:full:degree=3");
  EXPECT_THAT(component["recommendation"]["caveats"].dump(),
              HasSubstr("Disagreement: poly:position has a lower error under "
                        "forward:5: "));
}

// A map of yesterday's zero: 0.2 um of scatter about 5 um is not met by 0.5 um.
TEST_F(Cli, MeetsAGoalByItsRmseAndSaysWhereAnOffsetHidesIt) {
  const auto write = [&](const std::string& name, double offset) {
    std::string text = "cycle,position_mm,t1_degC,error_mm\n";
    for (int i = 0; i < 240; ++i) {
      const int cycle = i / 10;
      const double warm = 5.0 * std::sin(cycle);
      text += std::to_string(cycle) + "," + std::to_string(i % 10) + "," +
              std::to_string(20.0 + warm) + "," +
              std::to_string(offset + 0.002 * (i % 10) * warm +
                             3e-4 * std::sin(12.9898 * i * i)) +
              "\n";
    }
    Write(name, text);
  };
  write("yesterday.csv", 0.0);
  write("today.csv", 0.005);
  ASSERT_EQ(Run({"fit",
                 "yesterday.csv",
                 "--model",
                 "poly:full:degree=2",
                 "-o",
                 "map.json",
                 "--quiet"})
                .status,
            0);
  const auto compare = [&](const std::string& file,
                           const std::string& goal,
                           const std::string& format) {
    return std::vector<std::string>{"compare",
                                    file,
                                    "--models",
                                    "zero,file:map.json",
                                    "--holdout",
                                    "groups:5",
                                    "--goal",
                                    goal,
                                    "--format",
                                    format,
                                    "--quiet"};
  };
  const auto result = [&](const Json& component) {
    return Model(component, "file:map.json")["results"]["groups:5"];
  };
  const Json offset =
      RunJson(compare("today.csv", "0.0005", "json"))["components"][0];
  EXPECT_EQ(result(offset)["meets_goal"], false);
  EXPECT_EQ(result(offset)["goal_standing"], "met after re-zeroing");
  const Json met =
      RunJson(compare("yesterday.csv", "0.0005", "json"))["components"][0];
  EXPECT_EQ(result(met)["meets_goal"], true);
  EXPECT_EQ(result(met)["goal_standing"], "met");
  const Json missed =
      RunJson(compare("today.csv", "0.0001", "json"))["components"][0];
  EXPECT_EQ(result(missed)["goal_standing"], "not met");
  std::string screen = Run(compare("today.csv", "0.0005", "table")).out;
  std::ranges::replace(screen, '\n', ' ');
  EXPECT_THAT(screen, ContainsRegex("file:map.json .* re-zeroed "));
  EXPECT_THAT(screen,
              ContainsRegex("goal +0.5 um: reached after re-zeroing; the "
                            "scatter is 0.2[0-9]+ um"));
}

TEST_F(Cli, EstablishesNothingFromFiveCycles) {
  std::string text = "cycle,position_mm,error_mm\n";
  for (int i = 0; i < 50; ++i) {
    const int position = i % 10;
    text += std::to_string(i / 10 + 1) + "," + std::to_string(position) + "," +
            std::to_string(0.01 * position + 1e-4 * ((i * 7) % 5)) + "\n";
  }
  Write("five.csv", text);
  const Json component = RunJson(
      {"compare", "five.csv", "--format", "json", "--quiet"})["components"][0];
  for (const Json& verdict : component["verdict"]) {
    EXPECT_EQ(verdict["established"], false);
  }
  EXPECT_THAT(component["recommendation"]["caveats"].dump(),
              HasSubstr("cannot prove which map is best"));
}

}  // namespace
}  // namespace errmap
