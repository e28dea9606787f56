#include "stats/normality/simulated_quantiles.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/normality/simulated_quantiles_data.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr SimulatedStatistic kAll[] = {SimulatedStatistic::kLilliefors,
                                       SimulatedStatistic::kNormalPpcc,
                                       SimulatedStatistic::kTukeyMaxPpcc,
                                       SimulatedStatistic::kDip};

TEST(SimulatedQuantiles, TablesRiseStrictlyInEachRow) {
  for (const auto& table : simulated::kTables) {
    for (const auto& row : table) {
      for (std::size_t i = 1; i < row.size(); ++i)
        EXPECT_GE(row[i], row[i - 1]);
      EXPECT_GT(row.front(), 0.0);
    }
  }
}

TEST(SimulatedQuantiles, ProbabilityInvertsTheCriticalValue) {
  constexpr double kRounding = 1e-9;
  for (const SimulatedStatistic statistic : kAll) {
    for (const Index n : {30, 45, 397, 5000, 1000000}) {
      for (const double p : {0.9, 0.5, 0.2, 0.05, 0.01, 0.002}) {
        EXPECT_NEAR(SimulatedProbability(
                        statistic, SimulatedCriticalValue(statistic, p, n), n),
                    p,
                    kRounding)
            << n;
      }
    }
  }
}

// D and the dip fall as n^-0.5, the correlations' distance from 1 about as
// n^-1: no size in between may stand out.
TEST(SimulatedQuantiles, FallAsAPowerOfTheSize) {
  for (const SimulatedStatistic statistic : kAll) {
    for (double n = 30.0; n < 20000.0; n *= 1.5) {
      const double slope =
          std::log(
              SimulatedCriticalValue(
                  statistic, 0.05, static_cast<Index>(1.5 * n)) /
              SimulatedCriticalValue(statistic, 0.05, static_cast<Index>(n))) /
          std::log(1.5);
      EXPECT_LT(slope, -0.4) << n;
      EXPECT_GT(slope, -1.1) << n;
    }
  }
}

TEST(SimulatedQuantiles, AreCutOffWhereTheTableEnds) {
  EXPECT_EQ(SimulatedProbability(SimulatedStatistic::kDip, 0.0, 50), 0.999);
  EXPECT_EQ(SimulatedProbability(SimulatedStatistic::kDip, 0.25, 50), 0.001);
  EXPECT_TRUE(std::isnan(
      SimulatedProbability(SimulatedStatistic::kDip, std::nan(""), 50)));
}

TEST(SimulatedQuantiles, RefuseWhatWasNotSimulated) {
  EXPECT_THAT([] { SimulatedProbability(SimulatedStatistic::kDip, 0.1, 3); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("needs at least 4 values, found 3")));
  EXPECT_THAT(
      [] { SimulatedCriticalValue(SimulatedStatistic::kDip, 1e-4, 30); },
      ThrowsMessage<std::invalid_argument>(
          HasSubstr("within 0.001 and 0.999")));
}

}  // namespace
}  // namespace errmap::stats
