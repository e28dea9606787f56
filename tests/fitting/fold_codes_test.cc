#include "fitting/fold_codes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::fitting {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(FoldCodes, PredictEachFoldFromAllOthers) {
  const FoldCodes folds{{0, 1, 2, 1, 0}, false};
  EXPECT_EQ(folds.count(), 3);
  EXPECT_EQ(folds.first_judged(), 0);
  EXPECT_THAT(folds.Split(1).train, ElementsAre(0, 2, 4));
  EXPECT_THAT(folds.Split(1).test, ElementsAre(1, 3));
}

TEST(FoldCodes, PredictEachFoldFromEarlierOnesWhereForward) {
  const FoldCodes folds{{0, 1, 2, 1, 0}, true};
  EXPECT_EQ(folds.first_judged(), 1);
  EXPECT_THAT(folds.Split(1).train, ElementsAre(0, 4));
  EXPECT_THAT(folds.Split(1).test, ElementsAre(1, 3));
  EXPECT_THAT(folds.Split(2).train, ElementsAre(0, 1, 3, 4));
  EXPECT_THAT(folds.Split(2).test, ElementsAre(2));
  EXPECT_TRUE(folds.Fits(2, 0));
  EXPECT_FALSE(folds.Fits(1, 2));
}

TEST(FoldCodes, AreNoFoldsWithoutRows) {
  const FoldCodes none;
  EXPECT_EQ(none.count(), 0);
  EXPECT_THAT(none.Split(0).test, IsEmpty());
}

}  // namespace
}  // namespace errmap::fitting
