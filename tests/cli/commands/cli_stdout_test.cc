// Where an answer or a message cannot be written: full disks, closed streams.

#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "tests/cli/cli_shell_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class CliStdout : public CliShell {};

TEST_F(CliStdout, AnswersThatCannotBePrintedAreSaidByEveryCommand) {
  WriteWithoutPosition("d.csv");
  Fit("poly:eq8", "m.json");
  const std::string compare =
      "compare " + kDown + " --models mean,poly:eq8 --quiet";
  ASSERT_EQ(Shell(compare + " --out study > /dev/null").status, 0);
  const std::vector<std::string> commands = {
      "--help",
      "--version",
      "compare --help",
      "__reference",
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

TEST_F(CliStdout, ADashIsStandardInput) {
  EXPECT_EQ(Shell("read " + kDown + " > named").status, 0);
  EXPECT_EQ(Shell("read - > piped < " + kDown).status, 0);
  EXPECT_EQ(Read("piped"), Read("named"));
  EXPECT_THAT(RefusalOf(Shell("fit " + kDown + " --model mean -o -"),
                        kWrongCommandLine),
              HasSubstr("names no file"));
}

TEST_F(CliStdout, AnAnswerThatCannotBePrintedDoesNotCostTheFiles) {
  const std::string words =
      "compare " + kDown + " --models mean --quiet --out study > /dev/full";
  EXPECT_EQ(Shell(words).status, kFailure);
  EXPECT_TRUE(Exists("study/results.json"));
  EXPECT_TRUE(Exists("study/report.html"));
}

TEST_F(CliStdout, MessagesThatCannotBeWrittenChangeNothing) {
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

TEST_F(CliStdout, MessagesNeverGoIntoFilesWhereStreamsAreClosed) {
  const std::string words =
      "compare " + kDown + " --models mean,poly:eq8 --out study";
  const std::string line = "cd '" + scratch_.path().string() + "' && '" +
                           tests::Binary() + "' " + words;
  // Standard output that is closed is an answer lost; what is asked for with
  // --out is whole.
  EXPECT_EQ(WEXITSTATUS(std::system((line + " <&- >&- 2>&-").c_str())),
            kFailure);
  EXPECT_TRUE(Read("study/fits.sqlite").starts_with("SQLite format 3"));
  EXPECT_TRUE(Exists("study/results.json"));
  const Outcome resumed = Shell(words + " --resume > /dev/null");
  EXPECT_EQ(resumed.status, 0);
  EXPECT_THAT(resumed.err, Not(HasSubstr("damaged")));
}

}  // namespace
}  // namespace errmap
