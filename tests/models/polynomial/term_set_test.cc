#include "models/polynomial/term_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::models {
namespace {

using ::testing::ElementsAre;

const std::vector<bool> kPositionAndTwo = {true, false, false};

TEST(TermSet, LinearHasEveryInputOnce) {
  EXPECT_THAT(
      MakeTerms(TermSet::kLinear, kPositionAndTwo, 3),
      ElementsAre(
          ElementsAre(1, 0, 0), ElementsAre(0, 1, 0), ElementsAre(0, 0, 1)));
}

TEST(TermSet, SquaresHavePowersAndNoProducts) {
  EXPECT_THAT(MakeTerms(TermSet::kSquares, {false, false}, 2),
              ElementsAre(ElementsAre(1, 0),
                          ElementsAre(0, 1),
                          ElementsAre(2, 0),
                          ElementsAre(0, 2)));
}

TEST(TermSet, AxisHasPowersOfPositionTimesOneAndEveryOtherInput) {
  EXPECT_THAT(MakeTerms(TermSet::kAxis, {true, false}, 2),
              ElementsAre(ElementsAre(1, 0),
                          ElementsAre(0, 1),
                          ElementsAre(1, 1),
                          ElementsAre(2, 0),
                          ElementsAre(2, 1)));
}

TEST(TermSet, CountsWhatItMakes) {
  for (const TermSet set :
       {TermSet::kLinear, TermSet::kSquares, TermSet::kAxis, TermSet::kFull}) {
    for (const int degree : {1, 2, 3}) {
      EXPECT_EQ(CountTerms(set, kPositionAndTwo, degree),
                static_cast<Eigen::Index>(
                    MakeTerms(set, kPositionAndTwo, degree).size()))
          << ToString(set) << " " << degree;
    }
  }
}

}  // namespace
}  // namespace errmap::models
