// What the program does when it is told to stop.

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_shell_fixture.h"

namespace errmap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliSignals : public CliShell {};

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

TEST_F(CliSignals, CtrlCIsAnsweredAtOnce) {
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

TEST_F(CliSignals, ASecondCtrlCEndsTheProgramAtOnce) {
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

TEST_F(CliSignals, SignalsIgnoredAtTheStartStayIgnored) {
  // A shell lets what it puts into the background ignore Ctrl-C.
  EXPECT_EQ(Background("compare " + kDown +
                           " --models mean,net:scg:iterations=300 --quiet",
                       "INT"),
            0);
  EXPECT_THAT(Read("out"), Not(HasSubstr("interrupted")));
}

TEST_F(CliSignals, ATerminalThatClosesLeavesThePartialReport) {
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

}  // namespace
}  // namespace errmap
