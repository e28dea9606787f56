#include "cli/netcg/run_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/input_error.h"
#include "tests/cli/netcg/golden_runs.h"

namespace errmap::netcg {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string Lines(const std::string& text, int without) {
  std::istringstream stream(text);
  std::string kept;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    if (++number != without) kept += line + "\n";
  }
  return kept;
}

const std::string& Good() {
  static const std::string text =
      Process::TextOf(testing::RunPath("case_a.in"));
  return text;
}

TEST(RunFile, ReadsWhatAppendixAReads) {
  const auto runs = ParseRunFile(Good(), "netcg.in");
  ASSERT_EQ(runs.size(), 1U);
  const NetcgSpecification& run = runs.front();
  EXPECT_EQ(run.title, "case a raw inputs 40 hidden");
  EXPECT_EQ(run.file(NetcgFile::kPatterns), "train.pat");
  EXPECT_EQ(run.file(NetcgFile::kResiduals), "graph_res.out");
  EXPECT_EQ(run.line_of(NetcgFile::kReport), 3U);
  EXPECT_EQ(run.patterns, 397);
  EXPECT_EQ(run.num_weights(), 1561);
  EXPECT_EQ(run.wfactor, 1.3e-3);
  EXPECT_EQ(run.seed, 12345);
  EXPECT_EQ(run.iterations, 200);
  EXPECT_EQ(run.gwgoal, 1e-12);
  EXPECT_EQ(run.errdel, 1.0);
  ASSERT_EQ(run.uses_column.size(), 41U);
  EXPECT_FALSE(run.uses_column[4]);
  EXPECT_FALSE(run.uses_column[20]);
}

TEST(RunFile, ReadsBackWhatItWritesAndSeveralRuns) {
  auto runs = ParseRunFile(Good(), "netcg.in");
  runs.push_back(runs.front());
  runs.back().title = "it's the second";
  const std::string text = RunFileText(runs);
  const auto again = ParseRunFile(text, "netcg.in");
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again.back().title, "it's the second");
  EXPECT_EQ(again.back().uses_column, runs.front().uses_column);
  EXPECT_EQ(RunFileText(again), text);
}

TEST(RunFile, RefusesAFileThatLacksALine) {
  for (int line = 1; line <= 14; ++line) {
    EXPECT_THAT([&] { ParseRunFile(Lines(Good(), line), "netcg.in"); },
                ThrowsMessage<data::InputError>(HasSubstr("netcg.in: line ")))
        << line;
  }
  EXPECT_THAT([&] { ParseRunFile(Lines(Good(), 5), "netcg.in"); },
              ThrowsMessage<data::InputError>(
                  HasSubstr("line 10: expected the name of the residual "
                            "graphics file, found the number '397'")));
  EXPECT_THAT([&] { ParseRunFile(Lines(Good(), 14), "netcg.in"); },
              ThrowsMessage<data::InputError>(
                  HasSubstr("line 14: expected the last 21 of the 41 column "
                            "flags, but the file ends here")));
  EXPECT_THAT([&] { ParseRunFile(Good() + "1\n", "netcg.in"); },
              ThrowsMessage<data::InputError>(
                  HasSubstr("line 15: expected the end of the file")));
}

TEST(RunFile, RefusesNumbersOutOfRange) {
  const auto refusal = [](const std::string& from,
                          const std::string& to,
                          const std::string& message) {
    std::string text = Good();
    text.replace(text.find(from), from.size(), to);
    EXPECT_THAT([&] { ParseRunFile(text, "netcg.in"); },
                ThrowsMessage<data::InputError>(HasSubstr(message)));
  };
  refusal("397 37", "0 37", "line 11: the number of patterns must be 1 to");
  refusal("37 40 1 1.3", "37 99999999 1 1.3", "weights; at most 10000000");
  refusal("1.3e-3", "-1", "line 11: wfactor must be at least 0");
  refusal("200 1.0e-3 1.0e-12 1 1.0", "200 1 1 0 1", "line 12: the frequency");
  refusal("1 1.0\n", "1 0\n", "line 12: errdel must be above 0");
}

}  // namespace
}  // namespace errmap::netcg
