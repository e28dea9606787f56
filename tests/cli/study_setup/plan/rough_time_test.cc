#include <gtest/gtest.h>

#include "cli/study_setup/plan/study_forecast.h"

namespace errmap::study_setup {
namespace {

TEST(RoughTime, HasOneDigitAndTheUnitThatSuits) {
  EXPECT_EQ(RoughTimeText(0.3), "a second");
  EXPECT_EQ(RoughTimeText(7.4), "7 s");
  EXPECT_EQ(RoughTimeText(43.0), "40 s");
  EXPECT_EQ(RoughTimeText(300.0), "5 min");
  EXPECT_EQ(RoughTimeText(36000.0), "10 h");
}

}  // namespace
}  // namespace errmap::study_setup
