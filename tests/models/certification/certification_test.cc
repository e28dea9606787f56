#include "models/certification/certification.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/minimisers/gradient_check.h"
#include "models/certification/net_example.h"
#include "models/certification/solvers.h"
#include "models/certification/strd_functions.h"
#include "models/net/feedforward_net.h"

namespace errmap::models {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A gradient that is wrong by a factor in one component.
class LyingObjective final : public fitting::Objective {
 public:
  LyingObjective(const fitting::Objective& truth, double factor)
      : truth_(truth), factor_(factor) {}

  Eigen::Index num_parameters() const override {
    return truth_.num_parameters();
  }
  double Evaluate(const Eigen::VectorXd& x,
                  Eigen::VectorXd* gradient) const override {
    const double value = truth_.Evaluate(x, gradient);
    if (gradient != nullptr) (*gradient)[0] *= factor_;
    return value;
  }

 private:
  const fitting::Objective& truth_;
  double factor_;
};

// The same in the Jacobian; the gradient is right.
class LyingJacobian final : public fitting::Objective,
                            private fitting::ResidualFunction {
 public:
  LyingJacobian(const fitting::Objective& truth, double factor)
      : truth_(truth), factor_(factor) {}

  Eigen::Index num_parameters() const override {
    return truth_.num_parameters();
  }
  double Evaluate(const Eigen::VectorXd& x,
                  Eigen::VectorXd* gradient) const override {
    return truth_.Evaluate(x, gradient);
  }
  const fitting::ResidualFunction* residuals() const override { return this; }

 private:
  Eigen::Index num_residuals() const override {
    return truth_.residuals()->num_residuals();
  }
  double ridge() const override { return truth_.residuals()->ridge(); }
  void Evaluate(const Eigen::VectorXd& x,
                Eigen::VectorXd* residuals,
                Eigen::MatrixXd* jacobian) const override {
    truth_.residuals()->Evaluate(x, residuals, jacobian);
    if (jacobian != nullptr) jacobian->col(0) *= factor_;
  }

  const fitting::Objective& truth_;
  double factor_;
};

constexpr double kWrong = 1.001;

TEST(CertifyGradient, FindsAFactorOfOnePerMille) {
  const NetExampleShape shape = NetExampleShapes()[1];
  const NetObjective net = MakeNetExample(shape);
  const Eigen::VectorXd w = InitialWeights(shape.shape, 1);
  Certification certification;
  CertifyGradient("right", net, w, 0.0, &certification);
  CertifyGradient("wrong", LyingObjective(net, kWrong), w, 0.0, &certification);
  EXPECT_LT(certification.gradients[0].worst_relative_error, 1e-7);
  EXPECT_NEAR(certification.gradients[1].worst_relative_error, 1e-3, 1e-5);
  JudgeFloors({}, &certification);
  EXPECT_FALSE(certification.passed());
  ASSERT_THAT(certification.missed, SizeIs(1));
  EXPECT_THAT(certification.missed[0],
              HasSubstr("gradient of wrong: 1.0e-03, at most 1e-06"));
}

TEST(CertifyGradient, FindsAWrongJacobianBehindARightGradient) {
  for (const data::StrdProblem& problem : data::StrdProblems()) {
    if (problem.name != "Misra1a" && problem.name != "ENSO") continue;
    const auto function = MakeStrdFunction(problem);
    const fitting::RegressionObjective truth(*function);
    Certification certification;
    const Eigen::VectorXd x = StrdStart(problem, 2);
    CertifyGradient(
        "wrong", LyingJacobian(truth, kWrong), x, 0.0, &certification);
    EXPECT_GT(certification.gradients[0].worst_relative_error, 5e-4)
        << problem.name;
  }
}

TEST(CertifyGradient, CountsANaNAsTheWorst) {
  const NetExampleShape shape = NetExampleShapes()[0];
  const NetObjective net = MakeNetExample(shape);
  Certification certification;
  CertifyGradient("NaN",
                  LyingObjective(net, std::nan("")),
                  InitialWeights(shape.shape, 1),
                  0.0,
                  &certification);
  JudgeFloors({}, &certification);
  EXPECT_FALSE(certification.passed());
}

TEST(JudgeFloors, PassesWhatReachesThemAndNamesWhatDoesNot) {
  Certification certification;
  certification.linear.push_back({.problem = "Filip",
                                  .lre_coefficients = 14.0,
                                  .lre_sd = 14.0,
                                  .lre_rss = 14.0});
  JudgeFloors({}, &certification);
  EXPECT_THAT(certification.missed, IsEmpty());
  certification.linear[0].lre_sd = 12.9;
  certification.univariate.push_back({.problem = "NumAcc4",
                                      .lre_mean = 15.0,
                                      .lre_sd = 8.2,
                                      .lre_autocorrelation = 15.0,
                                      .lre_mean_double = 15.0,
                                      .lre_sd_double = 8.2,
                                      .lre_autocorrelation_double = 11.0});
  certification.agreement.push_back(
      {.solver = "scg", .difference = std::nan(""), .stop = "failed"});
  JudgeFloors({}, &certification);
  EXPECT_THAT(certification.missed,
              Contains(HasSubstr("Filip, standard deviations: 12.90")));
  EXPECT_THAT(certification.missed,
              Contains(HasSubstr("scg, objective above the lowest")));
  EXPECT_THAT(certification.missed, Not(Contains(HasSubstr("NumAcc4"))));
}

TEST(JudgeFloors, HoldsRunsOfTheDefaultSolverToTheirDigits) {
  Certification certification;
  NonlinearCertificate row;
  row.problem = "MGH10";
  row.solver = "cg";
  certification.nonlinear.push_back(row);
  JudgeFloors({}, &certification);
  EXPECT_TRUE(certification.passed());
  certification.nonlinear[0].solver = kDefaultSolver;
  JudgeFloors({}, &certification);
  EXPECT_THAT(certification.missed, SizeIs(3));
}

TEST(JudgeFloors, BelievesNoClaimOfAMinimumWithoutDigits) {
  Certification certification;
  certification.nonlinear.push_back({.problem = "Nelson",
                                     .solver = "cg",
                                     .lre_rss = 3.9,
                                     .claims_minimum = true});
  JudgeFloors({}, &certification);
  EXPECT_THAT(certification.missed,
              Contains(HasSubstr("cg claims a minimum; sum of squares: 3.90")));
  certification.nonlinear[0].other_minimum = "there are two";
  JudgeFloors({}, &certification);
  EXPECT_TRUE(certification.passed());
}

TEST(JudgeFloors, ExemptsNoSolver) {
  Certification certification;
  certification.nonlinear_summary.push_back({.solver = "cg",
                                             .runs = 54,
                                             .solved = 17,
                                             .mean_lre_parameters = 2.9,
                                             .floor_solved = 18,
                                             .floor_mean_lre_parameters = 3.0});
  certification.agreement.push_back({.solver = "nlopt:mma",
                                     .difference = 2e-3,
                                     .most_difference = 1e-3,
                                     .most_prediction_difference = 2e-2});
  JudgeFloors({}, &certification);
  EXPECT_THAT(certification.missed, SizeIs(3));
  for (const CertifiedSolver& solver : CertifiedSolvers()) {
    EXPECT_TRUE(solver.floors.solved > 0 || !solver.fits_formulas)
        << solver.name;
    EXPECT_LE(solver.floors.agreement_difference, 1e-3) << solver.name;
  }
}

// What is declared linear must be: the second difference of r vanishes.
TEST(MakeStrdFunction, LinearParametersAreLinear) {
  int declared = 0;
  for (const data::StrdProblem& problem : data::StrdProblems()) {
    if (problem.kind != data::StrdKind::kNonlinear) continue;
    const auto function = MakeStrdFunction(problem);
    const Eigen::VectorXd b = StrdStart(problem, 2);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(b.size());
    for (const Eigen::Index j : function->linear_parameters()) {
      step[j] = 0.25 * static_cast<double>(j + 1) * b[j];
      ++declared;
    }
    const auto residuals = [&](const Eigen::VectorXd& at) {
      Eigen::VectorXd r;
      function->Evaluate(at, &r, nullptr);
      return r;
    };
    const Eigen::VectorXd middle = residuals(b);
    const Eigen::VectorXd above = residuals(b + step);
    const Eigen::VectorXd bend = above + residuals(b - step) - 2.0 * middle;
    EXPECT_LE(bend.norm(), 1e-12 * (above.norm() + middle.norm()))
        << problem.name;
  }
  EXPECT_GT(declared, 27);
}

TEST(MakeStrdFunction, RefusesAProblemWithoutItsModel) {
  data::StrdProblem problem = data::StrdProblems().front();
  EXPECT_THROW(StrdStart(problem, 3), std::invalid_argument);
  problem.parameters.pop_back();
  EXPECT_THROW(MakeStrdFunction(problem), std::invalid_argument);
  problem.name = "Nobody1";
  EXPECT_THROW(MakeStrdFunction(problem), std::invalid_argument);
}

// An objective that goes flat, to NaN or to infinity beside the start.
class Trap final : public fitting::Objective {
 public:
  explicit Trap(double beyond) : beyond_(beyond) {}
  Eigen::Index num_parameters() const override { return 2; }
  double Evaluate(const Eigen::VectorXd& x,
                  Eigen::VectorXd* gradient) const override {
    if (gradient != nullptr) *gradient = x;
    if (x.norm() >= kEdge) return 0.5 * x.squaredNorm();
    if (gradient != nullptr) gradient->setZero();
    return beyond_;
  }

 private:
  static constexpr double kEdge = 0.5;
  double beyond_;
};

TEST(CertifiedSolvers, NeverClaimAMinimumBesideATrap) {
  for (const double beyond : {std::nan(""), HUGE_VAL, 1e3}) {
    for (const CertifiedSolver& solver : CertifiedSolvers()) {
      if (solver.needs_residuals) continue;
      const fitting::Minimum minimum =
          solver.make({.iterations = 200, .evaluations = 5000})
              ->Minimize(Trap(beyond), Eigen::Vector2d(1.0, 0.8));
      EXPECT_FALSE(minimum.summary.converged()) << solver.name << beyond;
      EXPECT_TRUE(std::isfinite(minimum.summary.final_cost)) << solver.name;
    }
  }
}

// Rosenbrock's valley, which counts what it is asked.
class CountedValley final : public fitting::Objective,
                            private fitting::ResidualFunction {
 public:
  Eigen::Index num_parameters() const override { return 2; }
  double Evaluate(const Eigen::VectorXd& x,
                  Eigen::VectorXd* gradient) const override {
    ++evaluations_;
    Eigen::VectorXd r;
    Eigen::MatrixXd jacobian;
    Fill(x, &r, &jacobian);
    if (gradient != nullptr) *gradient = jacobian.transpose() * r;
    return 0.5 * r.squaredNorm();
  }
  const fitting::ResidualFunction* residuals() const override { return this; }
  std::int64_t evaluations() const { return evaluations_; }

 private:
  static void Fill(const Eigen::VectorXd& x,
                   Eigen::VectorXd* r,
                   Eigen::MatrixXd* jacobian) {
    *r = Eigen::Vector2d(10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]);
    *jacobian = Eigen::Matrix2d{{-20.0 * x[0], 10.0}, {-1.0, 0.0}};
  }
  Eigen::Index num_residuals() const override { return 2; }
  double ridge() const override { return 0.0; }
  void Evaluate(const Eigen::VectorXd& x,
                Eigen::VectorXd* residuals,
                Eigen::MatrixXd* jacobian) const override {
    ++evaluations_;
    Eigen::MatrixXd unused;
    Fill(x, residuals, jacobian != nullptr ? jacobian : &unused);
  }

  mutable std::int64_t evaluations_ = 0;
};

TEST(CertifiedSolvers, StopAtOneCountOfEvaluationsWithinAStep) {
  constexpr std::int64_t kOfAStep = 6;
  std::size_t judged = 0;
  for (const std::int64_t limit : {8, 12, 16, 20}) {
    for (const CertifiedSolver& solver : CertifiedSolvers()) {
      if (!solver.fits_formulas) continue;  // its rate diverges in the valley
      ++judged;
      const CountedValley f;
      const fitting::FitSummary summary =
          solver.make({.evaluations = limit, .gradient_goal = 0.0})
              ->Minimize(f, Eigen::Vector2d(-1.2, 1.0))
              .summary;
      EXPECT_EQ(summary.termination, fitting::Termination::kEvaluationLimit)
          << solver.name << ": " << summary.message;
      EXPECT_EQ(summary.evaluations(), f.evaluations()) << solver.name;
      EXPECT_LE(f.evaluations(), limit) << solver.name;
      EXPECT_GT(f.evaluations(), limit - kOfAStep) << solver.name;
    }
  }
  EXPECT_EQ(judged, 4U * 17U);
}

// At the limit of iterations that the commands have.
TEST(CertifiedSolvers, ConjugateGradientsComeNearTheBestOnTenNets) {
  const auto cost = [](const std::string& name,
                       const NetExampleShape& example,
                       std::uint64_t seed) {
    const NetObjective objective = MakeNetExample(example);
    for (const CertifiedSolver& solver : CertifiedSolvers()) {
      if (solver.name != name) continue;
      return solver.make({.iterations = 1500})
          ->Minimize(objective, InitialWeights(example.shape, seed))
          .summary.final_cost;
    }
    return std::nan("");
  };
  for (const NetExampleShape& example : NetExampleShapes()) {
    for (const std::uint64_t seed : {1U, 2U}) {
      const double found = cost("cg", example, seed);
      for (const char* other : {"lm:unscaled", "scg:moller", "ceres:bfgs"}) {
        EXPECT_LT(found, 2.0 * cost(other, example, seed))
            << example.name << " from " << seed << ", " << other;
      }
    }
  }
}

TEST(CertifiedSolvers, RefuseObjectivesWithoutResidualsByAThrow) {
  for (const CertifiedSolver& solver : CertifiedSolvers()) {
    if (!solver.needs_residuals) continue;
    EXPECT_THROW(solver.make({})->Minimize(Trap(0.0), Eigen::Vector2d(1, 1)),
                 std::invalid_argument)
        << solver.name;
  }
}

}  // namespace
}  // namespace errmap::models
