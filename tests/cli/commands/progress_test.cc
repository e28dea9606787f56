#include "cli/commands/progress.h"

#include <gtest/gtest.h>

#include "cli/study_file/rough_time.h"

namespace errmap::cli {
namespace {

TEST(Progress, TellsFitsDoneTimeAndTimeLeft) {
  EXPECT_EQ(ProgressText({.done = 50, .all = 200, .seconds = 100.0}),
            "50/200 fits, 100.0 s, about 5 min left");
}

TEST(Progress, GuessesNoTimeLeftFromTheFirstFewFits) {
  EXPECT_EQ(ProgressText({.done = 9, .all = 200, .seconds = 1.0}),
            "9/200 fits, 1.0 s");
}

TEST(Progress, HasNothingLeftAtTheEnd) {
  EXPECT_EQ(ProgressText({.done = 2, .all = 2, .seconds = 0.25}),
            "2/2 fits, 0.2 s");
}

TEST(RoughTime, HasOneDigitAndTheUnitThatSuits) {
  EXPECT_EQ(RoughTimeText(0.3), "a second");
  EXPECT_EQ(RoughTimeText(7.4), "7 s");
  EXPECT_EQ(RoughTimeText(43.0), "40 s");
  EXPECT_EQ(RoughTimeText(300.0), "5 min");
  EXPECT_EQ(RoughTimeText(36000.0), "10 h");
}

}  // namespace
}  // namespace errmap::cli
