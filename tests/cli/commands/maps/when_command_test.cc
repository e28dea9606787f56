// When to probe again, as a user asks for it.

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// Five days of ten hours on which the error grows by 1 um an hour from a
// position's own; a temperature that tells nothing of it.
class When : public CliTest {
 protected:
  void SetUp() override {
    std::string text = "day,time_s,position_mm,t1_degC,error_um\n";
    for (int day = 1; day <= 5; ++day) {
      for (int i = 0; i < 60; ++i) text += Row(day, 600 * i, 3 * day * i);
    }
    Write("days.csv", text);
    Run({"fit", "days.csv", "--model", "poly:position", "-o", "map.json"});
  }

  static std::string Row(int day, int time, int draw) {
    const int position = 100 * (time / 600 % 3);
    return std::to_string(day) + "," + std::to_string(time) + "," +
           std::to_string(position) + "," + std::to_string(20 + draw % 5) +
           "," + std::to_string(0.01 * position + time / 3600.0) + "\n";
  }
};

TEST_F(When, NamesTheLongestIntervalThatKeepsTheGoal) {
  const Json found =
      RunJson({"when", "map.json", "--goal", "2um", "--format", "json"});
  EXPECT_EQ(found["sessions"], 5);
  EXPECT_EQ(found["clock"]["interval_s"], 7200.0);
  EXPECT_LE(found["clock"]["within_90"], 2.0);
  EXPECT_EQ(found["advised"]["time_s"], 7200.0);
  EXPECT_EQ(found["advised"]["temperature"], nullptr);
  const Outcome text = Run({"when", "map.json", "--goal", "2um"});
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(text.out,
              AllOf(StartsWith("map.json (poly:position) on 5 unseen sessions, "
                               "re-zeroed by probes\n"),
                    HasSubstr("A probe every 2 h keeps 90 % of the errors "
                              "within 2.000 um.")));
}

// Nobody reads the answer off the table.
TEST_F(When, AnswersWithoutAGoal) {
  const Outcome found = Run({"when", "map.json"});
  EXPECT_EQ(found.status, 0) << found.err;
  const std::string text = OneLine(found.out);
  EXPECT_THAT(text, HasSubstr("A probe every 20 min gives the lowest error, "));
  EXPECT_THAT(text, HasSubstr(" RMSE; no probe "));
  EXPECT_THAT(found.out, Not(EndsWith("\n\n")));
}

// What only scatters errs less without the scatter of a probe.
TEST_F(When, SaysThatNoProbeHelpsWhereNoneDoes) {
  std::string text = "day,time_s,position_mm,error_um\n";
  for (int i = 0; i < 300; ++i) {
    text += std::to_string(i / 60) + "," + std::to_string(600 * (i % 60)) +
            "," + std::to_string(100 * (i % 3)) + "," +
            std::to_string((i * 7919) % 101) + "\n";
  }
  Write("noise.csv", text);
  Run({"fit", "noise.csv", "--model", "poly:position", "-o", "noise.json"});
  EXPECT_THAT(OneLine(Run({"when", "noise.json"}).out),
              HasSubstr("No probe helps: without one the error is lowest, "));
}

TEST_F(When, SaysWhenTheNextProbeIsDue) {
  const std::string header = "day,time_s,position_mm,t1_degC,error_um\n";
  Write("soon.csv", header + Row(6, 1200, 0) + Row(6, 4800, 0));
  Write("now.csv", header + Row(6, 1200, 0) + Row(6, 9000, 0));
  const Outcome soon =
      Run({"when", "map.json", "--goal", "2um", "--after", "soon.csv"});
  EXPECT_EQ(soon.status, 0) << soon.err;
  EXPECT_THAT(soon.out,
              HasSubstr("\n1 h since the last probe: probe in 1 h.\n"));
  const Outcome now =
      Run({"when", "map.json", "--goal", "2um", "--after", "now.csv"});
  EXPECT_EQ(now.status, kEveryFitFailed) << now.err;
  EXPECT_THAT(now.out, HasSubstr("since the last probe: probe now.\n"));
}

// A script that asks again and again is not to wait for ever.
TEST_F(When, EndsWithAnErrorWhereNothingCanBeSaid) {
  Write("empty.csv", "day,time_s,position_mm,t1_degC,error_um\n");
  for (const char* goal : {"2um", "1nm"}) {
    EXPECT_EQ(
        Run({"when", "map.json", "--goal", goal, "--after", "none.csv"}).status,
        kUnusable);
    EXPECT_EQ(Run({"when", "map.json", "--goal", goal, "--after", "empty.csv"})
                  .status,
              kUnusable);
  }
  const Outcome no_goal = Run({"when", "map.json", "--after", "empty.csv"});
  EXPECT_EQ(no_goal.status, kWrongCommandLine) << no_goal.out;
  EXPECT_THAT(no_goal.err, HasSubstr("needs a goal to say"));
  const Outcome never = Run({"when", "map.json", "--goal", "1nm"});
  EXPECT_EQ(never.status, kEveryFitFailed);
  EXPECT_THAT(never.out, HasSubstr("No interval keeps 90 %"));
  EXPECT_THAT(never.out, HasSubstr("no probe"));
  const Outcome always = Run({"when", "map.json", "--goal", "1mm"});
  EXPECT_EQ(always.status, 0);
  EXPECT_THAT(always.out, HasSubstr("No probe is needed"));
  EXPECT_THAT(always.out, Not(HasSubstr("for a new one")));
}

TEST_F(When, DoesNotCallEnoughWhatUnequalDaysDoNotPromise) {
  std::string text = "day,time_s,position_mm,t1_degC,error_mm\n";
  for (int day = 1; day <= 5; ++day) {
    for (int i = 0; i < 60; ++i) {
      text += fmt::format("{},{},{},{},{}\n",
                          day,
                          600 * i,
                          100 * (i % 3),
                          20 + 3 * day * i % 5,
                          1e-4 * day * i);
    }
  }
  Write("unequal.csv", text);
  Run({"fit", "unequal.csv", "--model", "poly:position", "-o", "unequal.json"});
  const Json found = RunJson({"when", "unequal.json", "--format", "json"});
  const auto shown = found["none"]["within_90"].get<double>();
  const Outcome narrow = Run(
      {"when", "unequal.json", "--goal", fmt::format("{}mm", 1.001 * shown)});
  EXPECT_THAT(OneLine(narrow.out),
              AllOf(HasSubstr("Take a few probes in each new day"),
                    HasSubstr("In the 5 days measured they stay within"),
                    Not(HasSubstr("No probe is needed"))));
  EXPECT_THAT(Run({"when", "unequal.json", "--goal", "20"}).err,
              HasSubstr("goal 20 is in mm, the unit of error_mm: 20000 um"));
  EXPECT_EQ(Run({"when", "unequal.json", "--goal", "0.02"}).err, "");
}

// What probes say today and when to take the next ones, in one answer.
TEST_F(When, IsSaidByCheckForAGoal) {
  Write("probes.csv",
        "day,time_s,position_mm,t1_degC,error_um\n" + Row(6, 600, 0) +
            Row(6, 1200, 1) + Row(6, 1800, 2));
  const Outcome text =
      Run({"check", "map.json", "probes.csv", "--goal", "2um"});
  EXPECT_THAT(text.out,
              HasSubstr("\nA probe every 2 h keeps 90 % of the errors within "
                        "2.000 um."));
  // Half an hour tells nothing of the day: status 5.
  const auto parsed = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"check", "map.json", "probes.csv"});
    words.insert(words.end(), {"--format", "json"});
    return Json::parse(Run(words).out);
  };
  const Json found = parsed({"--goal", "2um"});
  EXPECT_EQ(found["next_probe"]["interval_s"], 7200.0);
  EXPECT_EQ(found["next_probe"]["kept"], true);
  EXPECT_FALSE(parsed({}).contains("next_probe"));
}

TEST_F(When, RefusesMapsOfOneSession) {
  Run({"fit", kDown, "--model", "poly:position", "-o", "one.json"});
  const Outcome found = Run({"when", "one.json"});
  EXPECT_EQ(found.status, kUnusable);
  EXPECT_THAT(found.err,
              HasSubstr("one.json: has no held-out errors with times"));
}

}  // namespace
}  // namespace errmap
