// What more days and which sensors would be worth, and what to measure next.

#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/commands/promise_days.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class LearnCommand : public CliPromise {};

TEST_F(LearnCommand, LearnsFromDaysOneAfterAnother) {
  const std::vector<std::string> learn = {"learn",
                                          "train.csv",
                                          "--by",
                                          "sessions",
                                          "--models",
                                          "mean,poly:full:degree=1",
                                          "--goal",
                                          "0.001",
                                          "--out",
                                          "study"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = learn;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const Json found = RunJson(with({"--format", "json"}));
  const Json& curves = found["curves"];
  EXPECT_EQ(curves["unit"], "day");
  EXPECT_EQ(curves["units"], 10);
  ASSERT_EQ(curves["models"].size(), 2U);
  const Json& linear = curves["models"][1];
  EXPECT_LT(linear["points"].back()["rmse"], linear["points"][0]["rmse"]);
  EXPECT_GT(linear["law"]["never_reaches_goal"].get<double>(), 0.5);
  EXPECT_TRUE(Exists("study/learn-sessions.json"));
  EXPECT_THAT(Read("study/learn-sessions.svg"), HasSubstr("<svg"));
  // The same again from the fits that were kept.
  const Outcome again = Run(with({"--resume"}));
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.out,
              AllOf(HasSubstr("on an unseen day"), HasSubstr("expected")));
}

TEST_F(LearnCommand, LearnsWhichSensorsDoIt) {
  const Outcome outcome = Run({"learn", "train.csv", "--by", "sensors"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(
      outcome.out,
      AllOf(HasSubstr("of 3 sensors are enough"), HasSubstr("t1_degC")));
  const std::string begin = "With these alone:\n  errmap ";
  const std::size_t at = outcome.out.find(begin);
  ASSERT_NE(at, std::string::npos) << outcome.out;
  std::istringstream line(outcome.out.substr(at + begin.size()));
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  EXPECT_THAT(words.at(0) + " " + words.at(1), "compare train.csv");
  EXPECT_THAT(words.back(),
              AllOf(HasSubstr("position_mm"), HasSubstr("t1_degC")));
  words.insert(words.end(), {"--models", "poly:full:degree=1", "--quiet"});
  EXPECT_EQ(Run(words).status, 0);
}

TEST_F(LearnCommand, PutsWhatWasLearntOnThePageOfTheStudy) {
  const std::vector<std::string> compare{"compare",
                                         "train.csv",
                                         "--models",
                                         "mean,poly:full:degree=1",
                                         "--out",
                                         "study",
                                         "--quiet"};
  ASSERT_EQ(Run(compare).status, 0);
  const std::string before = Read("study/report.html");
  EXPECT_THAT(before, HasSubstr("What the error would be without a sensor"));
  EXPECT_THAT(before, Not(HasSubstr("What fewer sensors would do")));
  for (const char* by : {"sensors", "sessions"}) {
    ASSERT_EQ(Run({"learn",
                   "train.csv",
                   "--by",
                   by,
                   "--models",
                   "mean,poly:full:degree=1",
                   "--out",
                   "study",
                   "--quiet"})
                  .status,
              0);
  }
  EXPECT_EQ(Run({"report", "study"}).status, 0);
  const std::string page = Read("study/report.html");
  EXPECT_THAT(
      page,
      AllOf(HasSubstr("What fewer sensors would do"),
            HasSubstr("of 3 sensors are enough, within 5\u00a0% of all"),
            HasSubstr("What each further day would bring"),
            HasSubstr("with all 10:")));
  EXPECT_EQ(Run({"report", "study", "--format", "html"}).out, page);
  // Of other data it tells nothing.
  Write("train.csv", DaysInCliPromise(2, 11));
  ASSERT_EQ(Run(compare).status, 0);
  EXPECT_THAT(Read("study/report.html"),
              Not(HasSubstr("What fewer sensors would do")));
  Write("study/learn-sensors.json", "{ half");
  const Outcome torn = Run({"report", "study"});
  EXPECT_EQ(torn.status, 0);
  EXPECT_THAT(torn.err, HasSubstr("learn-sensors.json is not drawn: is no"));
}

TEST_F(LearnCommand, LearnsWhatToMeasureNext) {
  Write("next.csv",
        "position_mm,t1_degC,t2_degC,t3_degC\n"
        "80,24,23,22\n80,45,38,34\n40,24,23,22\n");
  const Json found =
      RunJson({"learn", "train.csv", "--next", "next.csv", "--format", "json"});
  EXPECT_EQ(found["next"][0]["row"], 1);
  Write("three.csv", DaysInCliPromise(1, 3));
  EXPECT_THAT(Run({"learn", "three.csv", "--by", "sessions"}).err,
              HasSubstr("needs at least 4 days; the data have 3"));
  EXPECT_THAT(RefusalOf(Run({"learn", "train.csv"}), kWrongCommandLine),
              HasSubstr("--by sessions|cycles|sensors"));
}

}  // namespace
}  // namespace errmap
