#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/figures/figures.h"

namespace errmap::report {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(IntervalPicture, HasADotBetweenNothingAndAllOfTheError) {
  // 112 units of width from 4 on.
  EXPECT_THAT(IntervalPicture(0.5, {0.25, 1.5}, 1.0),
              AllOf(HasSubstr("aria-label=\"50 % of the error is left\""),
                    HasSubstr("<circle cx=\"60.0\" cy=\"9.0\""),
                    HasSubstr("M32.0 9H116.0")));
  EXPECT_THAT(IntervalPicture(0.0, {NAN, NAN}, 0.0),
              AllOf(HasSubstr("\"0 % of the error is left\""),
                    HasSubstr("cx=\"4.0\""),
                    Not(HasSubstr("nan"))));
}

TEST(IntervalPicture, IsNotDrawnOfAMapThatAddsErrorOrOfNothingKnown) {
  EXPECT_EQ(IntervalPicture(1.5, {1.0, 2.0}, 1.0), "");
  EXPECT_EQ(IntervalPicture(NAN, {NAN, NAN}, 1.0), "");
  EXPECT_EQ(IntervalPicture(1.0, {1.0, 2.0}, NAN), "");
  EXPECT_EQ(IntervalPicture(1.0, {1.0, 2.0}, INFINITY), "");
}

TEST(Sparkline, GoesFromNothingToTheLargestWhichHasADot) {
  EXPECT_THAT(Sparkline({0.0, 2.0, 1.0}, "RMSE by <cycle>"),
              AllOf(HasSubstr("aria-label=\"RMSE by &lt;cycle&gt;\""),
                    HasSubstr("M4.0 15.5L60.0 2.5L116.0 9.0"),
                    HasSubstr("<circle cx=\"60.0\" cy=\"2.5\"")));
  EXPECT_THAT(Sparkline({0.0, 0.0}, "x"), Not(HasSubstr("nan")));
}

TEST(Sparkline, OfManyUnitsKeepsTheLargest) {
  std::vector<double> errors(1000, 1.0);
  errors[517] = 10.0;
  const std::string line = Sparkline(errors, "x");
  EXPECT_THAT(line, HasSubstr(" 2.5L"));
  EXPECT_LT(line.size(), 1200U);
}

TEST(Sparkline, IsNotDrawnOfOneUnitOrOfWhatIsNotKnown) {
  EXPECT_EQ(Sparkline({}, "x"), "");
  EXPECT_EQ(Sparkline({1.0}, "x"), "");
  EXPECT_EQ(Sparkline({1.0, NAN}, "x"), "");
}

}  // namespace
}  // namespace errmap::report
