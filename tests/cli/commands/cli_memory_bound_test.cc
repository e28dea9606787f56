// Where memory is short, and how much a study takes.

#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/cli/cli_shell_fixture.h"

namespace errmap {
namespace {

using ::testing::HasSubstr;

class CliMemoryBound : public CliShell {};

TEST_F(CliMemoryBound, LimitedMemoryEndsWithALine) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "a sanitizer takes memory of its own";
#endif
  // With the least of these OpenBLAS's threads have no memory of their own.
  for (const char* kilobytes : {"100000", "200000", "300000"}) {
    EXPECT_THAT(RefusalOf(Shell(std::string("--version > out; ulimit -v ") +
                                kilobytes + "; timeout 120 '" +
                                tests::Binary() + "' compare " + kDown),
                          kFailure),
                HasSubstr("not enough memory"));
  }
}

TEST_F(CliMemoryBound, FoldsAreNotHeldAllAtOnce) {
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

}  // namespace
}  // namespace errmap
