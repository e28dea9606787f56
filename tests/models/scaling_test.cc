#include "models/scaling.h"

#include <gtest/gtest.h>

namespace errmap::models {
namespace {

Eigen::MatrixXd Sample() {
  Eigen::MatrixXd values(4, 2);
  values << -10.0, 7.0, -20.0, 7.0, -40.0, 7.0, -30.0, 7.0;
  return values;
}

TEST(Scaling, MapsTheRangeToZeroToOne) {
  const Eigen::MatrixXd scaled = UnitRangeScaling(Sample()).Apply(Sample());
  EXPECT_DOUBLE_EQ(scaled.col(0).maxCoeff(), 1.0);
  EXPECT_DOUBLE_EQ(scaled.col(0).minCoeff(), 0.0);
}

TEST(Scaling, StandardisesWithDivisorNMinusOne) {
  const Eigen::VectorXd scaled =
      StandardScaling(Sample()).Apply(Sample()).col(0);
  EXPECT_NEAR(scaled.mean(), 0.0, 1e-15);
  EXPECT_NEAR(scaled.squaredNorm() / 3.0, 1.0, 1e-15);
}

TEST(Scaling, MapsAConstantColumnToZeroEveryWay) {
  EXPECT_TRUE(UnitRangeScaling(Sample()).Apply(Sample()).col(1).isZero());
  EXPECT_TRUE(StandardScaling(Sample()).Apply(Sample()).col(1).isZero());
}

TEST(Scaling, MapsTargetsToTheSigmoidsUsableRange) {
  const Eigen::VectorXd targets = Sample().col(0);
  const TargetScaling scaling = SigmoidTargetScaling(targets);
  EXPECT_NEAR(scaling.slope * -40.0 + scaling.offset, 0.01, 1e-15);
  EXPECT_NEAR(scaling.slope * -10.0 + scaling.offset, 0.99, 1e-15);
  EXPECT_THROW(SigmoidTargetScaling(Sample().col(1)), std::invalid_argument);
}

}  // namespace
}  // namespace errmap::models
