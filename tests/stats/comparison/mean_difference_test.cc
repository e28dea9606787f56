#include "stats/comparison/mean_difference.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/numbers.h"

namespace errmap::stats {
namespace {

using Eigen::VectorXd;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kRelative = 1e-13;

void ExpectTest(const MeanDifferenceTest& found,
                double t,
                double p,
                double degrees_of_freedom) {
  ASSERT_TRUE(found.test.ok()) << found.test.why_not;
  EXPECT_NEAR(found.test.statistic, t, kRelative * std::abs(t));
  EXPECT_NEAR(found.test.p, p, 10.0 * kRelative * p);
  EXPECT_EQ(found.degrees_of_freedom, degrees_of_freedom);
}

VectorXd Drifting() {
  return VectorXd{{0.8, -0.3, 1.7, 2.2, -0.9, 0.4, 3.1, -1.2, 0.65, 1.05}};
}

// Eight values that alternate: gamma_0 + 2 gamma_1 = -0.75.
VectorXd Alternating() {
  return VectorXd{{1, -0.9, 1.1, -1, 1.05, -0.95, 1, -1.02}};
}

// R 4.2.2: t <- mean(d) / sqrt((1/5 + 80/317) * var(d)); 2 * pt(-abs(t), 4).
TEST(CorrectedResampledT, AgreesWithItsEquationInR) {
  const VectorXd d{{0.12, 0.05, -0.02, 0.2, 0.09}};
  ExpectTest(CorrectedResampledT(d, 80.0 / 317.0),
             1.6020453680537925,
             0.18440432810500695,
             4.0);
  // Losses in squared micrometres or squared metres: the same test.
  ExpectTest(CorrectedResampledT(1e-180 * d, 80.0 / 317.0),
             1.6020453680537925,
             0.18440432810500695,
             4.0);
}

TEST(CorrectedResampledT, WithoutOverlapIsThePairedT) {
  // R 4.2.2: t.test(d).
  ExpectTest(CorrectedResampledT(Drifting(), 0.0),
             1.7580271160193579,
             0.11261166518060896,
             9.0);
}

TEST(CorrectedResampledT, FindsNothingInEqualModels) {
  ExpectTest(CorrectedResampledT(VectorXd::Zero(5), 0.25), 0.0, 1.0, 4.0);
}

TEST(CorrectedResampledT, SaysWhyWhereItDoesNotApply) {
  EXPECT_EQ(CorrectedResampledT(VectorXd::Ones(1), 0.5).test.why_not,
            "needs at least 2 folds, found 1");
  EXPECT_EQ(CorrectedResampledT(VectorXd::Ones(4), 0.5).test.why_not,
            "the differences do not vary");
  EXPECT_EQ(CorrectedResampledT(VectorXd{{1.0, kInfinity}}, 0.5).test.why_not,
            "differences that are not finite");
  for (const double wrong : {-0.1, kInfinity}) {
    EXPECT_THAT([&] { CorrectedResampledT(Drifting(), wrong); },
                ThrowsMessage<std::invalid_argument>(
                    HasSubstr("test_to_train must be finite and at least 0")));
  }
}

// R 4.2.2, by the definition for a horizon of 1: v = g0 / n with g of acf(d,
// type = "covariance"), t = sqrt((n - 1) / n) mean(d) / sqrt(v).
TEST(DieboldMariano, AgreesWithItsEquationInR) {
  ExpectTest(
      DieboldMariano(Drifting()), 1.7580271160193577, 0.11261166518060896, 9.0);
  ExpectTest(DieboldMariano(Alternating()),
             0.092281174056023776,
             0.92906011923095155,
             7.0);
}

TEST(DieboldMariano, FindsNothingInEqualModels) {
  ExpectTest(DieboldMariano(VectorXd::Zero(6)), 0.0, 1.0, 5.0);
}

TEST(DieboldMariano, SaysWhyWhereItDoesNotApply) {
  EXPECT_EQ(DieboldMariano(VectorXd()).test.why_not,
            "needs at least 2 units, found 0");
  EXPECT_EQ(DieboldMariano(VectorXd::Ones(9)).test.why_not,
            "the differences do not vary");
}

}  // namespace
}  // namespace errmap::stats
