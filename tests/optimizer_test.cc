#include "fitting/optimizer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/scaled_conjugate_gradient.h"
#include "tests/test_problems.h"

namespace errmap::fitting {

// The word in failure messages.
static void PrintTo(Termination termination, std::ostream* out) {
  *out << ToString(termination);
}

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using errmap::testing::AllTestProblems;
using errmap::testing::FunctionObjective;
using errmap::testing::Rosenbrock;
using errmap::testing::TestProblem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Counts and keeps what it is asked, itself.
class WatchedObjective final : public Objective {
 public:
  explicit WatchedObjective(const Objective& objective)
      : objective_(objective) {}

  Index num_parameters() const override { return objective_.num_parameters(); }

  double Evaluate(const Vector& x, Vector* gradient) const override {
    ++(gradient == nullptr ? values_ : gradients_);
    const double value = objective_.Evaluate(x, gradient);
    points_.push_back(x);
    costs_.push_back(value);
    if (after_each_) after_each_();
    return value;
  }

  void AfterEach(std::function<void()> action) {
    after_each_ = std::move(action);
  }
  std::int64_t values() const { return values_; }
  std::int64_t gradients() const { return gradients_; }
  std::int64_t evaluations() const { return values_ + gradients_; }
  const std::vector<VectorXd>& points() const { return points_; }
  const std::vector<double>& costs() const { return costs_; }

 private:
  const Objective& objective_;
  std::function<void()> after_each_;
  mutable std::int64_t values_ = 0;
  mutable std::int64_t gradients_ = 0;
  mutable std::vector<VectorXd> points_;
  mutable std::vector<double> costs_;
};

// Ended for its own reasons, before any budget.
bool EndedByItself(const FitSummary& summary) {
  return summary.converged() || summary.termination == Termination::kNoDescent;
}

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
  EXPECT_EQ(ToString(Termination::kIterationLimit), "iteration_limit");
  EXPECT_EQ(ToString(Termination::kEvaluationLimit), "evaluation_limit");
  EXPECT_EQ(ToString(Termination::kTimeLimit), "time_limit");
  EXPECT_EQ(ToString(Termination::kInterrupted), "interrupted");
}

TEST(Termination, OnlyASmallGradientOrADirectSolutionIsAMinimum) {
  EXPECT_TRUE(IsConverged(Termination::kGradient));
  EXPECT_TRUE(IsConverged(Termination::kDirect));
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
  EXPECT_EQ(summary.gradient_evaluations, 2);
  EXPECT_EQ(summary.curvature_evaluations, 1);
  EXPECT_EQ(summary.value_evaluations, 3);  // two of the path, one of f
  EXPECT_GE(summary.seconds, 0.0);
}

TEST(Minimize, AnInfeasibleStartFailsWithAReason) {
  const VectorXd start{{0.5, 0.5}};
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    const FunctionObjective no_value(
        2, [bad](const VectorXd& x, VectorXd* gradient) {
          if (gradient != nullptr) *gradient = x;
          return bad;
        });
    const FunctionObjective no_gradient(
        2, [bad](const VectorXd&, VectorXd* gradient) {
          if (gradient != nullptr) *gradient << 1.0, bad;
          return 1.0;
        });
    for (const Objective* f :
         std::vector<const Objective*>{&no_value, &no_gradient}) {
      const Minimum minimum = Scg({}).Minimize(*f, start);
      EXPECT_EQ(minimum.summary.termination, Termination::kFailed);
      EXPECT_FALSE(minimum.summary.converged());
      EXPECT_EQ(minimum.summary.message,
                "the cost or its gradient is not finite at the start");
      EXPECT_EQ(minimum.summary.iterations, 0);
      EXPECT_EQ(minimum.summary.evaluations(), 1);
      EXPECT_EQ(minimum.x, start);
    }
  }
}

// A region of f = -infinity is infeasible like one of NaN or +infinity.
TEST(Minimize, NeverEndsWhereTheObjectiveIsNotFinite) {
  for (const double outside : {kNaN, kInfinity, -kInfinity}) {
    const FunctionObjective f(
        1, [outside](const VectorXd& x, VectorXd* gradient) {
          // (x - 1)^2 seen up to x = 0.5 only: the way down leads outside.
          if (gradient != nullptr) {
            (*gradient)[0] = x[0] > 0.5 ? kNaN : 2.0 * (x[0] - 1.0);
          }
          return x[0] > 0.5 ? outside : (x[0] - 1.0) * (x[0] - 1.0);
        });
    const Minimum minimum = Scg({}).Minimize(f, VectorXd{{-3.0}});
    EXPECT_TRUE(std::isfinite(minimum.summary.final_cost)) << outside;
    EXPECT_LE(minimum.x[0], 0.5) << outside;
    EXPECT_LE(minimum.summary.final_cost, minimum.summary.initial_cost);
    EXPECT_FALSE(minimum.summary.converged()) << outside;
  }
}

// What must hold for every optimizer on every problem, however it ends.
class OptimizerOnProblem : public ::testing::TestWithParam<TestProblem> {
 protected:
  // True to what the summary says, by the problem's own word.
  void ExpectTruthful(const Minimum& minimum,
                      const WatchedObjective& watched,
                      const StoppingRules& rules) const {
    const TestProblem& problem = GetParam();
    const FitSummary& summary = minimum.summary;
    VectorXd gradient;
    const double cost = problem.objective->Evaluate(minimum.x, &gradient);
    EXPECT_EQ(summary.final_cost, cost);
    EXPECT_EQ(summary.final_gradient_norm, gradient.norm());
    EXPECT_LE(summary.final_cost, summary.initial_cost);
    EXPECT_EQ(summary.value_evaluations, watched.values());
    EXPECT_EQ(summary.gradient_evaluations, watched.gradients());
    EXPECT_LE(summary.iterations, rules.iterations);
    EXPECT_LE(summary.evaluations(), rules.evaluations);
    EXPECT_THAT(summary.message, Not(IsEmpty()));
    EXPECT_NE(summary.message, "not run");
    if (summary.termination == Termination::kGradient) {
      EXPECT_TRUE(gradient.norm() == 0.0 ||
                  gradient.norm() <
                      rules.gradient_goal * std::max(1.0, minimum.x.norm()))
          << "claims a minimum with a gradient of " << gradient.norm();
    }
    if (summary.termination == Termination::kIterationLimit) {
      EXPECT_EQ(summary.iterations, rules.iterations);
    }
  }
};

TEST_P(OptimizerOnProblem, ClaimsAMinimumOnlyWhereTheGradientIsSmall) {
  for (const double goal : {1e-2, 1e-6, 1e-12, 0.0}) {
    StoppingRules rules;
    rules.iterations = 5000;
    rules.gradient_goal = goal;
    const WatchedObjective watched(*GetParam().objective);
    const Minimum minimum = Scg(rules).Minimize(watched, GetParam().start);
    SCOPED_TRACE("gradient goal " + std::to_string(goal));
    ExpectTruthful(minimum, watched, rules);
  }
}

TEST_P(OptimizerOnProblem, FindsTheMinimum) {
  // A gradient of 1e-6 on Hessians whose least eigenvalue is about 0.1.
  constexpr double kNear = 1e-4;
  constexpr double kCost = 1e-6;
  StoppingRules rules;
  rules.iterations = 5000;
  rules.gradient_goal = 1e-6;
  const Minimum minimum =
      Scg(rules).Minimize(*GetParam().objective, GetParam().start);
  EXPECT_EQ(minimum.summary.termination, Termination::kGradient)
      << minimum.summary.message;
  EXPECT_NEAR(minimum.summary.final_cost, GetParam().minimum_value, kCost);
  if (GetParam().regular) {
    EXPECT_LT((minimum.x - GetParam().minimum).norm(), kNear);
  }
}

TEST_P(OptimizerOnProblem, GivesBackTheBestPointOfItsTrace) {
  for (const std::int64_t iterations : {1, 2, 3, 5, 10, 20, 50, 200}) {
    StoppingRules rules;
    rules.iterations = iterations;
    RunControl run;
    run.keep_trace = true;
    const WatchedObjective watched(*GetParam().objective);
    const Minimum minimum = Scg(rules).Minimize(watched, GetParam().start, run);
    ExpectTruthful(minimum, watched, rules);
    const auto& trace = minimum.summary.trace;
    ASSERT_EQ(static_cast<std::int64_t>(trace.size()),
              minimum.summary.iterations + 1);
    EXPECT_EQ(trace.front().rms_error,
              std::sqrt(2.0 * minimum.summary.initial_cost));
    for (std::size_t i = 1; i < trace.size(); ++i) {
      EXPECT_EQ(trace[i].iteration, static_cast<std::int64_t>(i));
      EXPECT_LE(trace[i].rms_error, trace[i - 1].rms_error);
    }
    EXPECT_EQ(trace.back().rms_error,
              std::sqrt(2.0 * minimum.summary.final_cost));
    EXPECT_EQ(trace.back().gradient_norm, minimum.summary.final_gradient_norm);
  }
}

// Points a difference quotient's step away serve the curvature; of all others
// the one given back has the lowest cost.
TEST_P(OptimizerOnProblem, GivesBackTheBestPointSeen) {
  const double sigma = ScaledConjugateGradientOptions().sigma;
  constexpr double kMargin = 1.01;  // rounding of the step's length
  for (const std::int64_t evaluations : {2, 3, 4, 7, 12, 25, 60, 301}) {
    StoppingRules rules;
    rules.evaluations = evaluations;
    const WatchedObjective watched(*GetParam().objective);
    const Minimum minimum = Scg(rules).Minimize(watched, GetParam().start);
    const double scale = minimum.x.norm() > 0.0 ? minimum.x.norm() : 1.0;
    for (std::size_t i = 0; i < watched.points().size(); ++i) {
      const double distance = (watched.points()[i] - minimum.x).norm();
      if (distance <= kMargin * sigma * scale) continue;
      EXPECT_FALSE(watched.costs()[i] < minimum.summary.final_cost)
          << "evaluation " << i << " of " << watched.evaluations();
    }
  }
}

TEST_P(OptimizerOnProblem, IterationBudgetHoldsExactly) {
  for (const std::int64_t iterations : {0, 1, 2, 5, 10}) {
    StoppingRules rules;
    rules.iterations = iterations;
    const WatchedObjective watched(*GetParam().objective);
    const Minimum minimum = Scg(rules).Minimize(watched, GetParam().start);
    ExpectTruthful(minimum, watched, rules);
    if (iterations == 0) {
      EXPECT_EQ(minimum.x, GetParam().start);
      EXPECT_EQ(watched.evaluations(), 1);
    }
    if (!EndedByItself(minimum.summary)) {
      EXPECT_EQ(minimum.summary.termination, Termination::kIterationLimit);
      EXPECT_EQ(minimum.summary.iterations, iterations);
    }
  }
}

TEST_P(OptimizerOnProblem, EvaluationBudgetHoldsExactly) {
  // A pass takes two evaluations or one: one may be left over, never missing.
  constexpr std::int64_t kMostOfAPass = 2;
  for (std::int64_t evaluations = 1; evaluations <= 25; ++evaluations) {
    StoppingRules rules;
    rules.evaluations = evaluations;
    const WatchedObjective watched(*GetParam().objective);
    const Minimum minimum = Scg(rules).Minimize(watched, GetParam().start);
    ExpectTruthful(minimum, watched, rules);
    EXPECT_LE(watched.evaluations(), evaluations);
    if (!EndedByItself(minimum.summary)) {
      EXPECT_EQ(minimum.summary.termination, Termination::kEvaluationLimit);
      EXPECT_GT(watched.evaluations(), evaluations - kMostOfAPass);
    }
  }
}

TEST_P(OptimizerOnProblem, TimeBudgetHolds) {
  constexpr double kNoTime = 1e-12;
  StoppingRules rules;
  rules.seconds = kNoTime;
  const WatchedObjective watched(*GetParam().objective);
  const Minimum minimum = Scg(rules).Minimize(watched, GetParam().start);
  ExpectTruthful(minimum, watched, rules);
  EXPECT_EQ(watched.evaluations(), 1);
  if (!EndedByItself(minimum.summary)) {
    EXPECT_EQ(minimum.summary.termination, Termination::kTimeLimit);
  }
}

TEST_P(OptimizerOnProblem, AStopAskedForBeforeLeavesTheStart) {
  const std::atomic<bool> stop = true;
  RunControl run;
  run.stop = &stop;
  const WatchedObjective watched(*GetParam().objective);
  const Minimum minimum = Scg({}).Minimize(watched, GetParam().start, run);
  ExpectTruthful(minimum, watched, {});
  EXPECT_EQ(minimum.x, GetParam().start);
  EXPECT_EQ(watched.evaluations(), 1);
  if (!EndedByItself(minimum.summary)) {
    EXPECT_EQ(minimum.summary.termination, Termination::kInterrupted);
    EXPECT_THAT(minimum.summary.message, HasSubstr("interrupted"));
  }
}

TEST_P(OptimizerOnProblem, AStopAskedForInBetweenEndsAfterThePass) {
  constexpr std::int64_t kStopAfter = 8;
  constexpr std::int64_t kMostOfAPass = 2;
  std::atomic<bool> stop = false;
  RunControl run;
  run.stop = &stop;
  WatchedObjective watched(*GetParam().objective);
  watched.AfterEach([&] { stop = watched.evaluations() >= kStopAfter; });
  const Minimum minimum = Scg({}).Minimize(watched, GetParam().start, run);
  ExpectTruthful(minimum, watched, {});
  EXPECT_LT(watched.evaluations(), kStopAfter + kMostOfAPass);
  if (!EndedByItself(minimum.summary)) {
    EXPECT_EQ(minimum.summary.termination, Termination::kInterrupted);
  }
}

TEST_P(OptimizerOnProblem, SameStartSamePathToTheLastBit) {
  StoppingRules rules;
  rules.iterations = 100;
  const Minimum first =
      Scg(rules).Minimize(*GetParam().objective, GetParam().start);
  const Minimum second =
      Scg(rules).Minimize(*GetParam().objective, GetParam().start);
  EXPECT_EQ(first.x, second.x);
  EXPECT_EQ(first.summary.evaluations(), second.summary.evaluations());
}

INSTANTIATE_TEST_SUITE_P(
    Scg,
    OptimizerOnProblem,
    ::testing::ValuesIn(AllTestProblems()),
    [](const ::testing::TestParamInfo<TestProblem>& instance) {
      return instance.param.name;
    });

TEST(Minimize, TimeBudgetEndsASlowObjectiveWithinAPass) {
  constexpr double kSeconds = 0.05;
  constexpr auto kEach = std::chrono::milliseconds(5);
  // Two evaluations end after the limit; a loaded machine oversleeps.
  constexpr double kPatience = 5.0;
  const TestProblem problem = Rosenbrock();
  WatchedObjective slow(*problem.objective);
  slow.AfterEach([&] { std::this_thread::sleep_for(kEach); });
  StoppingRules rules;
  rules.seconds = kSeconds;
  const Minimum minimum = Scg(rules).Minimize(slow, problem.start);
  EXPECT_EQ(minimum.summary.termination, Termination::kTimeLimit);
  EXPECT_GE(minimum.summary.seconds, kSeconds);
  EXPECT_LT(minimum.summary.seconds, kPatience);
  // 10 sleeps of at least 5 ms fill the budget; a pass adds two at most.
  EXPECT_LE(slow.evaluations(), 12);
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

TEST(Minimize, KeepsNoTraceUnlessAsked) {
  const TestProblem problem = Rosenbrock();
  EXPECT_THAT(Scg({}).Minimize(*problem.objective, problem.start).summary.trace,
              IsEmpty());
}

TEST(Minimize, StartsAtAMinimumAndStaysThere) {
  const TestProblem problem = Rosenbrock();
  const Minimum minimum = Scg({}).Minimize(*problem.objective, problem.minimum);
  EXPECT_EQ(minimum.summary.termination, Termination::kGradient);
  EXPECT_EQ(minimum.summary.iterations, 0);
  EXPECT_EQ(minimum.x, problem.minimum);
}

}  // namespace
}  // namespace errmap::fitting
