#include "models/kinematics/iso230.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::models {
namespace {

using Eigen::MatrixX3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kRounding = 1e-12;

// Two positions, three runs up and down, in um:
//   position 0:   up 1, 2, 3 (mean 2, s 1)    down -1, -1, -1 (mean -1, s 0)
//   position 100: up 6, 6, 9 (mean 7, s 1.7320508) down 4, 5, 6 (mean 5, s 1)
PositioningTest Worked() {
  return {
      .positions = VectorXd{{0, 0, 0, 0, 0, 0, 100, 100, 100, 100, 100, 100}},
      .deviations = VectorXd{{1, 2, 3, -1, -1, -1, 6, 6, 9, 4, 5, 6}},
      .upwards = {true,
                  true,
                  true,
                  false,
                  false,
                  false,
                  true,
                  true,
                  true,
                  false,
                  false,
                  false}};
}

TEST(PositioningFigures, AreThoseOfAWorkedExample) {
  const PositioningFigures figures = PositioningFiguresOf(Worked());
  const double s = std::sqrt(3.0);
  EXPECT_NEAR(figures.systematic, 7.0 - -1.0, kRounding);         // E
  EXPECT_NEAR(figures.mean_bidirectional, 6.0 - 0.5, kRounding);  // M
  EXPECT_NEAR(figures.reversal, 3.0, kRounding);                  // B
  // 2 * 1 + 3 = 5 and 4 at 0; 2 s + 2 + 2 = 7.46 and 4 s = 6.93 at 100.
  EXPECT_NEAR(figures.repeatability, 2.0 * s + 4.0, kRounding);    // R
  EXPECT_NEAR(figures.accuracy, 7.0 + 2.0 * s - -1.0, kRounding);  // A
}

TEST(PositioningFigures, AreOfEachDirectionAlone) {
  const PositioningFigures figures = PositioningFiguresOf(Worked());
  const double s = std::sqrt(3.0);
  EXPECT_NEAR(figures.up.systematic, 7.0 - 2.0, kRounding);
  EXPECT_NEAR(figures.down.systematic, 5.0 - -1.0, kRounding);
  EXPECT_NEAR(figures.up.repeatability, 4.0 * s, kRounding);
  EXPECT_NEAR(figures.down.repeatability, 4.0, kRounding);
  EXPECT_NEAR(figures.up.accuracy, 7.0 + 2.0 * s - 0.0, kRounding);
  EXPECT_NEAR(figures.down.accuracy, 7.0 - -1.0, kRounding);
  EXPECT_NEAR(figures.mean_reversal, 0.5 * (3.0 + 2.0), kRounding);
}

TEST(PositioningPoints, AreByPositionWithTheRunsOfEachDirection) {
  const auto points = PositioningPointsOf(Worked());
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1].position, 100.0);
  EXPECT_EQ(points[1].up.runs, 3);
  EXPECT_NEAR(points[1].up.mean, 7.0, kRounding);
  EXPECT_NEAR(points[1].up.sd, std::sqrt(3.0), kRounding);
  EXPECT_NEAR(points[1].reversal(), 2.0, kRounding);
}

// Of one direction alone its own figures are known, and no others.
TEST(PositioningFigures, OfOneDirectionAreItsOwn) {
  PositioningTest one_way = Worked();
  one_way.upwards.assign(12, true);
  const PositioningFigures figures = PositioningFiguresOf(one_way);
  EXPECT_TRUE(std::isfinite(figures.up.accuracy));
  EXPECT_TRUE(std::isnan(figures.down.accuracy));
  EXPECT_TRUE(std::isnan(figures.accuracy));
  EXPECT_TRUE(std::isnan(figures.repeatability));
  EXPECT_TRUE(std::isnan(figures.systematic));
}

TEST(ApproachedUpwards, IsWhereTheAxisCameFrom) {
  const bool up = true;
  const bool down = false;
  // There and back, with a stop at the end approached again from beyond.
  EXPECT_EQ(ApproachedUpwards(VectorXd{{0, 10, 20, 30, 30, 20, 10, 0}}),
            (std::vector<bool>{up, up, up, up, down, down, down, down}));
  // Sweeps one way, the axis going back unmeasured.
  EXPECT_EQ(ApproachedUpwards(VectorXd{{-10, -20, -30, -10, -20, -30}}),
            std::vector<bool>(6, down));
  EXPECT_EQ(ApproachedUpwards(VectorXd{{0, 100, 0, 100}}),
            (std::vector<bool>{up, up, down, up}));
  EXPECT_EQ(ApproachedUpwards(VectorXd{{5}}), std::vector<bool>(1, up));
}

TEST(PositioningFigures, DoNotChangeWithAConstantAndGrowWithScale) {
  PositioningTest moved = Worked();
  moved.deviations = 3.0 * moved.deviations.array() + 17.0;
  const PositioningFigures before = PositioningFiguresOf(Worked());
  const PositioningFigures after = PositioningFiguresOf(moved);
  EXPECT_NEAR(after.systematic, 3.0 * before.systematic, kRounding);
  EXPECT_NEAR(after.reversal, 3.0 * before.reversal, kRounding);
  EXPECT_NEAR(after.repeatability, 3.0 * before.repeatability, kRounding);
  EXPECT_NEAR(after.accuracy, 3.0 * before.accuracy, kRounding);
}

TEST(PositioningFigures, StayOpenWithoutBothDirectionsOrSecondRuns) {
  PositioningTest one_way = Worked();
  one_way.upwards.assign(12, true);
  EXPECT_TRUE(std::isnan(PositioningFiguresOf(one_way).reversal));
  const PositioningTest one_run{.positions = VectorXd{{0, 0}},
                                .deviations = VectorXd{{1, 2}},
                                .upwards = {true, false}};
  const PositioningFigures figures = PositioningFiguresOf(one_run);
  EXPECT_NEAR(figures.reversal, 1.0, kRounding);
  EXPECT_TRUE(std::isnan(figures.repeatability));
  EXPECT_TRUE(std::isnan(figures.accuracy));
}

TEST(PositioningFigures, RefuseShapesThatDoNotAgree) {
  PositioningTest test = Worked();
  test.upwards.pop_back();
  EXPECT_THAT([&] { PositioningFiguresOf(test); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("12 deviations and 11 directions")));
  EXPECT_THROW(PositioningFiguresOf(PositioningTest{}), std::invalid_argument);
}

// Both ways along p0n of a face of 300 by 400 mm, 500 mm long: the slide loses
// 2 um where it turns round, and the scale is long by 10 um per metre of X.
TEST(Diagonals, HaveFiguresAsAnAxisHas) {
  const Vector3d direction(0.6, 0.0, -0.8);
  MatrixX3d points(10, 3);
  for (Eigen::Index row = 0; row < 10; ++row) {
    const auto stop = static_cast<double>(row < 5 ? row : 9 - row);
    points.row(row) = Vector3d(0, 0, 400) + 125.0 * stop * direction;
  }
  MatrixX3d errors = MatrixX3d::Zero(10, 3);
  errors.col(0) = 1e-5 * points.col(0);
  std::vector<bool> upwards(5, true);
  upwards.resize(10, false);
  for (Eigen::Index row = 5; row < 10; ++row) {
    errors.row(row) -= 2e-3 * direction.transpose();
  }
  const PositioningFigures figures =
      PositioningFiguresOf(AlongDiagonal("p0n", points, errors, upwards));
  EXPECT_NEAR(figures.reversal, 2e-3, kRounding);
  EXPECT_NEAR(figures.mean_bidirectional, 3e-3 * 0.6, kRounding);
  EXPECT_NEAR(figures.systematic, 3e-3 * 0.6 + 2e-3, kRounding);
}

TEST(Diagonals, RefuseNamesAndPointsThatAreNone) {
  const auto expect = [](const char* name,
                         const MatrixX3d& points,
                         const MatrixX3d& errors,
                         const char* says) {
    EXPECT_THAT(
        [&] {
          AlongDiagonal(name, points, errors, {true, true});
        },
        ThrowsMessage<std::invalid_argument>(HasSubstr(says)));
  };
  MatrixX3d points = MatrixX3d::Zero(2, 3);
  points(1, 0) = 1.0;
  const MatrixX3d errors = MatrixX3d::Zero(2, 3);
  for (const char* name : {"", "pp", "00p", "p0x", "pppp"}) {
    expect(name, points, errors, "two of them or more");
  }
  expect("pp0", points, MatrixX3d::Zero(1, 3), "2 points and 1 errors");
  expect("pp0", MatrixX3d::Zero(2, 3), errors, "all points are one");
}

}  // namespace
}  // namespace errmap::models
