#include "fitting/minimisers/optimizer.h"

#include <cmath>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "tests/fitting/optimizer_cases.h"
#include "tests/fitting/test_problems.h"
#include "tests/numbers.h"

namespace errmap::fitting {

namespace {

using Eigen::VectorXd;
using errmap::testing::Rosenbrock;
using errmap::testing::TestProblem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

ScaledConjugateGradient Scg(const StoppingRules& stopping) {
  ScaledConjugateGradientOptions options;
  options.stopping = stopping;
  return ScaledConjugateGradient(options);
}

// Walks a Path in a fixed way: the base class is to count it.
class PathWalker final : public Optimizer {
 public:
  std::string name() const override { return "walker"; }

 private:
  Minimum DoMinimize(const Objective& f,
                     const VectorXd& x0,
                     const RunControl&) const override {
    const auto path = f.NewPath(x0);
    path->SetDirection(-path->Gradient());
    path->Curvature();
    path->Value(1e-3);
    path->Value(2e-3);
    path->Accept(1e-3);
    path->Gradient();
    path->Gradient();  // not a new one
    Minimum minimum;
    minimum.x = x0;
    minimum.summary.final_cost = f.Evaluate(x0, nullptr);
    return minimum;
  }
};

void ExpectBite(const StoppingRules& rules, const std::string& message) {
  EXPECT_THAT([&] { rules.Validate(); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("StoppingRules: " + message)));
  EXPECT_THROW(Scg(rules), std::invalid_argument);
}

TEST(Termination, HasAWordForEachReason) {
  EXPECT_EQ(ToString(Termination::kDirect), "direct");
  EXPECT_EQ(ToString(Termination::kFailed), "failed");
  EXPECT_EQ(ToString(Termination::kCostGoal), "cost_goal");
  EXPECT_EQ(ToString(Termination::kGradient), "gradient");
  EXPECT_EQ(ToString(Termination::kSlowProgress), "slow_progress");
  EXPECT_EQ(ToString(Termination::kNoDescent), "no_descent");
  EXPECT_EQ(ToString(Termination::kResolution), "cost_resolution");
  EXPECT_EQ(ToString(Termination::kIterationLimit), "iteration_limit");
  EXPECT_EQ(ToString(Termination::kEvaluationLimit), "evaluation_limit");
  EXPECT_EQ(ToString(Termination::kTimeLimit), "time_limit");
  EXPECT_EQ(ToString(Termination::kInterrupted), "interrupted");
}

TEST(Termination, OnlyThreeReasonsClaimAMinimum) {
  EXPECT_TRUE(IsConverged(Termination::kGradient));
  EXPECT_TRUE(IsConverged(Termination::kDirect));
  EXPECT_TRUE(IsConverged(Termination::kResolution));
  for (const Termination other : {Termination::kFailed,
                                  Termination::kCostGoal,
                                  Termination::kSlowProgress,
                                  Termination::kNoDescent,
                                  Termination::kIterationLimit,
                                  Termination::kEvaluationLimit,
                                  Termination::kTimeLimit,
                                  Termination::kInterrupted}) {
    EXPECT_FALSE(IsConverged(other)) << ToString(other);
  }
}

TEST(FitSummary, IsBornSayingThatItHasNotRun) {
  const FitSummary summary;
  EXPECT_EQ(summary.termination, Termination::kFailed);
  EXPECT_FALSE(summary.converged());
  EXPECT_EQ(summary.message, "not run");
  EXPECT_TRUE(std::isnan(summary.initial_cost));
  EXPECT_TRUE(std::isnan(summary.final_cost));
  EXPECT_TRUE(std::isnan(summary.final_gradient_norm));
  EXPECT_TRUE(std::isnan(summary.mean_iteration_seconds));
  EXPECT_TRUE(std::isnan(summary.sd_iteration_seconds));
  EXPECT_EQ(summary.evaluations(), 0);
  EXPECT_THAT(summary.trace, IsEmpty());
}

TEST(StoppingRules, DefaultsPass) {
  EXPECT_NO_THROW(StoppingRules().Validate());
}

TEST(StoppingRules, SmallestAllowedValuesPass) {
  StoppingRules rules;
  rules.iterations = 0;
  rules.evaluations = 1;
  rules.seconds = std::numeric_limits<double>::min();
  rules.cost_goal = 0.0;
  rules.gradient_goal = 0.0;
  rules.slow_ratio = std::numeric_limits<double>::min();
  rules.progress_interval = 1;
  EXPECT_NO_THROW(rules.Validate());
}

TEST(StoppingRules, EachBoundBites) {
  StoppingRules rules;
  rules.iterations = -1;
  ExpectBite(rules, "iterations must be at least 0.000000, found -1.000000");
  rules = {};
  rules.evaluations = 0;
  ExpectBite(rules, "evaluations must be at least 1");
  rules = {};
  rules.progress_interval = 0;
  ExpectBite(rules, "progress_interval must be at least 1");
  for (const double bad : {0.0, -1.0, kNaN}) {
    rules = {};
    rules.seconds = bad;
    ExpectBite(rules, "seconds must be above 0");
    rules = {};
    rules.slow_ratio = bad;
    ExpectBite(rules, "slow_ratio must be above 0");
  }
  for (const double bad : {-1e-3, kNaN}) {
    rules = {};
    rules.cost_goal = bad;
    ExpectBite(rules, "cost_goal must be at least 0");
    rules = {};
    rules.gradient_goal = bad;
    ExpectBite(rules, "gradient_goal must be at least 0");
  }
}

TEST(Minimize, RefusesAStartOfAnotherSize) {
  const TestProblem problem = Rosenbrock();
  EXPECT_THAT(
      [&] { Scg({}).Minimize(*problem.objective, VectorXd::Zero(3)); },
      ThrowsMessage<std::invalid_argument>(
          "Minimize: x0 has 3 elements, the objective has 2 parameters"));
}

TEST(Minimize, RefusesAStartThatIsNotFinite) {
  const TestProblem problem = Rosenbrock();
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_THAT(
        [&] {
          Scg({}).Minimize(*problem.objective, VectorXd{{0.0, bad}});
        },
        ThrowsMessage<std::invalid_argument>(
            "Minimize: x0 must be finite throughout"));
  }
}

TEST(Minimize, CountsWhatAPathIsAskedFor) {
  const TestProblem problem = Rosenbrock();
  const FitSummary summary =
      PathWalker().Minimize(*problem.objective, problem.start).summary;
  // The default path's curvature is a difference of two.
  EXPECT_EQ(summary.gradient_evaluations, 4);
  EXPECT_EQ(summary.curvature_evaluations, 0);
  EXPECT_EQ(summary.value_evaluations, 3);  // two of the path, one of f
  EXPECT_GE(summary.seconds, 0.0);
}

TEST(Minimize, CostGoalIsNoClaimOfAMinimum) {
  constexpr double kGoal = 0.5;
  const TestProblem problem = Rosenbrock();
  StoppingRules rules;
  rules.cost_goal = kGoal;
  const Minimum minimum =
      Scg(rules).Minimize(*problem.objective, problem.start);
  EXPECT_EQ(minimum.summary.termination, Termination::kCostGoal);
  EXPECT_FALSE(minimum.summary.converged());
  EXPECT_LT(std::sqrt(2.0 * minimum.summary.final_cost), kGoal);
}

TEST(Minimize, SlowProgressIsNoClaimOfAMinimum) {
  constexpr double kHalf = 0.5;  // the error is to halve at every step
  const TestProblem problem = Rosenbrock();
  StoppingRules rules;
  rules.slow_ratio = kHalf;
  RunControl run;
  run.keep_trace = true;
  const Minimum minimum =
      Scg(rules).Minimize(*problem.objective, problem.start, run);
  ASSERT_EQ(minimum.summary.termination, Termination::kSlowProgress);
  EXPECT_FALSE(minimum.summary.converged());
  const auto& trace = minimum.summary.trace;
  ASSERT_GE(trace.size(), 2U);
  EXPECT_GT(trace.back().rms_error, kHalf * trace[trace.size() - 2].rms_error);
}

// 1/2 |x|^2 less a constant.
class BelowZero final : public Objective {
 public:
  explicit BelowZero(double lowest) : lowest_(lowest) {}
  Eigen::Index num_parameters() const override { return 2; }
  double Evaluate(const VectorXd& x, VectorXd* gradient) const override {
    if (gradient != nullptr) *gradient = kScales.cwiseProduct(x);
    return 0.5 * x.dot(kScales.cwiseProduct(x)) + lowest_;
  }

 private:
  inline static const Eigen::Vector2d kScales{1.0, 50.0};
  double lowest_;
};

TEST(Minimize, StopsAtSlowProgressBelowZeroAsAbove) {
  for (const double lowest : {-1e4, 1e4}) {
    const auto end = [&](double ratio) {
      return Scg({.slow_ratio = ratio})
          .Minimize(BelowZero(lowest), VectorXd{{3.0, 2.0}})
          .summary.termination;
    };
    // The first step gains a hundredth of the cost, half of that of its root.
    EXPECT_EQ(end(1.0 - 0.01), Termination::kSlowProgress) << lowest;
    EXPECT_EQ(end(1.0), Termination::kGradient) << lowest;  // only growth stops
  }
}

TEST(Minimize, TracesCostsBelowZero) {
  const FitSummary summary =
      Scg({})
          .Minimize(
              BelowZero(-50.0), VectorXd{{3.0, 2.0}}, {.keep_trace = true})
          .summary;
  ASSERT_GE(summary.trace.size(), 2U);
  EXPECT_GT(summary.trace.front().rms_error, 0.0);
  EXPECT_DOUBLE_EQ(summary.trace.back().rms_error, -10.0);
  for (std::size_t i = 1; i < summary.trace.size(); ++i) {
    EXPECT_LE(summary.trace[i].rms_error, summary.trace[i - 1].rms_error);
  }
}

TEST(Minimize, MeasuresTheSecondsOfAnIteration) {
  const TestProblem problem = Rosenbrock();
  StoppingRules rules;
  rules.iterations = 20;
  const FitSummary many =
      Scg(rules).Minimize(*problem.objective, problem.start).summary;
  ASSERT_EQ(many.iterations, rules.iterations);
  EXPECT_GT(many.mean_iteration_seconds, 0.0);
  EXPECT_GE(many.sd_iteration_seconds, 0.0);
  EXPECT_LE(many.mean_iteration_seconds * static_cast<double>(many.iterations),
            many.seconds);
  rules.iterations = 1;  // one number has no spread
  const FitSummary one =
      Scg(rules).Minimize(*problem.objective, problem.start).summary;
  EXPECT_GT(one.mean_iteration_seconds, 0.0);
  EXPECT_TRUE(std::isnan(one.sd_iteration_seconds));
  rules.iterations = 0;
  const FitSummary none =
      Scg(rules).Minimize(*problem.objective, problem.start).summary;
  EXPECT_TRUE(std::isnan(none.mean_iteration_seconds));
  EXPECT_TRUE(std::isnan(none.sd_iteration_seconds));
}

TEST(Minimize, KeepsNoTraceUnlessAsked) {
  const TestProblem problem = Rosenbrock();
  EXPECT_THAT(Scg({}).Minimize(*problem.objective, problem.start).summary.trace,
              IsEmpty());
}

}  // namespace
}  // namespace errmap::fitting
