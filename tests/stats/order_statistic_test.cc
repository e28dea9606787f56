#include "stats/order_statistic.h"

#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace errmap::stats {
namespace {

TEST(OrderStatistic, IsTheValueAtARankOfTheSortedOnes) {
  const std::vector<double> values = {3.0, 1.0, 2.0, 2.0};
  EXPECT_EQ(OrderStatistic(values, 0), 1.0);
  EXPECT_EQ(OrderStatistic(values, 1), 2.0);
  EXPECT_EQ(OrderStatistic(values, 3), 3.0);
}

TEST(UpperMedian, IsTheUpperOfTheMiddleTwo) {
  EXPECT_EQ(UpperMedian(std::vector<long>{5}), 5);
  EXPECT_EQ(UpperMedian(std::vector<double>{4.0, 1.0, 3.0, 2.0}), 3.0);
  EXPECT_EQ(UpperMedian(Eigen::VectorXd{{9.0, 1.0, 4.0}}), 4.0);
}

}  // namespace
}  // namespace errmap::stats
