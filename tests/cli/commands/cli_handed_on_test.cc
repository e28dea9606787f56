// What leaves the machine or reaches the terminal: no paths, no commands.

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliHandedOn : public Cli {};

TEST_F(CliHandedOn, AbsolutePathsStayOutOfWhatIsHandedOn) {
  WriteWithoutPosition("d.csv");
  const std::string folder = scratch_.path().string();
  const std::string data = folder + "/d.csv";
  const auto texts = [&] {
    std::string all = Read("map.json");
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(scratch_ / "study")) {
      if (entry.is_regular_file()) all += Process::TextOf(entry.path());
    }
    return all;
  };
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> compare{"compare",
                                     data,
                                     "--models",
                                     "mean",
                                     "--out",
                                     folder + "/study",
                                     "--quiet"};
    std::vector<std::string> fit{
        "fit", data, "--model=mean", "-o", folder + "/map.json"};
    compare.insert(compare.end(), more.begin(), more.end());
    fit.insert(fit.end(), more.begin(), more.end());
    EXPECT_EQ(Run(compare).status, 0);
    EXPECT_EQ(Run(fit).status, 0);
  };
  run({});
  EXPECT_THAT(texts(), Not(HasSubstr(folder)));
  EXPECT_THAT(texts(), HasSubstr("errmap compare d.csv"));
  run({"--keep-paths"});
  EXPECT_THAT(Read("study/results.json"), HasSubstr(data));
  EXPECT_THAT(Read("map.json"), HasSubstr(data));
}

TEST_F(CliHandedOn, AbsolutePathsStayOutOfDocuments) {
  const std::string folder = scratch_.path().string();
  const std::string data = folder + "/d.csv";
  const std::string map = folder + "/m.json";
  Write("d.csv", Process::TextOf(kDown));
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{
           {"fit", data, "--model", "poly:eq8", "-o", map},
           {"evaluate", map, data},
           {"check", map, data},
           {"learn", data, "--by", "cycles", "--models", "mean"},
           {"residuals", data, "--column", "error_mm"}}) {
    SCOPED_TRACE(words.front());
    std::vector<std::string> run = words;
    run.insert(run.end(), {"--format", "json"});
    EXPECT_THAT(RunJson(run).dump(), Not(HasSubstr(folder)));
  }
}

TEST_F(CliHandedOn, NothingThatIsReadCommandsTheTerminal) {
  const std::string escape = "\x1b[2J\x9b\xc2\x9b\x7f";
  Write("d.csv",
        "cycle,position_mm,\"t" + escape +
            "1\nerrmap: all is well\",error_mm\n"
            "1,0,3,4\n1,1,4,7\n2,0,3,5\n2,1,9,9\n3,0,1,2\n3,1,2,3\n");
  const std::vector<std::vector<std::string>> commands = {
      {"compare", "d.csv", "--models", "mean,poly:full:degree=1"},
      {"compare", "d.csv", "--models", "mean", "--format", "json"},
      {"compare", "d.csv", "--models", "mean", "--format", "csv"},
      {"compare", "d.csv", "--models", "file:" + escape},
      {"compare", "d.csv", "--models", escape},
      {"compare", "d" + escape + "\nerrmap: done"},
      {"fit",
       "d.csv",
       "--model",
       "poly:full:degree=1",
       "-o",
       "m.json",
       "--correlations"},
      {"predict", "m.json", "d.csv"},
      {"residuals", "d.csv", "--column", escape},
      {"--" + escape}};
  for (const std::vector<std::string>& words : commands) {
    SCOPED_TRACE(::testing::PrintToString(words));
    const Outcome outcome = Run(words);
    for (const std::string& text : {outcome.out, outcome.err}) {
      for (const char* control : {"\x1b", "\x7f", "\xc2\x9b", "\r"}) {
        EXPECT_THAT(text, Not(HasSubstr(control)));
      }
      EXPECT_THAT(text, Not(HasSubstr("[2J\x9b")));
    }
    for (const std::string& line : SplitLines(outcome.out + outcome.err)) {
      EXPECT_FALSE(line.starts_with("errmap: all is well"));
      EXPECT_FALSE(line.starts_with("errmap: done"));
    }
  }
  EXPECT_EQ(RunJson({"compare",
                     "d.csv",
                     "--models",
                     "mean",
                     "--format",
                     "json"})["components"][0]["data"]["inputs"]
                .size(),
            2U);
}

}  // namespace
}  // namespace errmap
