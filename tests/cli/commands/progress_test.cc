#include "cli/commands/progress.h"

#include <gtest/gtest.h>

namespace errmap::cli {
namespace {

constexpr std::size_t kWide = 200;

TEST(Progress, TellsFitsDoneTimeTimeLeftAndTheBestSoFar) {
  const ProgressState state{.done = 50,
                            .all = 200,
                            .seconds = 100.0,
                            .left = 420.0,
                            .best = "poly:eq8 1.90 um",
                            .holdout = "groups:5"};
  EXPECT_EQ(ProgressText(state, kWide),
            "50/200 fits, 100.0 s, about 7 min left, best so far poly:eq8 1.90 "
            "um (groups:5)");
  // What matters less is left out where there is no room.
  EXPECT_EQ(ProgressText(state, 75),
            "50/200 fits, 100.0 s, about 7 min left, best so far poly:eq8 1.90 "
            "um");
  EXPECT_EQ(ProgressText(state, 66),
            "50/200 fits, 7 min left, best so far poly:eq8 1.90 um");
  EXPECT_EQ(ProgressText(state, 40), "50/200 fits, 100.0 s, about 7 min left");
}

TEST(Progress, TakesTheFitsToBeAlikeWhereNothingWasLearnt) {
  EXPECT_EQ(ProgressText({.done = 50, .all = 200, .seconds = 100.0}, kWide),
            "50/200 fits, 100.0 s, about 5 min left");
  // The first few tell nothing.
  EXPECT_EQ(ProgressText({.done = 9, .all = 200, .seconds = 1.0}, kWide),
            "9/200 fits, 1.0 s");
}

TEST(Progress, SaysWhatItCounts) {
  EXPECT_EQ(
      ProgressText(
          {.done = 10, .all = 10, .seconds = 1.0, .what = "components"}, kWide),
      "10/10 components, 1.0 s");
}

TEST(Progress, HasNothingLeftAtTheEnd) {
  EXPECT_EQ(
      ProgressText({.done = 2, .all = 2, .seconds = 0.25, .left = 0.0}, kWide),
      "2/2 fits, 0.2 s");
}

}  // namespace
}  // namespace errmap::cli
