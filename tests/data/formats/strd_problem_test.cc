#include "data/formats/strd_problem.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/input_error.h"

namespace errmap::data {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const StrdProblem& Problem(const std::string& name) {
  const auto& all = StrdProblems();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const StrdProblem& problem) {
        return problem.name == name;
      });
  if (found == all.end()) throw std::invalid_argument(name);
  return *found;
}

TEST(StrdProblems, AreAllThere) {
  const auto count = [](StrdKind kind) {
    return std::count_if(StrdProblems().begin(),
                         StrdProblems().end(),
                         [&](const StrdProblem& p) { return p.kind == kind; });
  };
  EXPECT_EQ(count(StrdKind::kNonlinear), 27);
  EXPECT_EQ(count(StrdKind::kLinear), 11);
  EXPECT_EQ(count(StrdKind::kUnivariate), 9);
}

TEST(StrdProblems, HaveAsManyRowsAsTheirDegreesOfFreedomSay) {
  for (const StrdProblem& problem : StrdProblems()) {
    if (problem.kind == StrdKind::kUnivariate) continue;
    if (problem.name == "Rat43") continue;  // NIST prints 9 and uses 11
    EXPECT_EQ(problem.rows.size(),
              problem.parameters.size() +
                  static_cast<std::size_t>(problem.degrees_of_freedom))
        << problem.name;
  }
  EXPECT_EQ(Problem("PiDigits").rows.size(), 5000U);
  EXPECT_EQ(Problem("NumAcc4").rows.size(), 1001U);
}

TEST(StrdProblems, KeepNistsTextAndCorrectRoszman1) {
  EXPECT_EQ(Problem("Roszman1").parameters[0].certified, "2.0196866396E-01");
  EXPECT_EQ(Problem("Misra1a").parameters[1].start2, "0.0005");
  EXPECT_EQ(Problem("Filip").high_power, 10);
  EXPECT_EQ(Problem("Longley").columns.size(), 7U);
}

TEST(ParseStrdProblem, SaysWhereAFileIsWrong) {
  const auto message = [](const char* text, const char* expected) {
    EXPECT_THAT([&] { ParseStrdProblem(text, "X"); },
                ThrowsMessage<InputError>(HasSubstr(expected)));
  };
  message("set cubic X\n", "X: line 1: unknown kind 'cubic'");
  message("set linear X\nrss 1 2\n", "line 2: 'rss' takes 1 values, found 2");
  message("set linear X\ndof 1.5\n", "'1.5' is not a whole number");
  message("set linear X\nwhat 1\n", "unknown key 'what'");
  message("set linear X\ndata\n", "no line 'columns'");
  message("set linear X\ncolumns y x\ndata\n1\n", "2 values are needed");
  message("set linear X\ncolumns y x\ndata\n", "no data");
  message("set linear X\n", "no line 'data'");
}

}  // namespace
}  // namespace errmap::data
