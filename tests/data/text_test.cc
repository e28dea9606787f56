#include "data/text.h"

#include <gtest/gtest.h>

namespace errmap::data {
namespace {

TEST(Joined, HasWhatIsBetweenBetweenWordsAlone) {
  EXPECT_EQ(Joined({}, ", "), "");
  EXPECT_EQ(Joined({"x"}, ", "), "x");
  EXPECT_EQ(Joined({"x", "y", "z"}, ", "), "x, y, z");
  EXPECT_EQ(Joined({"x", "x", ""}, "+"), "x+x+");
}

TEST(NearestName, IsAFewLettersOffAndNeverAnotherWord) {
  EXPECT_EQ(NearestName("tempratur", {"position", "temperature"}),
            "temperature");
  EXPECT_EQ(NearestName("TEMPERATURE", {"temperature"}), "temperature");
  EXPECT_EQ(NearestName("t1", {"ab", "x"}), "");
}

}  // namespace
}  // namespace errmap::data
