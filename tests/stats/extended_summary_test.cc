#include "stats/extended_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/summary.h"

namespace errmap::stats {
namespace {

using ExtendedVector = Eigen::Matrix<DoubleDouble, Eigen::Dynamic, 1>;

// NIST's NumAcc4: 10000000.2, then 10000000.1 and 10000000.3 in turn; sd 0.1
// and autocorrelation -0.999 exactly.
ExtendedVector NumAcc4() {
  constexpr Eigen::Index kPairs = 500;
  ExtendedVector sample(2 * kPairs + 1);
  sample[0] = ParseDoubleDouble("10000000.2");
  for (Eigen::Index i = 0; i < kPairs; ++i) {
    sample[2 * i + 1] = ParseDoubleDouble("10000000.1");
    sample[2 * i + 2] = ParseDoubleDouble("10000000.3");
  }
  return sample;
}

TEST(ExtendedSummary, KeepsTheDigitsThatDoublesLose) {
  const ExtendedVector sample = NumAcc4();
  const ExtendedSummary summary = SummarizeExtended(sample);
  EXPECT_DOUBLE_EQ(summary.mean.hi, 10000000.2);
  EXPECT_DOUBLE_EQ(summary.sd.hi, 0.1);
  EXPECT_DOUBLE_EQ(summary.autocorrelation.hi, -0.999);
  EXPECT_NEAR(summary.condition, 1e8, 1e3);

  const Eigen::VectorXd doubles = sample.cast<double>();
  const double error = std::abs(Summarize(doubles).sd - 0.1);
  EXPECT_LT(error, 1e-8);
  EXPECT_GT(error, 1e-12);
}

TEST(ExtendedSummary, AgreesWithTheDoubleOneOnTameData) {
  const Eigen::VectorXd sample{{1.0, 4.0, 2.0, 8.0, 5.0, 7.0}};
  const ExtendedSummary summary =
      SummarizeExtended(sample.cast<DoubleDouble>());
  EXPECT_DOUBLE_EQ(summary.mean.hi, Summarize(sample).mean);
  EXPECT_DOUBLE_EQ(summary.sd.hi, Summarize(sample).sd);
  EXPECT_DOUBLE_EQ(summary.autocorrelation.hi, LagOneAutocorrelation(sample));
}

TEST(LagOneAutocorrelation, FollowsItsDefinition) {
  // Mean 2; deviations -1, 1, -1, 1: -3 / 4.
  EXPECT_DOUBLE_EQ(LagOneAutocorrelation(Eigen::Vector4d(1.0, 3.0, 1.0, 3.0)),
                   -0.75);
  EXPECT_TRUE(std::isnan(LagOneAutocorrelation(Eigen::Vector2d(1.0, 1.0))));
}

TEST(LagOneAutocorrelation, IgnoresShiftAndScale) {
  const Eigen::VectorXd sample{{1.0, 4.0, 2.0, 8.0, 5.0, 7.0}};
  const double r = LagOneAutocorrelation(sample);
  EXPECT_DOUBLE_EQ(LagOneAutocorrelation(sample.array() + 4096.0), r);
  EXPECT_DOUBLE_EQ(LagOneAutocorrelation(-8.0 * sample), r);
}

TEST(ExtendedSummary, NeedsTwoValues) {
  EXPECT_THROW(SummarizeExtended(ExtendedVector(1)), std::invalid_argument);
  EXPECT_THROW(LagOneAutocorrelation(Eigen::VectorXd(1)),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::stats
