// Study files that init writes.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/commands/studies/study_of_both_ways.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class InitCommand : public StudyOfBothWays {};

TEST_F(InitCommand, InitWritesAFileThatDoesWhatTheDataFileAloneDoes) {
  const std::vector<std::string> quick = {
      "--models", "mean,poly:eq8", "--format", "json"};
  ASSERT_EQ(Run({"init", kDown}).status, 0);
  std::vector<std::string> words = {"compare", "--config", "study.toml"};
  words.insert(words.end(), quick.begin(), quick.end());
  Json from_file = RunJson(words)["components"];
  words = {"compare", kDown};
  words.insert(words.end(), quick.begin(), quick.end());
  Json from_data = RunJson(words)["components"];
  DropTimes(&from_file);
  DropTimes(&from_data);
  // Here the file names the roles, there the values tell them.
  from_file[0]["data"].erase("reading");
  from_data[0]["data"].erase("reading");
  EXPECT_EQ(from_file.dump(), from_data.dump());
  // The models it writes are those that the data alone would get.
  const Outcome plan = Run({"compare", "--config", "study.toml", "--dry-run"});
  const Outcome plan_of_data = Run({"compare", kDown, "--dry-run"});
  EXPECT_EQ(plan.out, plan_of_data.out);
}

TEST_F(InitCommand, InitNamesDroppedSensorsAndRefusesToOverwrite) {
  const std::string data = SetPath("turning_centre/x_displacement_down.csv");
  const Outcome outcome = Run({"init", data, "-o", "s.toml"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string text = Read("s.toml");
  EXPECT_THAT(text,
              AllOf(HasSubstr("# t03_degC is left out: is dead (0 in all 1190"),
                    HasSubstr("target = \"error_mm\""),
                    HasSubstr("# goal = \"2um\""),
                    HasSubstr("group = \"cycle\""),
                    Not(HasSubstr("\ngoal ="))));
  EXPECT_THAT(RefusalOf(Run({"init", data, "-o", "s.toml"}), kWrongCommandLine),
              HasSubstr("s.toml exists"));
  EXPECT_EQ(Read("s.toml"), text);
  EXPECT_EQ(Run({"init", data, "-o", "s.toml", "--force"}).status, 0);
}

TEST_F(InitCommand, InitMakesAComponentOfEachDirection) {
  Write("both.csv", BothWays());
  ASSERT_EQ(Run({"init", "both.csv"}).status, 0);
  const Json components = RunStudy({"--models", "mean"})["components"];
  ASSERT_EQ(components.size(), 2U);
  EXPECT_EQ(components[0]["name"], "both, down");
  EXPECT_EQ(components[1]["name"], "both, up");
  EXPECT_EQ(components[1]["data"]["rows"], 60);
}

TEST_F(InitCommand, HostileNamesSurviveInitAndCompare) {
  const std::vector<std::string> names = {"quo\"ted",
                                          "new\nline",
                                          "a = 1 # not a comment",
                                          "back\\slash",
                                          "tab\there",
                                          "\xE2\x80\xAEright to left",
                                          "'single'",
                                          "]] [[model]]",
                                          std::string(200, 'n')};
  for (const std::string& name : names) {
    std::string field = "\"";
    for (const char c : name) field += c == '"' ? "\"\"" : std::string(1, c);
    Write("data.csv", BothWays(field + "\""));
    const Outcome init = Run({"init", "data.csv", "--force"});
    ASSERT_EQ(init.status, 0) << init.err;
    const Json component = RunStudy({"--models", "mean"})["components"][0];
    EXPECT_EQ(component["data"]["inputs"], Json::array({name})) << name;
    // Named outright they come back the same.
    std::string text = Read("study.toml");
    for (std::size_t at = 0; (at = text.find("# inputs", at)) != text.npos;) {
      text.erase(at, 2);
    }
    for (std::size_t at = 0; (at = text.find("\n#   \"", at)) != text.npos;) {
      text.erase(at + 1, 2);
    }
    for (std::size_t at = 0; (at = text.find("\n# ]", at)) != text.npos;) {
      text.erase(at + 1, 2);
    }
    Write("study.toml", text);
    EXPECT_EQ(RunStudy({"--models", "mean"})["components"][0]["data"]["inputs"],
              Json::array({name}))
        << text;
  }
}

TEST_F(InitCommand, HostileValuesAndFileNamesSurviveInit) {
  std::string text = BothWays();
  const std::string odd = "\"do\"\"wn; $(id) `id`\"";
  for (std::size_t at = 0; (at = text.find(",down,", at)) != text.npos;) {
    text.replace(at, 6, "," + odd + ",");
  }
  Write("it's \"odd\".csv", text);
  ASSERT_EQ(Run({"init", "it's \"odd\".csv"}).status, 0);
  const Json components =
      RunStudy({"--models", "mean", "--out", "o"})["components"];
  ASSERT_EQ(components.size(), 2U);
  EXPECT_EQ(components[0]["data"]["rows"], 60);
  EXPECT_EQ(components[0]["data"]["file"], "it's \"odd\".csv");
}

}  // namespace
}  // namespace errmap
