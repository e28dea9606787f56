#include "stats/satterthwaite_dof.h"

#include <cmath>

#include <gtest/gtest.h>

namespace errmap::stats {
namespace {

using Eigen::VectorXd;

// Squares about the mean 1.105 sum to 0.02205; over 0.0641847547, the lower
// fifth of chi-squared with 1 degree of freedom (R: qchisq(0.2, 1)), that is a
// variance of 0.34354, and 2 * 1.105^2 over it 7.1085 for each.
TEST(SatterthwaiteDof, IsThatOfTheVarianceThatTheMeanSquaresLeave) {
  EXPECT_NEAR(SatterthwaiteDof(VectorXd{{1.0, 1.21}}), 2.0 * 7.1084980, 1e-6);
}

TEST(SatterthwaiteDof, CountsAUnitForOneAtLeast) {
  EXPECT_EQ(SatterthwaiteDof(VectorXd{{0.0, 100.0, 0.1}}), 3.0);
}

TEST(SatterthwaiteDof, HasNoLimitWhereUnitsAreTheSame) {
  EXPECT_TRUE(std::isinf(SatterthwaiteDof(VectorXd{{4.0, 4.0}})));
  EXPECT_TRUE(std::isinf(SatterthwaiteDof(VectorXd{{0.0, 0.0}})));
}

}  // namespace
}  // namespace errmap::stats
