#include "stats/error_metrics.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/random.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// A few roundings of sums of some hundred terms of size one.
constexpr double kErrorMetricsRounding = 1e-14;

VectorXd RandomVector(Index size, std::uint64_t seed) {
  Random random(seed);
  VectorXd values(size);
  for (double& value : values) value = random.Uniform() - 0.4;
  return values;
}

TEST(ErrorMetrics, FollowTheirDefinitions) {
  const VectorXd targets{{1.0, 2.0, 3.0, 6.0}};
  const VectorXd residuals{{1.0, -1.0, 0.0, 2.0}};
  const VectorXd baseline = VectorXd::Constant(4, 3.0);
  const ErrorMetrics metrics =
      ComputeErrorMetrics(targets, residuals, baseline);
  EXPECT_DOUBLE_EQ(metrics.rmse, std::sqrt(6.0 / 4.0));
  EXPECT_DOUBLE_EQ(metrics.mae, 1.0);
  EXPECT_DOUBLE_EQ(metrics.r2, 1.0 - 6.0 / 14.0);
  EXPECT_EQ(metrics.n, 4);
  EXPECT_DOUBLE_EQ(metrics.mean, 0.5);
  EXPECT_DOUBLE_EQ(metrics.sd, std::sqrt(5.0 / 3.0));
  EXPECT_EQ(metrics.min, -1.0);
  EXPECT_EQ(metrics.max, 2.0);
  EXPECT_EQ(metrics.range, 3.0);
}

TEST(ErrorMetrics, R2IsOneForAPerfectModelAndZeroForTheBaselineItself) {
  const VectorXd targets = RandomVector(50, 1);
  const VectorXd baseline = VectorXd::Constant(50, 0.1);
  EXPECT_EQ(ComputeErrorMetrics(targets, VectorXd::Zero(50), baseline).r2, 1.0);
  EXPECT_EQ(ComputeErrorMetrics(targets, targets - baseline, baseline).r2, 0.0);
}

TEST(ErrorMetrics, R2IsNegativeBelowTheBaseline) {
  const VectorXd targets{{1.0, -1.0}};
  EXPECT_DOUBLE_EQ(
      ComputeErrorMetrics(targets, VectorXd{{2.0, -2.0}}, VectorXd::Zero(2)).r2,
      -3.0);
}

TEST(ErrorMetrics, R2UsesTheBaselineOfEachRow) {
  // Two folds, each with the mean of its own training rows.
  const VectorXd targets{{1.0, 2.0, 3.0, 4.0}};
  const VectorXd baseline{{3.5, 3.5, 1.5, 1.5}};
  const VectorXd residuals = VectorXd::Constant(4, 0.5);
  EXPECT_DOUBLE_EQ(ComputeErrorMetrics(targets, residuals, baseline).r2,
                   1.0 - 1.0 / (2.5 * 2.5 + 1.5 * 1.5 + 1.5 * 1.5 + 2.5 * 2.5));
}

TEST(ErrorMetrics, R2IsNotANumberWhereTargetsDoNotVary) {
  const VectorXd constant = VectorXd::Constant(3, 2.0);
  const ErrorMetrics metrics =
      ComputeErrorMetrics(constant, VectorXd{{0.1, 0.0, -0.1}}, constant);
  EXPECT_TRUE(std::isnan(metrics.r2));
  EXPECT_TRUE(std::isfinite(metrics.rmse));
}

TEST(ErrorMetrics, OfNothingAreNotANumber) {
  const ErrorMetrics metrics =
      ComputeErrorMetrics(VectorXd(), VectorXd(), VectorXd());
  EXPECT_EQ(metrics.n, 0);
  EXPECT_TRUE(std::isnan(metrics.mean));
  EXPECT_TRUE(std::isnan(metrics.rmse));
  EXPECT_TRUE(std::isnan(metrics.mae));
  EXPECT_TRUE(std::isnan(metrics.r2));
}

TEST(ErrorMetrics, OfOneRowHaveNoSd) {
  const ErrorMetrics metrics =
      ComputeErrorMetrics(VectorXd{{3.0}}, VectorXd{{-0.5}}, VectorXd{{2.0}});
  EXPECT_EQ(metrics.rmse, 0.5);
  EXPECT_EQ(metrics.mae, 0.5);
  EXPECT_EQ(metrics.r2, 0.75);
  EXPECT_TRUE(std::isnan(metrics.sd));
}

TEST(ErrorMetrics, SquaredRmseIsVariancePlusSquaredMean) {
  const VectorXd residuals = RandomVector(397, 2);
  const ErrorMetrics metrics =
      ComputeErrorMetrics(RandomVector(397, 3), residuals, VectorXd::Zero(397));
  EXPECT_NEAR(
      metrics.rmse * metrics.rmse,
      metrics.mean * metrics.mean + metrics.sd * metrics.sd * 396.0 / 397.0,
      kErrorMetricsRounding);
  EXPECT_LE(metrics.mae, metrics.rmse);
  EXPECT_LE(std::abs(metrics.mean), metrics.mae);
}

TEST(ErrorMetrics, KeepTheirInvariances) {
  constexpr double kScale = 1000.0;  // mm to um
  constexpr double kShift = 7.0;
  const VectorXd targets = RandomVector(100, 4);
  const VectorXd residuals = RandomVector(100, 5);
  const VectorXd baseline = VectorXd::Constant(100, 0.05);
  const ErrorMetrics plain = ComputeErrorMetrics(targets, residuals, baseline);

  const ErrorMetrics scaled = ComputeErrorMetrics(
      kScale * targets, kScale * residuals, kScale * baseline);
  EXPECT_NEAR(scaled.rmse, kScale * plain.rmse, kScale * kErrorMetricsRounding);
  EXPECT_NEAR(scaled.mae, kScale * plain.mae, kScale * kErrorMetricsRounding);
  EXPECT_NEAR(scaled.r2, plain.r2, kErrorMetricsRounding);

  const ErrorMetrics shifted = ComputeErrorMetrics(
      targets.array() + kShift, residuals, baseline.array() + kShift);
  EXPECT_EQ(shifted.rmse, plain.rmse);
  EXPECT_NEAR(shifted.r2, plain.r2, kErrorMetricsRounding);

  const ErrorMetrics reversed = ComputeErrorMetrics(
      targets.reverse(), residuals.reverse(), baseline.reverse());
  EXPECT_NEAR(reversed.rmse, plain.rmse, kErrorMetricsRounding);
  EXPECT_NEAR(reversed.mae, plain.mae, kErrorMetricsRounding);
  EXPECT_NEAR(reversed.r2, plain.r2, kErrorMetricsRounding);

  const ErrorMetrics negated =
      ComputeErrorMetrics(targets, -residuals, baseline);
  EXPECT_EQ(negated.rmse, plain.rmse);
  EXPECT_EQ(negated.mae, plain.mae);
  EXPECT_EQ(negated.r2, plain.r2);
}

TEST(ErrorMetrics, RefuseSizesThatDoNotAgree) {
  const VectorXd two = VectorXd::Zero(2);
  const VectorXd three = VectorXd::Zero(3);
  EXPECT_THAT([&] { ComputeErrorMetrics(two, three, two); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("ComputeErrorMetrics"),
                        HasSubstr("must have one size; found 2, 3, 2"))));
  EXPECT_THAT([&] { ComputeErrorMetrics(three, three, two); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("3, 3, 2")));
}

TEST(RootMeanSquare, IsKnownWhereSquaresAreNoNumbers) {
  const VectorXd residuals{{3.0, -4.0, 0.0}};
  for (const int power : {1000, -1000}) {
    const double scale = std::scalbn(1.0, power);
    const VectorXd scaled = residuals * scale;
    EXPECT_EQ(RootMeanSquare(scaled), RootMeanSquare(residuals) * scale);
    EXPECT_EQ(ComputeErrorMetrics(scaled, scaled, scaled).rmse,
              RootMeanSquare(residuals) * scale);
  }
  EXPECT_EQ(RootMeanSquare(VectorXd::Zero(3)), 0.0);
}

TEST(RootMeanSquare, IsTheRootOfTheMeanSquare) {
  EXPECT_DOUBLE_EQ(RootMeanSquare(VectorXd{{3.0, 4.0}}), std::sqrt(12.5));
  EXPECT_EQ(RootMeanSquare(VectorXd{{-2.0}}), 2.0);
  EXPECT_EQ(RootMeanSquare(VectorXd::Zero(5)), 0.0);
  EXPECT_TRUE(std::isnan(RootMeanSquare(VectorXd())));
}

TEST(GeometricMean, TakesZeroForTheSmallestNumber) {
  EXPECT_NEAR(GeometricMean(Eigen::VectorXd{{1.0, 4.0}}), 2.0, 1e-15);
  EXPECT_LT(GeometricMean(Eigen::VectorXd{{0.0, 1.0}}), 1e-100);
  EXPECT_EQ(GeometricMean(Eigen::VectorXd{{0.0, 1.0}}),
            GeometricMean(Eigen::VectorXd{{1.0, 0.0}}));
}

}  // namespace
}  // namespace errmap::stats
