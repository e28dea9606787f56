// errmap simulate, as a user runs it.

#include <filesystem>
#include <string>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class SimulateCommand : public CliTest {
 protected:
  Outcome Simulate(std::vector<std::string> more) const {
    std::vector<std::string> words{"simulate", "turning-centre"};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }
};

TEST_F(SimulateCommand, WritesAFolderThatTheOtherCommandsRead) {
  const Outcome outcome = Simulate({"-o",
                                    "new/folder",
                                    "--days",
                                    "2",
                                    "--cycles",
                                    "6",
                                    "--dead",
                                    "3,4,16,19",
                                    "--truth"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err,
              HasSubstr("2 days of 6 cycles, 20 files in new/folder"));
  for (const char* name : {"README.md",
                           "machine.toml",
                           "tool_tip.csv",
                           "diagonals.csv",
                           "temperatures.csv"}) {
    EXPECT_TRUE(Exists(std::string("new/folder/") + name)) << name;
  }
  const Json study = RunJson({"compare",
                              "new/folder/z_yaw.csv",
                              "--models",
                              "mean,poly:eq9",
                              "--format",
                              "json",
                              "--quiet"});
  const Json& data = study["components"][0]["data"];
  EXPECT_EQ(data["rows"], 2 * 6 * 17);
  EXPECT_EQ(data["unit"], "urad");
  EXPECT_EQ(data["inputs"].size(), 37U);
  EXPECT_EQ(data["dropped"].size(), 4U);
}

TEST_F(SimulateCommand, SameSeedSameBytesAnotherSeedAnother) {
  const std::vector<std::string> common = {
      "--cycles", "3", "--noisy", "7", "--stuck", "8", "--quiet", "--seed"};
  const auto with = [&](const std::string& seed, const std::string& folder) {
    std::vector<std::string> words = common;
    words.insert(words.end(), {seed, "-o", folder});
    const Outcome outcome = Simulate(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  };
  with("9", "a");
  with("9", "b");
  with("10", "c");
  int files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(scratch_ / "a")) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(Read("a/" + name), Read("b/" + name)) << name;
    if (name != "machine.toml") {
      EXPECT_NE(Read("a/" + name), Read("c/" + name)) << name;
    }
    ++files;
  }
  EXPECT_EQ(files, 21);  // and the list of them
}

TEST_F(SimulateCommand, FaultsAndTheShiftBeginOnTheDayThatIsNamed) {
  const auto read = [&](const std::string& folder,
                        std::vector<std::string> more,
                        const std::string& file = "x_displacement_down.csv") {
    more.insert(more.begin(),
                {"-o", folder, "--days", "3", "--cycles", "4", "--quiet"});
    const Outcome outcome = Simulate(more);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Records(Read(folder + "/" + file));
  };
  const auto healthy = read("healthy", {"--truth"});
  const auto faulty = read("faulty",
                           {"--truth",
                            "--from-day",
                            "2",
                            "--shift-um",
                            "2",
                            "--drifting",
                            "11",
                            "--dead",
                            "3",
                            "--stuck",
                            "7"});
  ASSERT_EQ(healthy.size(), faulty.size());
  double first_drift = -1.0;
  double last_drift = 0.0;
  for (std::size_t i = 0; i < healthy.size(); ++i) {
    auto before = healthy[i];
    auto after = faulty[i];
    if (before["day"] == "1") {
      EXPECT_EQ(before, after);
      continue;
    }
    EXPECT_NEAR(std::stod(after["truth_mm"]) - std::stod(before["truth_mm"]),
                0.002,
                1e-7);
    EXPECT_EQ(after["t03_degC"], "0");
    last_drift = std::stod(after["t11_degC"]) - std::stod(before["t11_degC"]);
    if (first_drift < 0.0) first_drift = last_drift;
  }
  // 0.04 degC an hour, to the logger's 0.01 degC, from when it was switched on.
  EXPECT_NEAR(first_drift, 0.01, 0.011);
  EXPECT_GT(last_drift, 0.05);
  EXPECT_NE(healthy.back().at("t07_degC"), faulty.back().at("t07_degC"));
  EXPECT_THAT(Read("faulty/README.md"), HasSubstr("| `--from-day` | 2 |"));
}

TEST_F(SimulateCommand, WrongCommandLinesGetOneLine) {
  struct Case {
    std::vector<std::string> words;
    const char* says;
  };
  const std::vector<Case> cases = {
      {{}, "--output"},
      {{"-o", "s", "--cycles", "0"}, "cycles 0: give a whole number from 1"},
      {{"-o", "s", "--days", "-1"}, "days -1"},
      {{"-o", "s", "--dead", "3,40"},
       "no thermocouple 40: they are numbered 0"},
      {{"-o", "s", "--dead", "3", "--noisy", "3"}, "named twice"},
      {{"-o", "s", "--dead", "x"}, "--dead"},
      {{"-o", "s", "--air", "-1"}, "air -1: conductances"},
      {{"-o", "s", "--noise", "-0.1"}, "noise -0.1"},
      {{"-o", "s", "--duty", "nan"}, "duty nan"},
      {{"-o", "s", "--from-day", "3"}, "from-day 3: give a whole number"},
      {{"-o", "s", "--shift-um", "inf"}, "shift-um inf"},
      {{"-o", "s", "--seed", "-1"}, "--seed"},
      {{"-o", "s", "more"}, "more"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(::testing::PrintToString(c.words));
    EXPECT_THAT(RefusalOf(Simulate(c.words), kWrongCommandLine),
                HasSubstr(c.says));
    EXPECT_FALSE(Exists("s"));
  }
  EXPECT_THAT(RefusalOf(Run({"simulate", "milling-machine", "-o", "s"}),
                        kWrongCommandLine),
              HasSubstr("milling-machine"));
  RefusalOf(Run({"simulate"}), kWrongCommandLine);
}

TEST_F(SimulateCommand, FolderThatCannotBeWrittenIsNamed) {
  Write("file", "");
  EXPECT_THAT(RefusalOf(Simulate({"-o", "file"}), kFailure), HasSubstr("file"));
  EXPECT_THAT(RefusalOf(Simulate({"-o", "file/below"}), kFailure),
              HasSubstr("file/below"));
  EXPECT_THAT(RefusalOf(Simulate({"-o", "/proc/none"}), kFailure),
              HasSubstr("/proc/none"));
}

}  // namespace
}  // namespace errmap
