#include "models/blend/stacking.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace errmap::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(Stacking, FindsTheMixtureThatMadeTheTargets) {
  MatrixXd predictions(50, 3);
  for (Eigen::Index i = 0; i < 50; ++i) {
    const double k = static_cast<double>(i);
    predictions.row(i) << std::sin(k), std::cos(1.7 * k), 0.1 * k;
  }
  const VectorXd mixture = (VectorXd(3) << 0.3, 0.7, 0.0).finished();
  const VectorXd weights = StackingWeights(predictions, predictions * mixture);
  EXPECT_TRUE(weights.isApprox(mixture, 1e-5)) << weights;
}

TEST(Stacking, WeightsAreNeverBelowZeroAndSumToOne) {
  MatrixXd predictions(40, 4);
  VectorXd targets(40);
  for (Eigen::Index i = 0; i < 40; ++i) {
    const double k = static_cast<double>(i);
    predictions.row(i) << std::sin(k), -std::sin(k), 3.0, std::cos(k);
    targets[i] = 2.0 * std::sin(k) - 1.0;
  }
  const VectorXd weights = StackingWeights(predictions, targets);
  EXPECT_GE(weights.minCoeff(), 0.0);
  EXPECT_NEAR(weights.sum(), 1.0, 1e-9);
}

TEST(Stacking, RowsThatSomeMapNeverSawAreLeftOut) {
  MatrixXd predictions = MatrixXd::Random(30, 2);
  const VectorXd targets = predictions.col(1);
  predictions.row(3).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_NEAR(StackingWeights(predictions, targets)[1], 1.0, 1e-6);
  predictions.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(StackingWeights(predictions, targets)[0], 0.5);
}

}  // namespace
}  // namespace errmap::models
