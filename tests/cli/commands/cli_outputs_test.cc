// Outputs that are inputs, files that errmap did not write, folders that cannot
// be made.

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/both_ways.h"
#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class CliOutputs : public Cli {};

TEST_F(CliOutputs, OutputsThatAreInputsAreRefusedBeforeAnyWork) {
  const std::string data = Process::TextOf(kDown);
  Write("x.csv", data);
  Write("p.csv", "row,predicted\n");
  Fit("poly:eq8", "m.json");
  const std::string map = Read("m.json");
  std::filesystem::create_symlink(scratch_ / "x.csv", scratch_ / "link.csv");
  std::filesystem::create_hard_link(scratch_ / "x.csv", scratch_ / "hard.csv");
  const std::vector<std::vector<std::string>> commands = {
      {"fit", "x.csv", "--model", "mean", "-o", "x.csv"},
      {"fit", "x.csv", "--model", "mean", "-o", "./link.csv"},
      {"fit", "link.csv", "--model", "mean", "-o", "hard.csv"},
      {"fit", "x.csv", "--model", "file:m.json", "-o", "m.json"},
      {"predict", "m.json", "x.csv", "-o", "x.csv"},
      {"predict", "m.json", "x.csv", "-o", "link.csv"},
      {"predict", "m.json", "x.csv", "-o", "m.json"},
      {"predict", "m.json", kDown, "--after", "x.csv", "-o", "x.csv"},
      {"compare", "x.csv", "--models", "mean", "--save-split", "link.csv"},
      {"compare",
       kDown,
       "--models",
       "mean,file:m.json",
       "--save-split",
       "m.json"},
      {"compare",
       kDown,
       "--models",
       "mean",
       "--holdout",
       "file:x.csv",
       "--quiet",
       "--save-split",
       "x.csv"},
      {"init", "x.csv", "-o", "hard.csv", "--force"},
      {"convert", "x.csv", "x.csv"}};
  for (const std::vector<std::string>& words : commands) {
    SCOPED_TRACE(::testing::PrintToString(words));
    EXPECT_THAT(
        RefusalOf(Run(words), kWrongCommandLine),
        AllOf(HasSubstr(words.back() == "--force" ? "hard.csv" : words.back()),
              HasSubstr("would overwrite")));
    EXPECT_EQ(Read("x.csv"), data);
    EXPECT_EQ(Read("m.json"), map);
  }
  // What is not an input is replaced, as ever.
  Write("old.json", "old");
  EXPECT_EQ(Run({"fit", "x.csv", "--model", "mean", "-o", "old.json"}).status,
            0);
}

TEST_F(CliOutputs, ADashNamesNoFile) {
  Fit("mean", "m.json");
  const std::vector<std::vector<std::string>> commands = {
      {"compare", kDown, "--models", "mean", "-o", "-"},
      {"compare", kDown, "--models", "mean", "--save-split", "-"},
      {"fit", kDown, "--model", "mean", "-o", "-"},
      {"predict", "m.json", kDown, "-o", "-"},
      {"init", kDown, "-o", "-"},
      {"convert", kDown, "-"},
      {"iso230", kDown, "--figure", "-"}};
  for (const std::vector<std::string>& words : commands) {
    SCOPED_TRACE(::testing::PrintToString(words));
    EXPECT_THAT(RefusalOf(Run(words), kWrongCommandLine),
                HasSubstr(": - names no file; name one"));
  }
  EXPECT_FALSE(Exists("-"));
}

TEST_F(CliOutputs, FitsThatAreRefusedLeaveNoFolder) {
  Write("ways.csv", RowsOfBothWays());
  EXPECT_THAT(RefusalOf(Run({"fit",
                             "ways.csv",
                             "--model",
                             "mean",
                             "-o",
                             "maps/",
                             "--format",
                             "json"}),
                        kWrongCommandLine),
              HasSubstr("describes one map"));
  EXPECT_FALSE(Exists("maps"));
}

// Found out after hours of fits it would cost the page.
TEST_F(CliOutputs, PlacesThatCannotBeWrittenToAreRefusedBeforeAnyWork) {
  std::filesystem::create_directory(scratch_ / "folder.html");
  Fit("mean", "m.json");
  Write("file", "mine");
  for (const std::string place :
       {"none/out.html", "folder.html", "file/out.html"}) {
    const std::vector<std::vector<std::string>> commands = {
        {"compare", kDown, "--models", "mean", "-o", place},
        {"compare", kDown, "--models", "mean", "--save-split", place},
        {"fit", kDown, "--model", "mean", "-o", place},
        {"update", "m.json", kDown, "-o", place}};
    for (const std::vector<std::string>& words : commands) {
      // fit writes a map for each way along the axis into a folder.
      if (words[0] == "fit" && place == "folder.html") continue;
      SCOPED_TRACE(::testing::PrintToString(words));
      EXPECT_THAT(RefusalOf(Run(words), kFailure),
                  HasSubstr("cannot write " + place + ": "));
    }
  }
  EXPECT_EQ(Read("file"), "mine");
  EXPECT_FALSE(Exists("none"));
}

TEST_F(CliOutputs, AnInputInTheOutputFolderIsNeverReplaced) {
  const std::string data = Process::TextOf(kDown);
  Write("residuals.csv", data);
  for (const char* flag : {"--quiet", "--force"}) {
    EXPECT_THAT(RefusalOf(Run({"compare",
                               "residuals.csv",
                               "--models",
                               "mean",
                               "--out",
                               ".",
                               flag}),
                          kWrongCommandLine),
                HasSubstr("residuals.csv would overwrite"));
    EXPECT_EQ(Read("residuals.csv"), data);
    EXPECT_FALSE(Exists("results.json"));
    EXPECT_FALSE(Exists("fits.sqlite"));
  }
}

TEST_F(CliOutputs, FilesInTheWayAreReplacedByForceOnly) {
  const std::vector<std::string> compare{
      "compare", kDown, "--models", "mean,poly:eq8", "--out", "study"};
  std::vector<std::string> force = compare;
  force.emplace_back("--force");
  std::filesystem::create_directory(scratch_ / "study");
  Write("study/report.md", "mine");
  EXPECT_THAT(RefusalOf(Run(compare), kWrongCommandLine),
              AllOf(HasSubstr("study/report.md"), HasSubstr("--force")));
  EXPECT_EQ(Read("study/report.md"), "mine");
  EXPECT_EQ(Run(force).status, 0);
  EXPECT_THAT(Read("study/report.md"), HasSubstr("poly:eq8"));

  // What errmap wrote, it replaces; what was changed since, it does not.
  const Json list = Json::parse(Read("study/errmap-files.json"));
  EXPECT_EQ(list["schema"], "errmap-files-1");
  std::vector<std::string> names;
  for (const Json& file : list["files"]) {
    names.push_back(file["name"]);
    EXPECT_EQ(file["sha256"].get<std::string>().size(), 64U);
  }
  EXPECT_THAT(names,
              ::testing::ElementsAre("models/mean.json",
                                     "models/poly_eq8.json",
                                     "models/poly_position.json",
                                     "models/poly_temperature.json",
                                     "models/zero.json",
                                     "report.html",
                                     "report.md",
                                     "residuals.csv",
                                     "results.json"));
  EXPECT_EQ(Run(compare).status, 0);
  EXPECT_EQ(Run({"report", "study"}).status, 0);
  Write("study/report.md", Read("study/report.md") + "my remark\n");
  EXPECT_THAT(RefusalOf(Run(compare), kWrongCommandLine),
              HasSubstr("study/report.md"));
  EXPECT_THAT(RefusalOf(Run({"report", "study"}), kWrongCommandLine),
              HasSubstr("study/report.md"));
  EXPECT_THAT(Read("study/report.md"), HasSubstr("my remark"));
  EXPECT_EQ(Run({"report", "study", "--force"}).status, 0);
  EXPECT_THAT(Read("study/report.md"), Not(HasSubstr("my remark")));
  EXPECT_EQ(Run(compare).status, 0);

  // A list of somebody else's making.
  Write("study/errmap-files.json", "[]");
  EXPECT_THAT(RefusalOf(Run(compare), kWrongCommandLine),
              HasSubstr("errmap-files.json"));
}

TEST_F(CliOutputs, AReportOfAResultThatWasChangedByHandSaysSo) {
  ASSERT_EQ(Run({"compare",
                 kDown,
                 "--models",
                 "mean,poly:eq8",
                 "--out",
                 "study",
                 "--quiet"})
                .status,
            0);
  EXPECT_THAT(Run({"report", "study"}).err, Not(HasSubstr("warning")));
  Json results = Json::parse(Read("study/results.json"));
  Json& rmse = results["components"][0]["models"][1]["results"]["groups:5"]
                      ["test"]["rmse"];
  rmse = 0.1 * rmse.get<double>();
  Write("study/results.json", results.dump(1));
  const Outcome changed = Run({"report", "study", "--force"});
  EXPECT_EQ(changed.status, 0);
  EXPECT_THAT(changed.err, HasSubstr("was changed after errmap wrote it"));
  EXPECT_THAT(Read("study/report.html"), HasSubstr("was changed after errmap"));
  EXPECT_THAT(Read("study/report.md"), HasSubstr("was changed after errmap"));
  results["provenance"].erase("content_sha256");
  Write("study/results.json", results.dump(1));
  EXPECT_THAT(Run({"report", "study", "--force"}).err,
              HasSubstr("has no hash"));
}

// It was written for a single study only, and not at all here, with status 0.
TEST_F(CliOutputs, OnePageOfManyComponentsIsRefused) {
  std::filesystem::create_directory(scratch_ / "in");
  Write("in/a.csv", Process::TextOf(kDown));
  Write("in/b.csv", Process::TextOf(kDown));
  Write("study.toml",
        "[[component]]\nname = \"{machine}\"\ndata = \"in/{machine}.csv\"\n");
  EXPECT_THAT(RefusalOf(Run({"compare",
                             "--config",
                             "study.toml",
                             "--out",
                             "store",
                             "-o",
                             "page.html"}),
                        kWrongCommandLine),
              HasSubstr("-o writes the page of one component"));
}

TEST_F(CliOutputs, MoreJobsThanCoresAreTakenWithoutAWord) {
  const std::string jobs =
      std::to_string(std::thread::hardware_concurrency() + 1);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{
            "compare", kDown, "--models", "mean,poly:eq8,net:scg:iterations=5"},
        {"learn", kDown, "--by", "cycles"}}) {
    std::vector<std::string> with_jobs = words;
    with_jobs.insert(with_jobs.end(), {"--jobs", jobs, "--quiet"});
    const Outcome outcome = Run(with_jobs);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, Not(HasSubstr("TBB")));
  }
}

TEST_F(CliOutputs, ARunBrokenOffWhileItWritesMayBeRepeated) {
  const std::vector<std::string> compare{
      "compare", kDown, "--models", "mean", "--out", "study", "--quiet"};
  ASSERT_EQ(Run(compare).status, 0);
  Json list = Json::parse(Read("study/errmap-files.json"));
  for (Json& file : list["files"]) file["sha256"] = nullptr;
  Write("study/errmap-files.json", list.dump());
  Write("study/results.json", "of another run");
  EXPECT_EQ(Run(compare).status, 0);
}

TEST_F(CliOutputs, SimulateKeepsWhatIsNotItsOwn) {
  const std::vector<std::string> simulate{
      "simulate", "turning-centre", "-o", ".", "--cycles", "3", "--quiet"};
  Write("README.md", "my project");
  EXPECT_THAT(RefusalOf(Run(simulate), kWrongCommandLine),
              HasSubstr("README.md"));
  EXPECT_EQ(Read("README.md"), "my project");
  EXPECT_FALSE(Exists("machine.toml"));
  std::filesystem::remove(scratch_ / "README.md");
  EXPECT_EQ(Run(simulate).status, 0);
  EXPECT_EQ(Run(simulate).status, 0);
  Write("machine.toml", "name = \"mine\"\n");
  EXPECT_THAT(RefusalOf(Run(simulate), kWrongCommandLine),
              HasSubstr("machine.toml"));
}

TEST_F(CliOutputs, FiguresOfAReportKeepWhatIsNotTheirOwn) {
  ASSERT_EQ(
      Run({"compare", kDown, "--models", "mean,poly:eq8", "--out", "study"})
          .status,
      0);
  const std::vector<std::string> report{"report", "study", "--figures", "f"};
  ASSERT_EQ(Run(report).status, 0);
  EXPECT_EQ(Run(report).status, 0);
  const Json list = Json::parse(Read("f/errmap-files.json"));
  const std::string name = list["files"][0]["name"];
  Write("f/" + name, "mine");
  EXPECT_THAT(RefusalOf(Run(report), kWrongCommandLine), HasSubstr(name));
  EXPECT_EQ(Read("f/" + name), "mine");
}

TEST_F(CliOutputs, AnotherProgramsFitsAreLeftAlone) {
  std::filesystem::create_directory(scratch_ / "study");
  Write("study/fits.sqlite", "{\"mine\": 1}");
  for (const char* flag : {"--quiet", "--resume"}) {
    EXPECT_THAT(
        RefusalOf(
            Run({"compare", kDown, "--models", "mean", "--out", "study", flag}),
            kUnusable),
        HasSubstr("study/fits.sqlite: holds no fits of errmap"));
    EXPECT_EQ(Read("study/fits.sqlite"), "{\"mine\": 1}");
  }
}

TEST_F(CliOutputs, FoldersThatCannotBeMadeAreSaidInOneLine) {
  Write("file", "");
  const std::vector<std::vector<std::string>> commands = {
      {"compare", kDown, "--models", "mean", "--quiet", "--out", "file/study"},
      {"simulate", "turning-centre", "-o", "/proc/none/study"},
      {"netcg", "--study", ".", "--out", "file/study"}};
  for (const std::vector<std::string>& words : commands) {
    SCOPED_TRACE(::testing::PrintToString(words));
    EXPECT_THAT(RefusalOf(Run(words), kFailure),
                AllOf(HasSubstr("cannot write into the folder"),
                      HasSubstr(words[words.size() - 1]),
                      Not(HasSubstr("filesystem error"))));
  }
}

}  // namespace
}  // namespace errmap
