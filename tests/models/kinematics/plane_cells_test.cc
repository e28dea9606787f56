#include "models/kinematics/plane_cells.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixX3d;

constexpr double kPlaneCellsRounding = 1e-12;

TEST(WorkingPlane, IsThatOfTheSensitiveDirections) {
  const auto lathe = WorkingPlaneOf({true, false, true});
  ASSERT_TRUE(lathe.has_value());
  EXPECT_EQ(lathe->across, 2);
  EXPECT_EQ(lathe->up, 0);
  const auto mill = WorkingPlaneOf({true, true, true});
  ASSERT_TRUE(mill.has_value());
  EXPECT_EQ(mill->across, 0);
  EXPECT_EQ(mill->up, 1);
  const auto side = WorkingPlaneOf({false, true, true});
  ASSERT_TRUE(side.has_value());
  EXPECT_EQ(side->across, 1);
  EXPECT_EQ(side->up, 2);
  EXPECT_FALSE(WorkingPlaneOf({true, false, false}).has_value());
  EXPECT_FALSE(WorkingPlaneOf({false, false, false}).has_value());
}

// Three by three cells of 10 by 20: two points in the first, one in the last.
TEST(CellsOf, TakesErrorsTogetherWherePosesAre) {
  MatrixX3d points(3, 3);
  points << 0, 7, 0,  //
      9, 8, 19,       //
      30, 9, 60;
  MatrixX3d errors(3, 3);
  errors << 3, 100, 4,  //
      1, 100, 0,        //
      0, 100, 0;
  const PlaneCells cells = CellsOf({.across = 0, .up = 2}, points, errors);
  EXPECT_NEAR(cells.width, 10.0, kPlaneCellsRounding);
  EXPECT_NEAR(cells.height, 20.0, kPlaneCellsRounding);
  ASSERT_EQ(cells.cells.size(), 2U);
  const PlaneCell& first = cells.cells[0];
  EXPECT_EQ(first.points, 2);
  EXPECT_NEAR(first.across, 5.0, kPlaneCellsRounding);
  EXPECT_NEAR(first.up, 10.0, kPlaneCellsRounding);
  EXPECT_NEAR(first.mean_across, 2.0, kPlaneCellsRounding);
  EXPECT_NEAR(first.mean_up, 2.0, kPlaneCellsRounding);
  EXPECT_NEAR(first.rms, std::sqrt((25.0 + 1.0) / 2.0), kPlaneCellsRounding);
  // A cell without error is there; cells without poses are not.
  const PlaneCell& last = cells.cells[1];
  EXPECT_NEAR(last.across, 25.0, kPlaneCellsRounding);
  EXPECT_NEAR(last.up, 50.0, kPlaneCellsRounding);
  EXPECT_EQ(last.rms, 0.0);
}

TEST(CellsOf, KeepsEveryPointAndAtMostTwelveCellsInARow) {
  constexpr Index kPoints = 5000;
  const MatrixX3d points = MatrixX3d::Random(kPoints, 3);
  const PlaneCells cells =
      CellsOf({.across = 2, .up = 0}, points, MatrixX3d::Ones(kPoints, 3));
  EXPECT_EQ(cells.cells.size(), 144U);
  Index count = 0;
  for (const PlaneCell& cell : cells.cells) {
    count += cell.points;
    EXPECT_NEAR(cell.rms, std::sqrt(2.0), kPlaneCellsRounding);
  }
  EXPECT_EQ(count, kPoints);
}

TEST(CellsOf, HasOneRowWhereAnAxisStood) {
  MatrixX3d points = MatrixX3d::Zero(4, 3);
  points.col(0) << 0, 1, 2, 3;
  const PlaneCells cells =
      CellsOf({.across = 0, .up = 1}, points, MatrixX3d::Zero(4, 3));
  for (const PlaneCell& cell : cells.cells) {
    EXPECT_EQ(cell.up, cells.cells.front().up);
    EXPECT_LE(std::abs(cell.up), 0.5 * cells.height);
  }
  EXPECT_TRUE(CellsOf({}, MatrixX3d(0, 3), MatrixX3d(0, 3)).cells.empty());
  EXPECT_THROW(CellsOf({}, points, MatrixX3d::Zero(3, 3)),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::models
