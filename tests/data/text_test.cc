#include "data/text.h"

#include <gtest/gtest.h>

namespace errmap::data {
namespace {

TEST(JoinWords, HasWhatIsBetweenBetweenWordsAlone) {
  EXPECT_EQ(JoinWords({}, ", "), "");
  EXPECT_EQ(JoinWords({"x"}, ", "), "x");
  EXPECT_EQ(JoinWords({"x", "y", "z"}, ", "), "x, y, z");
  EXPECT_EQ(JoinWords({"x", "x", ""}, "+"), "x+x+");
}

TEST(EndsWithIgnoringCase, TakesLettersOfAnyCaseButNoLongerEnding) {
  EXPECT_TRUE(EndsWithIgnoringCase("DAY1.CSV", ".csv"));
  EXPECT_FALSE(EndsWithIgnoringCase("csv", ".csv"));
  EXPECT_FALSE(EndsWithIgnoringCase(".csv.gz", ".csv"));
}

TEST(CountText, IsOfOneOrOfSeveral) {
  EXPECT_EQ(CountText(1, "row"), "1 row");
  EXPECT_EQ(CountText(0, "row"), "0 rows");
}

TEST(NearestName, IsAFewLettersOffAndNeverAnotherWord) {
  EXPECT_EQ(NearestName("tempratur", {"position", "temperature"}),
            "temperature");
  EXPECT_EQ(NearestName("TEMPERATURE", {"temperature"}), "temperature");
  EXPECT_EQ(NearestName("t1", {"ab", "x"}), "");
}

}  // namespace
}  // namespace errmap::data
