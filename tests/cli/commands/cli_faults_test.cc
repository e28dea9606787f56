// What the program does where the machine or the user stands in its way: full
// disks, closed streams, outputs that are inputs, files without an end.

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class CliFaults : public Cli {
 protected:
  /// The program with words and redirections as a shell reads them; stdout is
  /// empty where `words` redirect it.
  Outcome Shell(const std::string& words) const {
    const std::string line = "cd '" + scratch_.path().string() + "' && '" +
                             tests::Binary() + "' " + words + " 2>.err";
    const int status = std::system(line.c_str());
    return {WEXITSTATUS(status), "", Read(".err")};
  }

  /// Status of the program in a shell's background, sent a signal after a
  /// second; its answer is in the file "out".
  int Background(const std::string& words, const std::string& signal) const {
    return Shell("--version > out; '" + tests::Binary() + "' " + words +
                 " > out & p=$!; sleep 1; kill -" + signal + " $p; wait $p")
        .status;
  }
};

TEST_F(CliFaults, AnswersThatCannotBePrintedAreSaidByEveryCommand) {
  WriteWithoutPosition("d.csv");
  Fit("poly:eq8", "m.json");
  const std::string compare =
      "compare " + kDown + " --models mean,poly:eq8 --quiet";
  ASSERT_EQ(Shell(compare + " --out study > /dev/null").status, 0);
  const std::vector<std::string> commands = {
      "--help",
      "--version",
      "compare --help",
      "__man",
      "__complete c",
      compare,
      compare + " --format csv",
      compare + " --format md",
      compare + " --format json",
      compare + " --dry-run",
      "init d.csv -o study.toml",
      "fit " + kDown + " --model mean -o mean.json --quiet",
      "fit " + kDown + " --model mean -o mean.json --quiet --format json",
      "predict m.json " + kDown + " --quiet",
      "evaluate m.json " + kDown + " --quiet",
      "evaluate m.json " + kDown + " --quiet --format json",
      "residuals " + kAppendixB + " --column residual_mm",
      "residuals " + kAppendixB + " --column residual_mm --format json",
      "report study --format md",
      "report study --format html",
      "certify gradients",
      "certify gradients --format json"};
  for (const std::string& command : commands) {
    SCOPED_TRACE(command);
    EXPECT_THAT(RefusalOf(Shell(command + " > /dev/full"), kFailure),
                AllOf(HasSubstr("cannot write to standard output"),
                      HasSubstr("No space left")));
  }
}

TEST_F(CliFaults, AnAnswerThatCannotBePrintedDoesNotCostTheFiles) {
  const std::string words =
      "compare " + kDown + " --models mean --quiet --out study > /dev/full";
  EXPECT_EQ(Shell(words).status, kFailure);
  EXPECT_TRUE(Exists("study/results.json"));
  EXPECT_TRUE(Exists("study/report.html"));
}

TEST_F(CliFaults, MessagesThatCannotBeWrittenChangeNothing) {
  const std::string command = "'" + tests::Binary() + "' ";
  const auto status_of = [&](const std::string& words) {
    const int status = std::system(
        ("cd '" + scratch_.path().string() + "' && " + command + words)
            .c_str());
    return WEXITSTATUS(status);
  };
  EXPECT_EQ(status_of("predict none.json none.csv 2>/dev/full"), kUnusable);
  EXPECT_EQ(status_of("compare " + kDown +
                      " --models mean --out study >/dev/null 2>/dev/full"),
            0);
}

TEST_F(CliFaults, MessagesNeverGoIntoFilesWhereStreamsAreClosed) {
  const std::string words =
      "compare " + kDown + " --models mean,poly:eq8 --out study";
  const std::string line = "cd '" + scratch_.path().string() + "' && '" +
                           tests::Binary() + "' " + words;
  // Standard output that is closed is an answer lost; what is asked for with
  // --out is whole.
  EXPECT_EQ(WEXITSTATUS(std::system((line + " <&- >&- 2>&-").c_str())),
            kFailure);
  for (const std::string& record : SplitLines(Read("study/journal.jsonl"))) {
    EXPECT_TRUE(record.starts_with("{\"sum\":")) << record;
  }
  EXPECT_TRUE(Exists("study/results.json"));
  const Outcome resumed = Shell(words + " --resume > /dev/null");
  EXPECT_EQ(resumed.status, 0);
  EXPECT_THAT(resumed.err, Not(HasSubstr("damaged")));
}

// ---- Outputs that are inputs, and files that errmap did not write.

TEST_F(CliFaults, OutputsThatAreInputsAreRefusedBeforeAnyWork) {
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
  // What is no input is replaced, as ever.
  Write("old.json", "old");
  EXPECT_EQ(Run({"fit", "x.csv", "--model", "mean", "-o", "old.json"}).status,
            0);
}

TEST_F(CliFaults, AnInputInTheOutputFolderIsNeverReplaced) {
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
    EXPECT_FALSE(Exists("journal.jsonl"));
  }
}

TEST_F(CliFaults, FilesInTheWayAreReplacedByForceOnly) {
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

TEST_F(CliFaults, ARunBrokenOffWhileItWritesMayBeRepeated) {
  const std::vector<std::string> compare{
      "compare", kDown, "--models", "mean", "--out", "study", "--quiet"};
  ASSERT_EQ(Run(compare).status, 0);
  Json list = Json::parse(Read("study/errmap-files.json"));
  for (Json& file : list["files"]) file["sha256"] = nullptr;
  Write("study/errmap-files.json", list.dump());
  Write("study/results.json", "of another run");
  EXPECT_EQ(Run(compare).status, 0);
}

TEST_F(CliFaults, SimulateKeepsWhatIsNotItsOwn) {
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

TEST_F(CliFaults, FiguresOfAReportKeepWhatIsNotTheirOwn) {
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

TEST_F(CliFaults, AnotherProgramsJournalIsLeftAlone) {
  std::filesystem::create_directory(scratch_ / "study");
  Write("study/journal.jsonl", "{\"mine\": 1}");
  for (const char* flag : {"--quiet", "--resume"}) {
    EXPECT_THAT(
        RefusalOf(
            Run({"compare", kDown, "--models", "mean", "--out", "study", flag}),
            kUnusable),
        HasSubstr("study/journal.jsonl: is no journal of errmap"));
    EXPECT_EQ(Read("study/journal.jsonl"), "{\"mine\": 1}");
  }
}

TEST_F(CliFaults, FilesWithoutAnEndAreRefusedByEveryReader) {
  WriteWithoutPosition("d.csv");
  ASSERT_EQ(mkfifo((scratch_ / "pipe").c_str(), 0600), 0);
  for (const std::string file : {"/dev/zero", "pipe"}) {
    const std::vector<std::string> commands = {
        "compare " + file,
        "compare d.csv --models file:" + file,
        "compare d.csv --models mean --split " + file,
        "compare d.csv --models mean --predictions p=" + file,
        "compare d.csv --models mean --holdout file:" + file,
        "compare --config " + file,
        "fit " + file + " --model mean -o m.json",
        "predict " + file + " d.csv",
        "evaluate " + file + " d.csv",
        "residuals " + file + " --column error_mm",
        "init " + file + " -o study.toml",
        "convert " + file + " out.csv",
        "netcg " + file};
    for (const std::string& command : commands) {
      SCOPED_TRACE(command);
      EXPECT_THAT(RefusalOf(Shell(command + " > out"), kUnusable),
                  AllOf(HasSubstr(file), HasSubstr("may never end")));
    }
  }
  EXPECT_EQ(Shell("__complete compare pipe --target e > out").status, 0);
  // What the shell holds open is a file like others.
  EXPECT_EQ(
      Shell("compare /dev/stdin --models mean --quiet > out < d.csv").status,
      0);
}

TEST_F(CliFaults, APipeThatNeverEndsIsReadToABound) {
  const std::string never = "yes 'seed = 1' | '" + tests::Binary() + "' ";
  EXPECT_THAT(RefusalOf(Shell("--version > out; " + never +
                              "compare --config /dev/stdin"),
                        kUnusable),
              HasSubstr("/dev/stdin: is longer than 4 MiB"));
}

TEST_F(CliFaults, AFolderWithAPipeForAJournalIsRefused) {
  std::filesystem::create_directory(scratch_ / "study");
  ASSERT_EQ(mkfifo((scratch_ / "study/journal.jsonl").c_str(), 0600), 0);
  for (const char* flag : {"--quiet", "--resume", "--force"}) {
    EXPECT_THAT(
        RefusalOf(
            Run({"compare", kDown, "--models", "mean", "--out", "study", flag}),
            kUnusable),
        HasSubstr("study/journal.jsonl: is no plain file"));
  }
}

TEST_F(CliFaults, DeepNestingIsRefusedByEveryReader) {
  WriteWithoutPosition("d.csv");
  std::filesystem::create_directory(scratch_ / "study");
  constexpr int kDepth = 300'000;
  const std::string deep(kDepth, '[');
  const std::string shut(kDepth, ']');
  Write("m.json", deep + shut);
  Write("study/results.json", deep + shut);
  Write("study/errmap-files.json", deep + shut);
  std::string key = "a";
  for (int i = 0; i < kDepth; ++i) key += ".a";
  Write("value.toml", key + " = 1\n");
  Write("table.toml", "seed = 1\n[" + key + "]\n");
  Write("array.toml", "seed = " + deep + shut + "\n");
  struct Case {
    std::vector<std::string> words;
    int status;
    const char* says;
  };
  const std::vector<Case> cases = {
      {{"predict", "m.json", "d.csv"}, kUnusable, "m.json: is nested deeper"},
      {{"report", "study"}, kUnusable, "results.json: is nested deeper"},
      {{"compare", "d.csv", "--models", "mean", "--out", "study"},
       kWrongCommandLine,
       "errmap-files.json is not errmap's list"},
      {{"compare", "--config", "value.toml"},
       kUnusable,
       "value.toml: line 1: a key of more than 64 parts"},
      {{"compare", "--config", "table.toml"},
       kUnusable,
       "table.toml: line 2: a key of more than 64 parts"},
      {{"compare", "--config", "array.toml"}, kUnusable, "array.toml"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(::testing::PrintToString(c.words));
    EXPECT_THAT(RefusalOf(Run(c.words), c.status), HasSubstr(c.says));
  }
  Write("study.toml", "seed = 1\n");
  constexpr std::size_t kShort = 20'000;  // a command line's word has a limit
  EXPECT_THAT(RefusalOf(Run({"compare",
                             "--config",
                             "study.toml",
                             "--set",
                             key.substr(0, kShort) + "b=1"}),
                        kWrongCommandLine),
              HasSubstr("a key of more than 64 parts"));
}

// The parser of TOML holds that there is none.
TEST_F(CliFaults, NulBytesInStudyFilesAreRefusedWithTheirLine) {
  using std::string_literals::operator""s;
  Write("study.toml", "seed = 1\n[\0\0omponent]]\n"s);
  EXPECT_THAT(RefusalOf(Run({"compare", "--config", "study.toml"}), kUnusable),
              HasSubstr("study.toml: line 2: a NUL byte"));
}

TEST_F(CliFaults, FoldersThatCannotBeMadeAreSaidInOneLine) {
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

// Warm-up cycles of 20 stops: numbers without a law.
std::string RandomData(int rows, int sensors) {
  std::string text = "cycle,position_mm";
  for (int j = 0; j < sensors; ++j) text += ",t" + std::to_string(j) + "_degC";
  text += ",error_mm\n";
  unsigned state = 1;
  const auto random = [&] {
    state = state * 1664525U + 1013904223U;
    return std::to_string(state >> 16U);
  };
  for (int i = 0; i < rows; ++i) {
    text += std::to_string(i / 20) + "," + std::to_string(i % 20);
    for (int j = 0; j <= sensors; ++j) text += "," + random();
    text += "\n";
  }
  return text;
}

TEST_F(CliFaults, CtrlCIsAnsweredAtOnce) {
  Write("many.csv", RandomData(400, 60));
  Write("long.csv", RandomData(30'000, 20));
  const std::vector<std::vector<std::string>> commands = {
      {"fit", kDown, "--model", "net:scg:starts=10000", "-o", "m.json"},
      {"fit",
       kDown,
       "--model",
       "net:scg:starts=10000:choose=cv",
       "-o",
       "m.json"},
      {"compare", kDown, "--models", "net:scg:starts=10000"},
      {"fit", "many.csv", "--model", "poly:stepwise:degree=3", "-o", "m.json"},
      {"compare", "many.csv", "--models", "poly:stepwise:degree=3"},
      // One iteration has a product of 30,000 x 1381 by itself.
      {"fit", "long.csv", "--model", "net:lm:hidden=60", "-o", "m.json"},
      {"compare", "long.csv"}};
  for (const std::vector<std::string>& words : commands) {
    SCOPED_TRACE(::testing::PrintToString(words));
    Process process(scratch_.path(), words);
    ASSERT_TRUE(process.WaitUntilInterruptible());
    // Into the midst of the work, however busy the machine is.
    constexpr int kMostPolls = 5000;
    for (int i = 0; i < kMostPolls && process.CpuSeconds() < 1.2; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const double before = process.CpuSeconds();
    process.Interrupt();
    EXPECT_EQ(process.Wait().status, kInterrupted);
    // On two threads half a second or less; five to thirty before.
    EXPECT_LT(process.CpuSeconds() - before, 1.5);
  }
}

TEST_F(CliFaults, ASecondCtrlCEndsTheProgramAtOnce) {
  // It would show what it has for some tenths of a second.
  Write("long.csv", RandomData(30'000, 20));
  Process process(scratch_.path(), {"compare", "long.csv", "--out", "study"});
  ASSERT_TRUE(process.WaitUntilInterruptible());
  process.Interrupt();
  ASSERT_TRUE(process.WaitUntilInterrupted());
  process.Interrupt();
  EXPECT_EQ(process.Wait().status, 128 + SIGINT);
  EXPECT_FALSE(Exists("study/results.json"));
}

TEST_F(CliFaults, SignalsIgnoredAtTheStartStayIgnored) {
  // A shell lets what it puts into the background ignore Ctrl-C.
  EXPECT_EQ(Background("compare " + kDown +
                           " --models mean,net:scg:iterations=300 --quiet",
                       "INT"),
            0);
  EXPECT_THAT(Read("out"), Not(HasSubstr("interrupted")));
}

TEST_F(CliFaults, ATerminalThatClosesLeavesThePartialReport) {
  for (const char* signal : {"HUP", "TERM"}) {
    EXPECT_EQ(Background("compare " + kDown +
                             " --models mean,net:scg:starts=10000 --jobs 1 "
                             "--quiet --out study",
                         signal),
              kInterrupted);
    EXPECT_TRUE(Exists("study/report.md"));
    std::filesystem::remove_all(scratch_ / "study");
  }
}

TEST_F(CliFaults, LimitedMemoryEndsWithALine) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "a sanitizer takes memory of its own";
#endif
  EXPECT_THAT(RefusalOf(Shell("--version > out; ulimit -v 300000; '" +
                              tests::Binary() + "' compare " + kDown),
                        kFailure),
              HasSubstr("not enough memory"));
}

TEST_F(CliFaults, FoldsAreNotHeldAllAtOnce) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "a sanitizer takes memory of its own";
#endif
  // 3,000 rows of 41 columns in 300 cycles: held out one by one, their training
  // rows would be 300 times the data, 300 MB.
  constexpr int kRows = 3000;
  std::string text = "cycle,position_mm";
  for (int j = 0; j < 39; ++j) text += ",t" + std::to_string(j) + "_degC";
  text += ",error_mm\n";
  for (int i = 0; i < kRows; ++i) {
    text += std::to_string(i / 10) + "," + std::to_string(i % 10);
    for (int j = 0; j < 40; ++j)
      text += "," + std::to_string((i * (j + 3)) % 97);
    text += "\n";
  }
  Write("many.csv", text);
  // In a process of its own, whose only child it is.
  const auto most_kilobytes = [&] {
    const int status = Run({"compare",
                            "many.csv",
                            "--models",
                            "mean",
                            "--holdout",
                            "leave-one-group-out",
                            "--quiet"})
                           .status;
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    constexpr long kMostKilobytes = 150'000;
    std::_Exit(status != 0 ? 2 : usage.ru_maxrss > kMostKilobytes ? 1 : 0);
  };
  EXPECT_EXIT(most_kilobytes(), ::testing::ExitedWithCode(0), "");
}

TEST_F(CliFaults, AbsolutePathsStayOutOfWhatIsHandedOn) {
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

TEST_F(CliFaults, NothingThatIsReadCommandsTheTerminal) {
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
      {"fit", "d.csv", "--model", "poly:full:degree=1", "-o", "m.json"},
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
    for (const std::string& line : SplitLines(outcome.err)) {
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
