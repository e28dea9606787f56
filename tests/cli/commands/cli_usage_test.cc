// The program in the hands of a user: arguments, failures, interrupts, odd
// data.

#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/version.h"
#include "tests/cli/cli_fixture.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// ---- The command line.

TEST_F(Cli, WrongCommandLinesGetOneLine) {
  struct Case {
    std::vector<std::string> words;
    const char* says;
  };
  const std::vector<Case> cases = {
      {{"frobnicate"}, "frobnicate"},
      {{"compare"}, "DATA"},
      {{"compare", kDown, "--frob"}, "--frob"},
      {{"compare", kDown, "--models", "net:foo"}, "net:foo"},
      {{"compare", kDown, "--model", "poly:full:degre=2"}, "degre"},
      {{"compare", kDown, "--model", "poly:full:degree=99"}, "99"},
      {{"compare", kDown, "--model", "net:scg:hidden=0"}, "hidden"},
      {{"compare", kDown, "--holdout", "every:1"}, "every:1"},
      {{"compare", kDown, "--holdout", "thirds"}, "thirds"},
      {{"compare", kDown, "--holdout", "every:3", "--holdout", "every:3"},
       "twice"},
      {{"compare", kDown, "--jobs", "0"}, "--jobs"},
      {{"compare", kDown, "--jobs", "x"}, "--jobs"},
      {{"compare", kDown, "--format", "xml"}, "xml"},
      {{"compare", kDown, "--missing", "zero"}, "--missing"},
      {{"compare", kDown, "--models", "mean,poly:eq8,mean"}, "mean"},
      {{"compare", kDown, "--models", "mean", "--model", "mean"}, "twice"},
      {{"compare", kDown, "--models", "mean,"}, "empty"},
      {{"compare", kDown, "--goal", "-1"}, "--goal"},
      {{"compare", kDown, "--goal", "nan"}, "--goal must be a finite number"},
      {{"compare", kDown, "--goal", "inf"}, "--goal must be a finite number"},
      {{"compare", kDown, "--goal", "2 ly"}, "--goal has no unit 'ly'"},
      {{"compare", kDown, "--indifference", "nan"}, "--indifference"},
      {{"compare", kDown, "--seed", "x"}, "--seed"},
      {{"compare", kDown, "--seed", "18446744073709551616"},
       "a whole number from 0 to 18446744073709551615"},
      {{"fit", kDown, "-o", "m.json"}, "--model"},
      {{"fit", kDown, "--model", "mean"}, "--output"},
      {{"fit", kDown, "--model", "poly", "-o", "m.json"}, "poly"},
      {{"predict", "m.json"}, "DATA"},
      {{"evaluate", "m.json", kDown, "--format", "xml"}, "xml"},
      {{"residuals", kAppendixB}, "--column"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(::testing::PrintToString(c.words));
    EXPECT_THAT(RefusalOf(Run(c.words), kWrongCommandLine), HasSubstr(c.says));
  }
  // A further word is a further file.
  EXPECT_THAT(RefusalOf(Run({"compare", kDown, "more"}), kUnusable),
              HasSubstr("more: cannot be read: there is no such file; write "
                        "lists (A,B) and numbers with a unit (2um) without "
                        "blanks"));
}

TEST_F(Cli, HelpAndVersionGoToStdout) {
  const Outcome version = Run({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_TRUE(version.out.starts_with("errmap ")) << version.out;
  const std::vector<std::string> lines = SplitLines(version.out);
  EXPECT_EQ(lines.front(), std::string("errmap ") + models::Version());
  EXPECT_THAT(version.out, HasSubstr("Ceres 2."));
  std::vector<std::vector<std::string>> commands = {{}};
  for (const char* name :
       {"compare", "fit", "predict", "evaluate", "residuals"}) {
    EXPECT_THAT(Run({"--help"}).out, HasSubstr(name));
    commands.push_back({name});
  }
  for (std::vector<std::string> words : commands) {
    words.emplace_back("--help");
    const Outcome help = Run(words);
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_THAT(help.out, HasSubstr("Usage: errmap"));
  }
}

TEST_F(Cli, EveryCommandHasAnExampleAndItsStatuses) {
  const std::string help = Run({"--help"}).out;
  std::istringstream lines(help);
  int commands = 0;
  for (std::string line; std::getline(lines, line);) {
    static const std::regex kCommand("^  ([a-z0-9]+)  +[A-Z].*");
    std::smatch found;
    if (!std::regex_match(line, found, kCommand) || found[1] == "help") {
      continue;
    }
    ++commands;
    const std::string text = Run({"help", found[1]}).out;
    EXPECT_THAT(text, HasSubstr("Example")) << found[1];
    EXPECT_THAT(OneLine(text), HasSubstr("Exit status")) << found[1];
  }
  EXPECT_GT(commands, 20);
}

TEST_F(Cli, FailedFitsAreRowsAndTheOthersGoOn) {
  WriteWithoutPosition("small.csv", 19);
  const std::vector<std::string> words{"compare",
                                       "small.csv",
                                       "--models",
                                       "mean,poly:full:degree=12",
                                       "--holdout",
                                       "every:3"};
  const Outcome table = Run(words);
  EXPECT_EQ(table.status, 0);
  EXPECT_THAT(OneLine(table.out),
              HasSubstr("poly:full:degree=12 failed, every:3: degree 12 in 2 "
                        "inputs has 91 coefficients, more than the 13 "
                        "training rows"));
  std::vector<std::string> json_words = words;
  json_words.insert(json_words.end(), {"--format", "json", "--out", "o"});
  const Json component = RunJson(json_words)["components"][0];
  EXPECT_EQ(Model(component, "mean")["status"], "ok");
  const Json failed = Model(component, "poly:full:degree=12");
  EXPECT_EQ(failed["status"], "failed");
  EXPECT_THAT(failed["why"].get<std::string>(), HasSubstr("91 coefficients"));
  EXPECT_TRUE(Exists("o/models/mean.json"));
  EXPECT_FALSE(Exists("o/models/poly_full_degree=12.json"));
}

TEST_F(Cli, EveryFitFailedIsItsOwnStatus) {
  WriteWithoutPosition("small.csv", 19);
  const Outcome outcome = Run({"compare",
                               "small.csv",
                               "--models",
                               "poly:full:degree=12,poly:eq8",
                               "--holdout",
                               "every:3"});
  EXPECT_EQ(outcome.status, kEveryFitFailed);
  EXPECT_THAT(OneLine(outcome.out),
              AllOf(HasSubstr("91 coefficients"),
                    HasSubstr("poly:eq8 failed, every:3: the data lack a "
                              "position")));
  EXPECT_EQ(outcome.err,
            "errmap: every fit failed; the reasons are in the table\n");
  EXPECT_THAT(RefusalOf(Run({"fit",
                             "small.csv",
                             "--model",
                             "poly:full:degree=12",
                             "-o",
                             "m.json",
                             "--quiet"}),
                        kEveryFitFailed),
              HasSubstr("91 coefficients"));
  EXPECT_FALSE(Exists("m.json"));
}

// Until the program has worked for so many seconds of its own time, however
// busy the machine is.
void WaitForWork(const Process& process, double seconds) {
  const double begin = process.CpuSeconds();
  while (process.CpuSeconds() < begin + seconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

TEST_F(Cli, InterruptedRunShowsAndWritesWhatItHas) {
  Process process(scratch_.path(),
                  {"compare",
                   kDown,
                   "--models",
                   kEndlessNet,
                   "--holdout",
                   "every:3",
                   "--goal",
                   "1",  // mm: any map would do
                   "--out",
                   "o",
                   "--format",
                   "table"});
  ASSERT_TRUE(process.WaitUntilInterruptible());
  WaitForWork(process, 0.5);
  process.Interrupt();
  const Outcome outcome = process.Wait();
  EXPECT_EQ(outcome.status, kInterrupted);
  EXPECT_THAT(outcome.out, HasSubstr(kEndlessNet));
  EXPECT_THAT(outcome.err, HasSubstr("errmap: interrupted"));
  const Json results = Json::parse(Read("o/results.json"));
  EXPECT_EQ(results["interrupted"], true);
  // What an interrupted run leaves is held against no goal.
  const Json& advice = results["components"][0]["recommendation"];
  EXPECT_EQ(advice["meets_goal"], nullptr);
  EXPECT_EQ(advice["goal_standing"], "not judged");
  const Json& fold =
      results["components"][0]["models"][0]["results"]["every:3"]["folds"][0];
  EXPECT_EQ(fold["stop"], "interrupted");
  EXPECT_EQ(fold["converged"], false);
  EXPECT_EQ(Records(Read("o/residuals.csv")).size(), 132U);
}

TEST_F(Cli, InterruptedFitWritesTheBestMapSoFar) {
  Process process(scratch_.path(),
                  {"fit", kDown, "--model", kEndlessNet, "-o", "m.json"});
  ASSERT_TRUE(process.WaitUntilInterruptible());
  WaitForWork(process, 0.3);
  process.Interrupt();
  const Outcome outcome = process.Wait();
  EXPECT_EQ(outcome.status, kInterrupted);
  EXPECT_THAT(outcome.out, HasSubstr("stop: interrupted"));
  EXPECT_EQ(Run({"predict", "m.json", kDown}).status, 0);
}

TEST_F(Cli, UnwritableOutputGivesOneLineAndNoFile) {
  Write("file", "kept");
  for (const std::string path : {"file", "file/deeper"}) {
    EXPECT_THAT(
        RefusalOf(Run({"compare", kDown, "--models", "mean", "--out", path}),
                  kFailure),
        HasSubstr(path));
  }
  EXPECT_THAT(
      RefusalOf(Run({"fit", kDown, "--model", "mean", "-o", "none/m.json"}),
                kFailure),
      HasSubstr("none/m.json"));
  Fit("mean", "m.json");
  const Outcome outcome =
      Run({"predict", "m.json", kDown, "-o", "none/p.csv", "--quiet"});
  EXPECT_THAT(RefusalOf(outcome, kFailure), HasSubstr("none/p.csv"));
  EXPECT_FALSE(Exists("none"));
  EXPECT_EQ(Read("file"), "kept");
}

// ---- Hold-outs, groups and names.

TEST_F(Cli, OneCycleOnlyRefusesGroupsAndSaysWhatIsPossible) {
  std::string text = "cycle,position_mm,t1,error_um\n";
  for (int i = 0; i < 30; ++i) {
    text += "1," + std::to_string(i) + "," + std::to_string((i * 7) % 11) +
            "," + std::to_string(i * i) + "\n";
  }
  Write("one.csv", text);
  EXPECT_THAT(
      RefusalOf(Run({"compare", "one.csv", "--holdout", "groups:5"}),
                kUnusable),
      AllOf(HasSubstr("one.csv: hold-out 'groups:5': needs at least 5 groups, "
                      "found 1"),
            HasSubstr("every:3")));
  const Outcome usual =
      Run({"compare", "one.csv", "--models", "mean,poly:eq8"});
  EXPECT_EQ(usual.status, 0);
  EXPECT_THAT(usual.err, HasSubstr("column 'cycle' has one group only"));
  EXPECT_THAT(usual.out, Not(HasSubstr("groups:5")));
}

TEST_F(Cli, GroupsWithoutAGroupColumnAreRefused) {
  WriteWithoutPosition("f.csv");
  EXPECT_THAT(
      RefusalOf(Run({"compare",
                     "f.csv",
                     "--holdout",
                     "groups:5",
                     "--models",
                     "mean"}),
                kUnusable),
      HasSubstr("f.csv: hold-out 'groups:5': there are no groups; name a "
                "column with --group"));
}

TEST_F(Cli, DataWithoutPositionLeavePositionModelsOut) {
  WriteWithoutPosition("f.csv");
  const Outcome outcome = Run({"compare", "f.csv", "--format", "json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              HasSubstr("errmap: poly:position, poly:eq7, poly:eq8, poly:eq9 "
                        "are left out: the data lack a position"));
  std::vector<std::string> names;
  const Json results = Json::parse(outcome.out);
  for (const Json& model : results["components"][0]["models"]) {
    names.push_back(model["name"]);
    EXPECT_EQ(model["status"], "ok") << names.back();
  }
  for (const std::string left_out :
       {"poly:position", "poly:eq7", "poly:eq8", "poly:eq9"}) {
    EXPECT_THAT(names, Not(::testing::Contains(left_out)));
  }
  EXPECT_THAT(names, ::testing::Contains("poly:temperature"));
  EXPECT_THAT(names, ::testing::Contains("net:scg"));
}

TEST_F(Cli, HoldoutFileIsTestedOnAndNeverTrainedOn) {
  const std::vector<std::string> lines = SplitLines(Process::TextOf(kDown));
  // Rows that the training file does not have.
  const auto moved = [](std::string line) { return line + "1"; };
  Write("test.csv",
        lines[0] + "\n" + moved(lines[3]) + "\n" + moved(lines[90]) + "\n");
  const Json component = Compare(
      {"--models", "poly:eq8", "--holdout", "file:test.csv", "--out", "o"});
  EXPECT_EQ(component["holdouts"][0]["name"], "file:test.csv");
  EXPECT_EQ(component["holdouts"][0]["train_rows"][0].size(), 397U);
  const Json& results = component["models"][0]["results"]["file:test.csv"];
  EXPECT_EQ(results["test"]["n"], 2);
  EXPECT_EQ(results["train"]["n"], 397);
  Fit("poly:eq8", "m.json");
  const auto predicted = Records(Run({"predict", "m.json", "test.csv"}).out);
  const auto held_out = Records(Read("o/residuals.csv"));
  ASSERT_EQ(held_out.size(), 2U);
  ASSERT_EQ(predicted.size(), 2U);
  EXPECT_EQ(held_out[1].at("poly:eq8"), predicted[1].at("predicted"));
  EXPECT_THAT(RefusalOf(Run({"compare",
                             kDown,
                             "--models",
                             "mean",
                             "--holdout",
                             "file:none.csv"}),
                        kUnusable),
              HasSubstr("none.csv: cannot be read"));
}

TEST_F(Cli, TextGroupsAreHeldOutInOrderOfAppearance) {
  std::string text = "day_name,position_mm,error_mm\n";
  for (int i = 0; i < 30; ++i) {
    const char* day = i < 10 ? "Wed" : i < 20 ? "Thu" : "Fri";
    text += std::string(day) + "," + std::to_string(i) + "," +
            std::to_string(i * i % 17) + "\n";
  }
  Write("days.csv", text);
  const Json component = RunJson({"compare",
                                  "days.csv",
                                  "--group",
                                  "day_name",
                                  "--models",
                                  "mean",
                                  "--holdout",
                                  "leave-one-group-out",
                                  "--format",
                                  "json",
                                  "--out",
                                  "o"})["components"][0];
  EXPECT_EQ(component["data"]["group"], "day_name");
  EXPECT_EQ(component["data"]["inputs"], Json::parse(R"(["position_mm"])"));
  const Json& tests = component["holdouts"][0]["test_rows"];
  ASSERT_EQ(tests.size(), 3U);
  EXPECT_EQ(tests[0][0], 0);
  EXPECT_EQ(tests[1][0], 10);
  EXPECT_EQ(tests[2][9], 29);
  EXPECT_EQ(Records(Read("o/residuals.csv"))[12].at("day_name"), "Thu");
}

TEST_F(Cli, ColumnNamesMayHoldBlanksQuotesAndCommas) {
  std::string text = "\"position, \"\"x\"\" mm\",t 1,error_mm\n";
  for (int i = 0; i < 30; ++i) {
    text += std::to_string(i) + "," + std::to_string((i * 7) % 11) + "," +
            std::to_string(i * i % 17) + "\n";
  }
  Write("odd.csv", text);
  const Json expected = {"position, \"x\" mm", "t 1"};
  for (const std::string inputs : {"",
                                   "\"position, \"\"x\"\" mm\",t 1",
                                   "\"position, \"\"x\"\" mm\",\"t 1\""}) {
    std::vector<std::string> words{"compare",
                                   "odd.csv",
                                   "--models",
                                   "poly:eq8:T=\"t 1\"",
                                   "--holdout",
                                   "every:3",
                                   "--format",
                                   "json"};
    if (!inputs.empty()) words.insert(words.end(), {"--inputs", inputs});
    const Json component = RunJson(words)["components"][0];
    EXPECT_EQ(component["data"]["inputs"], expected) << inputs;
    EXPECT_EQ(component["models"][0]["status"], "ok");
  }
  EXPECT_EQ(
      Run({"fit", "odd.csv", "--model", "poly:eq8", "-o", "m.json"}).status, 0);
  EXPECT_EQ(Run({"predict", "m.json", "odd.csv"}).status, 0);
}

}  // namespace
}  // namespace errmap
