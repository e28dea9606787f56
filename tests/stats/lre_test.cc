#include "stats/lre.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/not_a_number.h"
#include "tests/numbers.h"

namespace errmap::stats {
namespace {

TEST(LogRelativeError, CountsAgreeingDigits) {
  EXPECT_NEAR(LogRelativeError(1.001, 1.0, 11.0), 3.0, 1e-9);
  EXPECT_NEAR(LogRelativeError(-1.001e300, -1e300, 11.0), 3.0, 1e-9);
  EXPECT_NEAR(LogRelativeError(2.0001e-9, 2e-9, 11.0), 4.0 + 0.30103, 1e-5);
}

TEST(LogRelativeError, TakesTheAbsoluteErrorOfACertifiedZero) {
  EXPECT_NEAR(LogRelativeError(1e-7, 0.0, 15.0), 7.0, 1e-12);
  EXPECT_EQ(LogRelativeError(0.0, 0.0, 15.0), 15.0);
}

TEST(LogRelativeError, IsCappedAndNeverNegative) {
  EXPECT_EQ(LogRelativeError(3.0, 3.0, 11.0), 11.0);
  EXPECT_EQ(LogRelativeError(1.0 + 1e-14, 1.0, 11.0), 11.0);
  EXPECT_EQ(LogRelativeError(300.0, 3.0, 11.0), 0.0);
  EXPECT_EQ(LogRelativeError(-3.0, 3.0, 11.0), 0.0);
}

TEST(LogRelativeError, IsZeroWhereAnythingIsNotFinite) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_EQ(LogRelativeError(bad, 1.0, 11.0), 0.0);
    EXPECT_EQ(LogRelativeError(1.0, bad, 11.0), 0.0);
  }
}

TEST(LogRelativeError, RefusesACapOfNothing) {
  for (const double cap : {0.0, -1.0, kNaN}) {
    EXPECT_THROW(LogRelativeError(1.0, 1.0, cap), std::invalid_argument);
  }
}

TEST(SmallestLogRelativeError, TakesTheWorstElement) {
  const Eigen::Vector3d certified(1.0, 2.0, 0.0);
  EXPECT_NEAR(SmallestLogRelativeError(
                  Eigen::Vector3d(1.0, 2.002, 1e-9), certified, 11.0),
              3.0,
              1e-9);
  EXPECT_EQ(SmallestLogRelativeError(
                Eigen::Vector3d(1.0, kNaN, 0.0), certified, 11.0),
            0.0);
}

TEST(SmallestLogRelativeError, RefusesSizesThatDoNotAgree) {
  EXPECT_THROW(SmallestLogRelativeError(
                   Eigen::Vector2d(1.0, 2.0), Eigen::Vector3d::Zero(), 11.0),
               std::invalid_argument);
  EXPECT_THROW(
      SmallestLogRelativeError(Eigen::VectorXd(), Eigen::VectorXd(), 11.0),
      std::invalid_argument);
}

}  // namespace
}  // namespace errmap::stats
