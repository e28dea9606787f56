// Study files: overridden, planned and refused, with the place of what is
// wrong.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/commands/studies/study_of_both_ways.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class StudyOverrides : public StudyOfBothWays {};

TEST_F(StudyOverrides, SetReplacesAnyKey) {
  WriteStudy();
  const Json document = RunStudy({"--set",
                                  "seed=7",
                                  "--set",
                                  "component.\"x, up\".goal=0.25",
                                  "--set",
                                  "component.0.name=x displacement",
                                  "--set",
                                  "model.0.degree=3",
                                  "--set",
                                  "component.1.where.cycle=2",
                                  "--set",
                                  "holdouts=[\"kfold:2\"]"});
  EXPECT_EQ(document["seed"], 7);
  EXPECT_EQ(document["components"][0]["name"], "x displacement");
  EXPECT_EQ(document["components"][1]["goal"], 0.25);
  EXPECT_EQ(document["components"][1]["data"]["rows"], 6);
  EXPECT_EQ(document["components"][0]["models"][1]["name"],
            "poly:full:degree=3");
  EXPECT_EQ(document["components"][0]["holdouts"][0]["name"], "kfold:2");
}

TEST_F(StudyOverrides, SetSaysWhatItCannotDo) {
  WriteStudy();
  const auto refusal = [&](const std::string& change) {
    return RefusalOf(
        Run({"compare", "--config", "study.toml", "--set", change}),
        kWrongCommandLine);
  };
  EXPECT_THAT(refusal("seed=many"),
              HasSubstr("--set seed=many: 'seed' in the study must be a whole "
                        "number from 0, found text ('many')"));
  EXPECT_THAT(
      refusal("sed=1"),
      HasSubstr("unknown key 'sed' in the study; did you mean 'seed'?"));
  EXPECT_THAT(refusal("component.5.goal=1"),
              HasSubstr("no component '5'; the study file has 0 to 1"));
  EXPECT_THAT(refusal("seed"), HasSubstr("--set must be KEY=VALUE"));
  EXPECT_THAT(refusal("a b=1"), HasSubstr("--set 'a b=1'"));
  EXPECT_THAT(
      RefusalOf(Run({"compare", kDown, "--set", "seed=1"}), kWrongCommandLine),
      HasSubstr("--config"));
}

TEST_F(StudyOverrides, FlagsOverrideTheFileAndThoseThatCannotAreRefused) {
  WriteStudy();
  const Json document = RunStudy({"--seed",
                                  "9",
                                  "--goal",
                                  "0.5",
                                  "--holdout",
                                  "every:4",
                                  "--models",
                                  "zero"});
  EXPECT_EQ(document["seed"], 9);
  EXPECT_EQ(document["components"][0]["goal"], 0.5);
  EXPECT_EQ(document["components"][0]["holdouts"][0]["name"], "every:4");
  EXPECT_EQ(document["components"][1]["models"].size(), 3U);
  EXPECT_THAT(RefusalOf(Run({"compare", kDown, "--config", "study.toml"}),
                        kWrongCommandLine),
              HasSubstr("DATA and --config exclude each other"));
  EXPECT_THAT(
      RefusalOf(
          Run({"compare", "--config", "study.toml", "--target", "position_mm"}),
          kWrongCommandLine),
      HasSubstr("--target is for one component, and study.toml has 2"));
}

TEST_F(StudyOverrides, GoalsHaveUnitsOfTheirOwn) {
  WriteStudy();
  const Json document = RunStudy({"--set",
                                  "goal=2um",
                                  "--set",
                                  "component.0.goal=1500 nm",
                                  "--set",
                                  "indifference = \"1e-4 mm\""});
  EXPECT_EQ(document["components"][0]["goal"], 0.0015);
  EXPECT_EQ(document["components"][1]["goal"], 0.002);
  EXPECT_EQ(document["components"][1]["indifference"], 1e-4);
  // What was carried out is in the targets' units.
  const Json configuration = document["provenance"]["configuration"];
  EXPECT_FALSE(configuration.contains("goal"));
  EXPECT_EQ(configuration["component"][1]["goal"], 0.002);
  EXPECT_THAT(
      Run({"compare", "--config", "study.toml", "--set", "goal=1deg"}).err,
      HasSubstr("both.csv: goal is 1 deg, but the target is in mm"));
}

TEST_F(StudyOverrides, UnknownKeysAreNamedWithLineColumnAndWhatIsAllowed) {
  EXPECT_THAT(Refusal("seed = 1\n[[component]]\n  targt = \"e\"\n"),
              AllOf(HasSubstr("study.toml:3:3: unknown key 'targt' in "
                              "[[component]]; did you mean 'target'?"),
                    HasSubstr("allowed are name, data, where, target")));
  EXPECT_THAT(Refusal("sead = 1\n"),
              HasSubstr("study.toml:1:1: unknown key 'sead' in the study"));
}

TEST_F(StudyOverrides, WrongTypesAndValuesAreNamedWithLineAndColumn) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"seed = \"one\"", ":1:8: 'seed' in the study must be a whole number"},
      {"seed = -1", ":1:8: 'seed' in the study must be a whole number from 0"},
      {"seed = 1.5", "found a number (1.5)"},
      {"goal = true",
       ":1:8: 'goal' in the study must be a number or a text such as "
       "\"2um\", found true"},
      {"goal = 0", ":1:8: 'goal' must be above 0, found 0"},
      {"goal = nan",
       ":1:8: 'goal' must be a finite number such as 0.002, or one with its "
       "unit such as 2um, found 'nan'"},
      {"goal = \"2 furlongs\"", ":1:8: 'goal' has no unit 'furlongs'"},
      {"indifference = -1", "'indifference' must be at least 0"},
      {"holdouts = \"every:3\"", "must be a list of texts such as"},
      {"holdouts = [\n  \"every:3\",\n  \"evry:3\"]", ":3:3: "},
      {"holdouts = [\"every:3\", \"every:3\"]", "'every:3' twice"},
      {"models = [1]", ":1:11: 'models' in the study must be a list of texts"},
      {"models = [\"nope\"]", ":1:11: model 'nope': unknown"},
      {"component = 1", "must be tables, each headed [[component]]"},
      {"[component]\ndata = \"x\"", "must be tables, each headed"},
      {"[[component]]\nname = \"a\"", ":1:1: [[component]]: needs data"},
      {"[[component]]\ndata = \"\"", ":2:8: 'data' must not be empty"},
      {"[[component]]\ndata = 3", "must be text in quotes"},
      {"[[component]]\ndata = \"x\"\nwhere = \"down\"", ":3:9: 'where'"},
      {"[[component]]\ndata = \"x\"\nwhere = { a = true }",
       "'a' in where must be text in quotes or a number, found true"},
      {"[[component]]\ndata = \"x\"\nmissing = \"skip\"",
       "must be \"error\" or \"drop-rows\", found text ('skip')"},
      {"[[component]]\ndata = \"x\"\nkeep_dead = 1", "must be true or false"},
      {"[[component]]\ndata = 2024-01-01", "found a date or time"},
      {"[[model]]\ndegree = 2", ":1:1: [[model]]: needs use"},
      {"\n[[model]]\nuse = \"poly:full\"\ndegre = 2", ":2:1: model "},
      {"seed = 1", "no [[component]]"},
      {"seed = ", ":1:"},
      {"seed = 1\nseed = 2", "study.toml:2:"}};
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(Refusal(text), HasSubstr(expected)) << text;
  }
  EXPECT_THAT(RefusalOf(Run({"compare", "--config", "none.toml"}), kUnusable),
              HasSubstr("none.toml: cannot be read"));
}

TEST_F(StudyOverrides, WhereThatFitsNoRowAndEqualNamesAreRefused) {
  Write("both.csv", BothWays());
  const std::string component = "[[component]]\ndata = \"both.csv\"\n";
  EXPECT_THAT(Refusal(component + "where = { direction = \"left\" }\n"),
              HasSubstr("no row is left where 'direction' is 'left'; the "
                        "column has 'down', 'up'"));
  EXPECT_THAT(Refusal(component + component),
              HasSubstr("two components are named 'both, "));
}

TEST_F(StudyOverrides, DryRunShowsThePlanAndTouchesNothing) {
  WriteStudy();
  const Outcome outcome =
      Run({"compare", "--config", "study.toml", "--dry-run", "--out", "o"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("component x, down"),
                    HasSubstr("both.csv where direction = up"),
                    HasSubstr("60 rows, 10 groups (cycle)"),
                    HasSubstr("every:3 (1 fold)"),
                    HasSubstr("mean, poly:full:degree=2"),
                    HasSubstr("16 fits in all, seed 3; roughly a second"),
                    HasSubstr("models/COMPONENT/MODEL.json")));
  EXPECT_FALSE(Exists("o"));
  const Outcome plain = Run({"compare", kDown, "--dry-run"});
  EXPECT_THAT(plain.out, HasSubstr("126 fits in all"));
}

}  // namespace
}  // namespace errmap
