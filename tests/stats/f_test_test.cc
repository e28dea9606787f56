#include "stats/f_test.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace errmap::stats {
namespace {

constexpr double kFTestRelative = 1e-12;

// R 4.2.2: pf(4.5, 2, 10, lower.tail = FALSE), 2 * pt(-2.5, 12) and
// qt(0.975, 7), printed with 17 digits.
TEST(FTest, AgreesWithR) {
  const auto expect = [](double found, double expected) {
    EXPECT_NEAR(found, expected, kFTestRelative * expected);
  };
  expect(FTestPValue(4.5, 2.0, 10.0), 0.040386107340619301);
  expect(StudentTwoSidedP(-2.5, 12.0), 0.027915399571325213);
  expect(StudentTwoSidedQuantile(0.95, 7.0), 2.3646242515927844);
}

TEST(FTest, IsTheSquareOfStudentsT) {
  for (const double t : {0.1, 1.0, 3.0, 12.0}) {
    EXPECT_NEAR(FTestPValue(t * t, 1.0, 17.0),
                StudentTwoSidedP(t, 17.0),
                kFTestRelative);
  }
}

TEST(FTest, HasLimitsAndNoFigureWithoutFreedom) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(FTestPValue(0.0, 1.0, 5.0), 1.0);
  EXPECT_EQ(FTestPValue(infinity, 1.0, 5.0), 0.0);
  EXPECT_TRUE(std::isnan(FTestPValue(2.0, 1.0, 0.0)));
  EXPECT_TRUE(std::isnan(StudentTwoSidedP(2.0, 0.0)));
  EXPECT_TRUE(std::isnan(StudentTwoSidedQuantile(0.95, 0.0)));
  EXPECT_THROW(StudentTwoSidedQuantile(1.0, 5.0), std::invalid_argument);
}

}  // namespace
}  // namespace errmap::stats
