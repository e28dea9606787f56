#include "stats/comparison/holm.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/numbers.h"

namespace errmap::stats {
namespace {

using ::testing::DoubleEq;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsNan;

// R 4.2.2: p.adjust(p, "holm"), NA for NaN.
TEST(AdjustByHolm, AgreesWithRAndPassesOverNan) {
  EXPECT_THAT(AdjustByHolm({0.01, 0.04, 0.03, 0.005, 0.2, kNaN, 0.04}),
              ElementsAre(DoubleNear(0.05, 1e-15),
                          DoubleNear(0.12, 1e-15),
                          DoubleNear(0.12, 1e-15),
                          DoubleNear(0.03, 1e-15),
                          DoubleNear(0.2, 1e-15),
                          IsNan(),
                          DoubleNear(0.12, 1e-15)));
}

TEST(AdjustByHolm, NeverExceedsOne) {
  EXPECT_THAT(AdjustByHolm({0.6, 0.5, 0.9}),
              ElementsAre(DoubleEq(1.0), DoubleEq(1.0), DoubleEq(1.0)));
}

TEST(AdjustByHolm, LeavesOneTestAndNoneAsTheyAre) {
  EXPECT_THAT(AdjustByHolm({0.03}), ElementsAre(DoubleEq(0.03)));
  EXPECT_THAT(AdjustByHolm({kNaN, 0.03}), ElementsAre(IsNan(), DoubleEq(0.03)));
  EXPECT_THAT(AdjustByHolm({}), IsEmpty());
}

}  // namespace
}  // namespace errmap::stats
