#include "models/net/net_residuals.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "fitting/minimisers/gradient_check.h"
#include "fitting/minimisers/levenberg_marquardt.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "models/net/net_objective.h"
#include "tests/models/net/net_test_cases.h"
#include "tests/random_matrix.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::ManyNets;
using errmap::testing::NetCase;
using errmap::testing::RandomMatrix;

// Sums of up to some thousand products, in another order.
constexpr double kNetResidualsRounding = 1e-12;

class NetResidualsOf : public ::testing::TestWithParam<NetCase> {};

TEST_P(NetResidualsOf, AreTheObjectiveInAnotherForm) {
  const NetObjective objective = GetParam().Objective<double>();
  const VectorXd w = GetParam().Point();
  VectorXd gradient;
  const double cost = objective.Evaluate(w, &gradient);
  const fitting::ResidualFunction& form = *objective.residuals();
  VectorXd r;
  MatrixXd j;
  form.Evaluate(w, &r, &j);
  ASSERT_EQ(r.size(), form.num_residuals());
  ASSERT_EQ(j.rows(), r.size());
  ASSERT_EQ(j.cols(), w.size());
  EXPECT_NEAR(0.5 * r.squaredNorm() + 0.5 * form.ridge() * w.squaredNorm(),
              cost,
              kNetResidualsRounding * cost);
  EXPECT_LT((j.transpose() * r + form.ridge() * w - gradient).norm(),
            kNetResidualsRounding * gradient.norm());
  VectorXd alone;
  form.Evaluate(w, &alone, nullptr);
  EXPECT_EQ(alone, r);
}

TEST_P(NetResidualsOf, HaveTheJacobianOfTheirDifferences) {
  constexpr double kRidders = 1e-8;
  constexpr Index kMostRows = 50;  // of the first ones, for time
  const NetObjective objective = GetParam().Objective<double>();
  const fitting::ResidualFunction& form = *objective.residuals();
  const VectorXd w = GetParam().Point();
  const VectorXd v = GetParam().Direction();
  VectorXd r;
  MatrixXd j;
  form.Evaluate(w, &r, &j);
  const VectorXd along = j * v;
  for (Index i = 0; i < std::min(kMostRows, r.size()); ++i) {
    const auto residual = [&](double a) {
      form.Evaluate(w + a * v, &r, nullptr);
      return r[i];
    };
    EXPECT_NEAR(along[i],
                fitting::RiddersDerivative(residual, 0.0, 0.1).value,
                kRidders * along.norm());
  }
}

TEST_P(NetResidualsOf, LinearizeAsTheirJacobianDoes) {
  constexpr Index kMostResiduals = 3000;
  const NetObjective objective = GetParam().Objective<double>();
  const fitting::ResidualFunction& form = *objective.residuals();
  if (form.num_residuals() > kMostResiduals) {
    GTEST_SKIP() << "J J' would fill the memory";
  }
  const auto linearization = form.NewLinearization();
  VectorXd r;
  VectorXd found_r;
  MatrixXd j;
  MatrixXd gram;
  for (const double factor : {3.0, 1.0}) {
    const VectorXd w = factor * GetParam().Point();
    form.Evaluate(w, &r, &j);
    linearization->MoveTo(w, &found_r, &gram);
    EXPECT_EQ(found_r, r);
    const MatrixXd expected = j * j.transpose();
    const MatrixXd difference = gram - expected;
    EXPECT_LT(MatrixXd(difference.triangularView<Eigen::Lower>()).norm(),
              kNetResidualsRounding * expected.norm());
    const VectorXd v = GetParam().Direction();
    EXPECT_LT((linearization->Apply(v) - j * v).norm(),
              kNetResidualsRounding * j.norm() * v.norm());
    const VectorXd u = RandomMatrix(r.size(), 1, 6);
    EXPECT_LT((linearization->ApplyTransposed(u) - j.transpose() * u).norm(),
              kNetResidualsRounding * j.norm() * u.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         NetResidualsOf,
                         ::testing::ValuesIn(ManyNets()),
                         [](const ::testing::TestParamInfo<NetCase>& instance) {
                           return instance.param.Name();
                         });

TEST(NetResiduals, AreNotGivenInSinglePrecision) {
  const NetCase net = ManyNets().front();
  EXPECT_EQ(net.Objective<float>().residuals(), nullptr);
  EXPECT_NE(net.Objective<double>().residuals(), nullptr);
}

// A well-damped net has one minimum near the start: any method must find it.
TEST(NetResiduals, LeadToTheMinimumOfScaledConjugateGradients) {
  constexpr double kSameCost = 1e-12;
  constexpr double kWfactor = 1.0;
  const fitting::StoppingRules rules{.iterations = 20'000,
                                     .gradient_goal = 1e-8};
  const NetShape shape{2, 5, 1};
  for (const Index patterns : {10, 60}) {  // fewer and more than weights
    SCOPED_TRACE(patterns);
    const NetObjective objective(shape,
                                 RandomMatrix(patterns, 2, 1),
                                 RandomMatrix(patterns, 1, 2).cwiseAbs(),
                                 kWfactor);
    const VectorXd start = 0.5 * RandomMatrix(shape.num_weights(), 1, 3);
    const fitting::Minimum scg =
        fitting::ScaledConjugateGradient({.stopping = rules})
            .Minimize(objective, start);
    const fitting::Minimum lm = fitting::LevenbergMarquardt({.stopping = rules})
                                    .Minimize(objective, start);
    EXPECT_EQ(lm.summary.termination, fitting::Termination::kGradient)
        << lm.summary.message;
    EXPECT_EQ(scg.summary.termination, fitting::Termination::kGradient);
    EXPECT_NEAR(lm.summary.final_cost,
                scg.summary.final_cost,
                kSameCost * scg.summary.final_cost);
    // Two gradients below the goal, where no curvature is below the ridge.
    EXPECT_LT((lm.x - scg.x).norm(),
              2.0 * rules.gradient_goal * std::max(1.0, scg.x.norm()) /
                  objective.residuals()->ridge());
    EXPECT_LT(lm.summary.iterations, scg.summary.iterations);
  }
}

}  // namespace
}  // namespace errmap::models
