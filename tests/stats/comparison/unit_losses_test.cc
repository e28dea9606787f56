#include "stats/comparison/unit_losses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/numbers.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

MatrixXd FiveRows() {
  MatrixXd residuals(5, 2);
  residuals << 1, 0,  //
      -3, 2,          //
      2, -2,          //
      0, 4,           //
      1, 0;
  return residuals;
}

TEST(GatherByUnit, AveragesSquaresWithinEachUnit) {
  const UnitLosses losses = GatherByUnit(FiveRows(), {7, 2, 7, 2, 2});
  EXPECT_THAT(losses.rows, ElementsAre(3.0, 2.0));
  EXPECT_DOUBLE_EQ(losses.mean_squares(0, 0), 10.0 / 3.0);
  EXPECT_DOUBLE_EQ(losses.mean_squares(0, 1), 20.0 / 3.0);
  EXPECT_DOUBLE_EQ(losses.mean_squares(1, 0), 2.5);
  EXPECT_DOUBLE_EQ(losses.mean_squares(1, 1), 2.0);
  EXPECT_NO_THROW(losses.Validate());
}

TEST(PooledRmse, EqualsThatOfAllRowsWhateverTheUnits) {
  const MatrixXd residuals = FiveRows();
  for (const std::vector<Index>& codes :
       {std::vector<Index>{7, 2, 7, 2, 2}, {0, 1, 2, 3, 4}, {0, 0, 0, 0, 0}}) {
    const VectorXd rmse = PooledRmse(GatherByUnit(residuals, codes));
    EXPECT_DOUBLE_EQ(rmse[0], std::sqrt(15.0 / 5.0));
    EXPECT_DOUBLE_EQ(rmse[1], std::sqrt(24.0 / 5.0));
  }
}

TEST(PooledRmse, OfNoUnitsIsNotANumber) {
  const VectorXd rmse = PooledRmse(GatherByUnit(MatrixXd(0, 3), {}));
  ASSERT_EQ(rmse.size(), 3);
  EXPECT_TRUE(std::isnan(rmse[0]));
}

TEST(GatherByUnit, RefusesWhatItCannotGather) {
  EXPECT_THAT(
      [] {
        GatherByUnit(FiveRows(), {0, 1});
      },
      ThrowsMessage<std::invalid_argument>(
          HasSubstr("2 unit codes for 5 rows")));
  EXPECT_THAT(
      [] {
        GatherByUnit(FiveRows(), {0, 1, -4, 0, 0});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("negative unit code -4")));
  MatrixXd residuals = FiveRows();
  residuals(3, 1) = kNaN;
  EXPECT_THAT(
      [&] {
        GatherByUnit(residuals, {0, 0, 0, 0, 0});
      },
      ThrowsMessage<std::invalid_argument>(
          HasSubstr("row 3 has a residual that is not finite")));
}

TEST(UnitLosses, AreRefusedWhereInvalid) {
  const UnitLosses good{.mean_squares = MatrixXd::Ones(2, 3),
                        .rows = VectorXd::Ones(2)};
  EXPECT_NO_THROW(good.Validate());
  const auto message_of = [](const UnitLosses& losses) -> std::string {
    try {
      losses.Validate();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  UnitLosses bad = good;
  bad.rows = VectorXd::Ones(3);
  EXPECT_EQ(message_of(bad), "UnitLosses: 3 numbers of rows for 2 units");
  bad = good;
  bad.rows[1] = 0.0;
  EXPECT_THAT(message_of(bad), HasSubstr("unit 1 has 0.000000 rows"));
  for (const double wrong :
       {kNaN, -1.0, std::numeric_limits<double>::infinity()}) {
    bad = good;
    bad.mean_squares(1, 2) = wrong;
    EXPECT_THAT(message_of(bad), HasSubstr("unit 1, model 2: mean square"));
  }
}

TEST(BlocksInOrder, CutsRowsIntoRunsAsEqualAsCanBe) {
  EXPECT_THAT(BlocksInOrder(12),
              ElementsAre(0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1));
  EXPECT_THAT(BlocksInOrder(11), ElementsAre(0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1));
  const auto many = BlocksInOrder(397);
  EXPECT_EQ(many.size(), 397U);
  EXPECT_EQ(many.back(), 19);
  // 397 = 17 * 20 + 3 * 19.
  EXPECT_EQ(std::count(many.begin(), many.end(), 16), 20);
  EXPECT_EQ(std::count(many.begin(), many.end(), 17), 19);
}

TEST(BlocksInOrder, KeepsFewRowsInOneBlock) {
  EXPECT_THAT(BlocksInOrder(0), IsEmpty());
  EXPECT_THAT(BlocksInOrder(1), ElementsAre(0));
  EXPECT_THAT(BlocksInOrder(9), Each(0));
  EXPECT_EQ(BlocksInOrder(10).back(), 1);
}

}  // namespace
}  // namespace errmap::stats
