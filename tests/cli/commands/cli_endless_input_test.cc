// Inputs without an end: devices, pipes, nesting.

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/cli/cli_shell_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class CliEndlessInput : public CliShell {};

TEST_F(CliEndlessInput, FilesWithoutAnEndAreRefusedByEveryReader) {
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

TEST_F(CliEndlessInput, APipeThatNeverEndsIsReadToABound) {
  const std::string never = "yes 'seed = 1' | '" + tests::Binary() + "' ";
  EXPECT_THAT(RefusalOf(Shell("--version > out; " + never +
                              "compare --config /dev/stdin"),
                        kUnusable),
              HasSubstr("/dev/stdin: is longer than 4 MiB"));
}

TEST_F(CliEndlessInput, AFolderWithAPipeForItsFitsIsRefused) {
  std::filesystem::create_directory(scratch_ / "study");
  ASSERT_EQ(mkfifo((scratch_ / "study/fits.sqlite").c_str(), 0600), 0);
  for (const char* flag : {"--quiet", "--resume", "--force"}) {
    EXPECT_THAT(
        RefusalOf(
            Run({"compare", kDown, "--models", "mean", "--out", "study", flag}),
            kUnusable),
        HasSubstr("study/fits.sqlite: is not a plain file"));
  }
}

TEST_F(CliEndlessInput, DeepNestingIsRefusedByEveryReader) {
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
TEST_F(CliEndlessInput, NulBytesInStudyFilesAreRefusedWithTheirLine) {
  using std::string_literals::operator""s;
  Write("study.toml", "seed = 1\n[\0\0omponent]]\n"s);
  EXPECT_THAT(RefusalOf(Run({"compare", "--config", "study.toml"}), kUnusable),
              HasSubstr("study.toml: line 2: a NUL byte"));
}

}  // namespace
}  // namespace errmap
