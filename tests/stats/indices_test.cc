#include "stats/indices.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace errmap::stats {
namespace {

using Eigen::Index;

TEST(SpreadSample, TakesOneOfEachStretchAndBothEnds) {
  const std::vector<Index> places = SpreadSample(100'000, 5000);
  ASSERT_EQ(places.size(), 5000U);
  EXPECT_EQ(places.front(), 0);
  EXPECT_EQ(places.back(), 99'999);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(places[i] / 20, static_cast<Index>(i));
  }
  EXPECT_EQ(SpreadSample(100'000, 5000), places);
}

TEST(SpreadSample, FallsInStepWithNothing) {
  // Each fifth row is held out, each twentieth is of one position.
  const std::vector<Index> places = SpreadSample(100'000, 5000);
  for (const Index period : {2, 5, 20, 40}) {
    std::vector<Index> counts(static_cast<std::size_t>(period));
    for (const Index place : places) {
      ++counts[static_cast<std::size_t>(place % period)];
    }
    EXPECT_GT(*std::ranges::min_element(counts), 2500 / period) << period;
  }
}

TEST(SpreadSample, TakesAllOfFew) {
  EXPECT_TRUE(SpreadSample(0, 5).empty());
  EXPECT_EQ(SpreadSample(3, 5), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(SpreadSample(5, 5), (std::vector<Index>{0, 1, 2, 3, 4}));
  EXPECT_EQ(SpreadSample(5, 1), (std::vector<Index>{0}));
  EXPECT_EQ(SpreadSample(7, 2), (std::vector<Index>{0, 6}));
  EXPECT_EQ(SpreadSample(std::vector<Index>{4, 9, 2}, 2),
            (std::vector<Index>{4, 2}));
}

TEST(AllIndices, AreThoseFromZero) {
  EXPECT_EQ(AllIndices(3), (std::vector<Eigen::Index>{0, 1, 2}));
  EXPECT_TRUE(AllIndices(0).empty());
}

TEST(Renumber, LeavesNoGapsAndKeepsTheOrder) {
  std::vector<Index> codes = {7, 2, 7, 9, 2};
  EXPECT_EQ(Renumber(&codes), 3);
  EXPECT_EQ(codes, (std::vector<Index>{1, 0, 1, 2, 0}));
  codes.clear();
  EXPECT_EQ(Renumber(&codes), 0);
}

TEST(IndicesByCode, ListsEachCodeEvenThoseThatAreMissing) {
  EXPECT_EQ(IndicesByCode({2, 0, 2}),
            (std::vector<std::vector<Index>>{{1}, {}, {0, 2}}));
  EXPECT_TRUE(IndicesByCode({}).empty());
}

}  // namespace
}  // namespace errmap::stats
