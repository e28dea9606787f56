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
using ::testing::Property;
using ::testing::Throws;

// |A w - z|^2 + alpha |w|^2 has its minimum in closed form.
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

  DiscrepancyChoice Choose(const DiscrepancyRules& rules) {
    return ChooseByDiscrepancy(
        rules,
        zero(),
        [this](double alpha, const VectorXd& start) {
          return Minimize(alpha, start);
        },
        [this](const VectorXd& w) { return Misfit(w); });
  }

  int fits = 0;
  VectorXd last_start;

 private:
  MatrixXd a_ = RandomMatrix(20, 6, 3);
  VectorXd z_ = RandomMatrix(20, 1, 4).col(0);
};

TEST(DiscrepancyPrinciple, FindsAlphaToOnePercent) {
  LinearProblem problem;
  const double least = problem.Misfit(problem.Minimize(1e-14, {}).x);
  const double most = problem.Misfit(problem.zero());
  for (const double share : {0.1, 0.5, 0.9}) {
    const double delta = least + share * (most - least);
    const DiscrepancyChoice choice =
        problem.Choose({.delta = delta, .alpha0 = 1e3});
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
  const double delta = problem.Misfit(problem.Minimize(0.3, {}).x);
  const DiscrepancyChoice choice =
      problem.Choose({.delta = delta, .alpha0 = 64.0, .q = 0.25});
  ASSERT_GE(choice.steps.size(), 5U);
  const double expected[] = {64.0, 16.0, 4.0, 1.0, 0.25};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(choice.steps[i].alpha, expected[i]);
  }
  EXPECT_NEAR(choice.alpha, 0.3, 0.003);
  EXPECT_NE(problem.last_start, problem.zero());
}

TEST(DiscrepancyPrinciple, TakesAlpha0WhereItIsSmallEnough) {
  LinearProblem problem;
  const DiscrepancyChoice choice =
      problem.Choose({.delta = 1e6, .alpha0 = 0.5});
  EXPECT_TRUE(choice.reached);
  EXPECT_EQ(choice.alpha, 0.5);
  EXPECT_EQ(problem.fits, 1);
}

TEST(DiscrepancyPrinciple, SaysThatDeltaIsNotReached) {
  LinearProblem problem;
  const double least = problem.Misfit(problem.Minimize(1e-14, {}).x);
  const DiscrepancyChoice choice =
      problem.Choose({.delta = 0.5 * least, .least_alpha = 1e-6});
  EXPECT_FALSE(choice.reached);
  EXPECT_GE(choice.alpha, 1e-6);
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
      {.delta = 0.2}, VectorXd::Zero(2), minimize, [](const VectorXd& w) {
        return w[0];
      });
  EXPECT_TRUE(choice.reached);
  EXPECT_NEAR(choice.alpha, 0.04, 0.0004);
}

TEST(DiscrepancyPrinciple, EndsWhereAFitIsInterrupted) {
  int fits = 0;
  const DiscrepancyChoice choice = ChooseByDiscrepancy(
      {.delta = 0.1},
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

TEST(DiscrepancyRules, EachBoundBites) {
  const auto message = [](DiscrepancyRules rules, const char* field) {
    EXPECT_THAT([&] { rules.Validate(); },
                Throws<std::invalid_argument>(
                    Property(&std::exception::what, HasSubstr(field))));
  };
  EXPECT_NO_THROW(DiscrepancyRules{.delta = 1.0}.Validate());
  message({.delta = 0.0}, "delta");
  message({.delta = std::numeric_limits<double>::quiet_NaN()}, "delta");
  message({.delta = 1.0, .alpha0 = 0.0}, "alpha0");
  message({.delta = 1.0, .q = 1.0}, "q must be between");
  message({.delta = 1.0, .least_alpha = 0.0}, "least_alpha");
  message({.delta = 1.0, .tolerance = 0.0}, "tolerance");
}

}  // namespace
}  // namespace errmap::fitting
