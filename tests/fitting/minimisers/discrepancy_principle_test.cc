#include "fitting/minimisers/discrepancy_principle.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/decompositions.h"
#include "tests/random_matrix.h"

namespace errmap::fitting {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::RandomMatrix;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// |A w - z|^2 + alpha |w|^2 has its minimum in closed form. A is so small that
// an alpha of 0.1 is large.
class LinearProblem {
 public:
  Minimum Minimize(double alpha, const VectorXd& start) {
    ++fits;
    last_start = start;
    const MatrixXd normal =
        a_.transpose() * a_ + alpha * MatrixXd::Identity(a_.cols(), a_.cols());
    Minimum minimum;
    minimum.x = testing::SolveSymmetric(normal, a_.transpose() * z_);
    minimum.summary.termination = Termination::kDirect;
    return minimum;
  }
  double Misfit(const VectorXd& w) const { return (a_ * w - z_).norm(); }
  VectorXd zero() const { return VectorXd::Zero(a_.cols()); }

  DiscrepancyChoice Choose(double delta) {
    return ChooseByDiscrepancy(
        delta,
        zero(),
        [this](double alpha, const VectorXd& start) {
          return Minimize(alpha, start);
        },
        [this](const VectorXd& w) { return Misfit(w); });
  }

  int fits = 0;
  VectorXd last_start;

 private:
  MatrixXd a_ = 0.01 * RandomMatrix(20, 6, 3);
  VectorXd z_ = RandomMatrix(20, 1, 4).col(0);
};

TEST(DiscrepancyPrinciple, FindsAlphaToOnePercent) {
  LinearProblem problem;
  const double least = problem.Misfit(problem.Minimize(1e-18, {}).x);
  const double most = problem.Misfit(problem.zero());
  for (const double share : {0.1, 0.5, 0.9}) {
    const double delta = least + share * (most - least);
    const DiscrepancyChoice choice = problem.Choose(delta);
    ASSERT_TRUE(choice.reached);
    EXPECT_LE(choice.misfit, delta);
    EXPECT_EQ(choice.misfit, problem.Misfit(choice.minimum.x));
    // A hundredth more and it is too much: Eq. (128) between the two.
    const double above =
        problem.Misfit(problem.Minimize(1.01 * choice.alpha, {}).x);
    EXPECT_GT(above, delta);
  }
}

TEST(DiscrepancyPrinciple, GoesDownInPowersOfQAndStartsWarm) {
  LinearProblem problem;
  const double delta = problem.Misfit(problem.Minimize(3e-5, {}).x);
  const DiscrepancyChoice choice = problem.Choose(delta);
  ASSERT_GE(choice.steps.size(), 7U);
  double expected = 0.1;
  for (std::size_t i = 0; i < 7; ++i, expected /= 4.0) {
    EXPECT_EQ(choice.steps[i].alpha, expected);
  }
  EXPECT_NEAR(choice.alpha, 3e-5, 3e-7);
  EXPECT_NE(problem.last_start, problem.zero());
}

TEST(DiscrepancyPrinciple, TakesAlpha0WhereItIsSmallEnough) {
  LinearProblem problem;
  const DiscrepancyChoice choice = problem.Choose(1e6);
  EXPECT_TRUE(choice.reached);
  EXPECT_EQ(choice.alpha, 0.1);
  EXPECT_EQ(problem.fits, 1);
}

TEST(DiscrepancyPrinciple, SaysThatDeltaIsNotReached) {
  LinearProblem problem;
  const double least = problem.Misfit(problem.Minimize(1e-18, {}).x);
  const DiscrepancyChoice choice = problem.Choose(0.5 * least);
  EXPECT_FALSE(choice.reached);
  EXPECT_GE(choice.alpha, 1e-12);
  EXPECT_NEAR(choice.misfit, least, 1e-6 * least);
}

// A fit that jumps to another branch on the way down and stays there.
TEST(DiscrepancyPrinciple, RisesAgainOnABranchFoundOnTheWayDown) {
  constexpr double kJump = 1e-3;
  const auto minimize = [](double alpha, const VectorXd& start) {
    const bool is_low = start[1] > 0.0 || alpha < kJump;
    Minimum minimum;
    minimum.x = VectorXd{
        {(is_low ? 1.0 : 10.0) * std::sqrt(alpha), is_low ? 1.0 : 0.0}};
    minimum.summary.termination = Termination::kGradient;
    return minimum;
  };
  const DiscrepancyChoice choice = ChooseByDiscrepancy(
      0.2, VectorXd::Zero(2), minimize, [](const VectorXd& w) { return w[0]; });
  EXPECT_TRUE(choice.reached);
  EXPECT_NEAR(choice.alpha, 0.04, 0.0004);
}

TEST(DiscrepancyPrinciple, EndsWhereAFitIsInterrupted) {
  int fits = 0;
  const DiscrepancyChoice choice = ChooseByDiscrepancy(
      0.1,
      VectorXd::Zero(1),
      [&](double, const VectorXd& start) {
        ++fits;
        Minimum minimum;
        minimum.x = start;
        minimum.summary.termination = Termination::kInterrupted;
        return minimum;
      },
      [](const VectorXd&) { return 1.0; });
  EXPECT_EQ(fits, 1);
  EXPECT_FALSE(choice.reached);
  EXPECT_EQ(choice.minimum.summary.termination, Termination::kInterrupted);
}

TEST(DiscrepancyPrinciple, NeedsAPositiveMisfit) {
  for (const double delta : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT([&] { LinearProblem().Choose(delta); },
                ThrowsMessage<std::invalid_argument>(
                    HasSubstr("delta must be above 0")));
  }
}

}  // namespace
}  // namespace errmap::fitting
