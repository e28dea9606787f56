// errmap netcg and errmap convert, as a user runs them.

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class NetcgCommand : public CliTest {
 protected:
  void CopyRun(const std::string& name, const std::string& as) const {
    Write(as, Process::TextOf(tests::TestDir() + "/golden/netcg/runs/" + name));
  }
  std::size_t NumFiles(const std::string& folder) const {
    if (!std::filesystem::exists(scratch_ / folder)) return 0;
    const std::filesystem::directory_iterator files(scratch_ / folder);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }
};

TEST_F(NetcgCommand, WritesTheProgramsFilesBesideTheRunFile) {
  CopyRun("case_c.in", "netcg.in");
  CopyRun("tiny.tab", "tiny.tab");
  const Outcome outcome = Run({"netcg", "netcg.in", "--precision", "double"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("12 patterns, 3-4-2 nodes, 26 weights, double"),
                    HasSubstr("ierr 1, iteration limit"),
                    HasSubstr("     0.159165       0.204571\n")));
  EXPECT_THAT(Read("run.out"),
              AllOf(HasSubstr("Mean                           Standard"),
                    HasSubstr("0.3778830E-02                           0.159"),
                    HasSubstr("\"errmap netcg --help\" names its errata\n")));
  EXPECT_EQ(Read("graph_err.out").substr(0, 25), "          60           2\n");
  EXPECT_THAT(Read("weights.out"),
              HasSubstr("    3    4    2\n  -0.258032E+00"));
  EXPECT_THAT(Read("graph_w1.out"), HasSubstr("     5      5\n     0  "));
  EXPECT_THAT(Read("graph_w2.out"), HasSubstr("     5      3\n     1  "));
  EXPECT_EQ(SplitLines(Read("graph_res.out")).size(), 12U);

  const Json json = RunJson(
      {"netcg", "netcg.in", "--out", "o", "--corrected", "--format", "json"});
  EXPECT_EQ(json["schema"], "errmap-netcg-1");
  EXPECT_EQ(json["precision"], "single");
  EXPECT_EQ(json["runs"][0]["predicted"].size(), 12U);
  EXPECT_THAT(Read("o/run.out"), HasSubstr("(Lilliefors: mean and sd"));
}

TEST_F(NetcgCommand, LeavesNothingHalfWrittenWhereTheInputIsBad) {
  CopyRun("case_c.in", "netcg.in");
  CopyRun("tiny.tab", "tiny.tab");
  const std::string good = Read("netcg.in");
  Write("garbage.in", std::string(10'000'000, '\x81'));
  Write("short.in", good.substr(0, good.size() - 3));
  std::string patterns = good;
  patterns.replace(patterns.find("12 3 4"), 6, "99 3 4");
  Write("patterns.in", patterns);
  for (const auto& [file, message] :
       std::vector<std::pair<std::string, std::string>>{
           {"garbage.in", "garbage.in: line 1: expected the number of runs"},
           {"short.in", "short.in: line 14: expected the last 21 of the 41"},
           {"patterns.in", "patterns.in: line 11: 99 patterns are asked for"},
           {"no.in", "no.in: cannot be read"},
           {".", ".: cannot be read: Is a directory"}}) {
    const Outcome outcome = Run({"netcg", file, "--out", "o"});
    EXPECT_EQ(outcome.status, kUnusable) << file;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(NumFiles("o"), 0U);
  }
}

TEST_F(NetcgCommand, OverwritesNeitherWhatItReadsNorWhatItDidNotWrite) {
  CopyRun("case_c.in", "netcg.in");
  CopyRun("tiny.tab", "tiny.tab");
  const std::string patterns = Read("tiny.tab");
  std::filesystem::create_symlink(scratch_ / "tiny.tab",
                                  scratch_ / "graph_err.out");
  EXPECT_THAT(RefusalOf(Run({"netcg", "netcg.in"}), kUnusable),
              HasSubstr("graph_err.out would overwrite what is read"));
  EXPECT_EQ(Read("tiny.tab"), patterns);

  std::filesystem::create_directory(scratch_ / "o");
  Write("o/run.out", "mine");
  const std::vector<std::string> words{
      "netcg", "netcg.in", "--out", "o", "--quiet"};
  EXPECT_THAT(RefusalOf(Run(words), kWrongCommandLine),
              HasSubstr("o/run.out stands in the way"));
  EXPECT_EQ(Read("o/run.out"), "mine");
  std::vector<std::string> force = words;
  force.emplace_back("--force");
  EXPECT_EQ(Run(force).status, 0);
  EXPECT_EQ(Run(words).status, 0);
}

TEST_F(NetcgCommand, NeedsARunFileOrAStudy) {
  EXPECT_EQ(Run({"netcg"}).status, kWrongCommandLine);
  EXPECT_EQ(Run({"netcg", "a", "--study", "b"}).status, kWrongCommandLine);
  EXPECT_EQ(Run({"netcg", "a", "--precision", "half"}).status,
            kWrongCommandLine);
  EXPECT_THAT(Run({"netcg", "--help"}).out,
              HasSubstr("closed inside the loop over runs"));
}

TEST_F(NetcgCommand, StudiesASimulatedFolderAndConvertsItsFiles) {
  ASSERT_EQ(
      Run({"simulate", "turning-centre", "-o", "sim", "--days", "1"}).status,
      0);
  const Outcome table =
      Run({"netcg", "--study", "sim", "--iterations", "3", "--out", "study"});
  ASSERT_EQ(table.status, 0) << table.err;
  EXPECT_THAT(table.out,
              AllOf(HasSubstr("The nine experiments of NISTIR 5367"),
                    HasSubstr("CONVEX C3820"),
                    HasSubstr("4511.6")));
  EXPECT_EQ(Read("study/table4.txt"), table.out);
  const Json json = RunJson(
      {"netcg", "--study", "sim", "--iterations", "3", "--format", "json"});
  EXPECT_EQ(json["runs"].size(), 9U);
  EXPECT_EQ(json["runs"][3]["report"]["thermocouples_implied"], 8);

  ASSERT_EQ(Run({"convert", "sim/x_displacement_down.csv", "down.pat"}).status,
            0);
  ASSERT_EQ(Run({"convert", "down.pat", "down.csv"}).status, 0);
  ASSERT_EQ(Run({"convert", "down.csv", "again.pat"}).status, 0);
  EXPECT_EQ(Read("again.pat"), Read("down.pat"));
  Write("bad.pat", "2 3 1 1\n");
  const Outcome bad = Run({"convert", "bad.pat", "bad.csv"});
  EXPECT_EQ(bad.status, kUnusable);
  EXPECT_THAT(bad.err, HasSubstr("bad.pat: line 2: expected"));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "bad.csv"));
}

}  // namespace
}  // namespace errmap
