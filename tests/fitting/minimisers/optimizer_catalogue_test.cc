#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/minimisers/optimizer.h"
#include "tests/fitting/claimed_minimum.h"
#include "tests/fitting/optimizer_cases.h"
#include "tests/fitting/test_problems.h"
#include "tests/fitting/watched_objective.h"

namespace errmap::fitting {
namespace {

using Eigen::VectorXd;
using errmap::testing::AllOptimizers;
using errmap::testing::AllTestProblems;
using errmap::testing::ExpectTrueClaim;
using errmap::testing::OptimizerCase;
using errmap::testing::Rosenbrock;
using errmap::testing::TestProblem;
using errmap::testing::WatchedObjective;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Ended for its own reasons, before any budget.
bool EndedByItself(const FitSummary& summary) {
  return summary.converged() || summary.termination == Termination::kNoDescent;
}

// What must hold for every optimizer on every problem, however it ends.
class OptimizerOnProblem
    : public ::testing::TestWithParam<std::tuple<OptimizerCase, TestProblem>> {
 protected:
  static const OptimizerCase& optimizer() { return std::get<0>(GetParam()); }
  static const TestProblem& problem() { return std::get<1>(GetParam()); }

  static Minimum Run(const Objective& f,
                     const StoppingRules& rules,
                     const RunControl& run = {}) {
    return optimizer().make(rules)->Minimize(f, problem().start, run);
  }

  // True to what the summary says, by the problem's own word.
  static void ExpectTruthful(const Minimum& minimum,
                             const WatchedObjective& watched,
                             const StoppingRules& rules) {
    const FitSummary& summary = minimum.summary;
    VectorXd gradient;
    const double cost = problem().objective->Evaluate(minimum.x, &gradient);
    EXPECT_EQ(summary.final_cost, cost);
    EXPECT_EQ(summary.final_gradient_norm, gradient.norm());
    EXPECT_LE(summary.final_cost, summary.initial_cost);
    EXPECT_EQ(summary.value_evaluations, watched.values());
    EXPECT_EQ(summary.gradient_evaluations, watched.gradients());
    EXPECT_EQ(summary.curvature_evaluations, 0);
    EXPECT_LE(summary.iterations, rules.iterations);
    EXPECT_LE(summary.evaluations(), rules.evaluations);
    EXPECT_THAT(summary.message, Not(IsEmpty()));
    EXPECT_NE(summary.message, "not run");
    EXPECT_NE(summary.message, "still running");
    ExpectTrueClaim(*problem().objective, minimum, rules.gradient_goal);
    if (summary.termination == Termination::kIterationLimit) {
      EXPECT_EQ(summary.iterations, rules.iterations);
    }
    if (summary.message.find("not finite") != std::string::npos) {
      EXPECT_TRUE(watched.has_seen_infeasible())
          << "'" << summary.message << "', but it was everywhere";
    }
  }
};

TEST_P(OptimizerOnProblem, ClaimsAMinimumOnlyWhereTheGradientIsSmall) {
  for (const double goal : {1e-2, 1e-6, 1e-12, 0.0}) {
    StoppingRules rules;
    rules.iterations = 5000;
    rules.gradient_goal = goal;
    const WatchedObjective watched(*problem().objective);
    const Minimum minimum = Run(watched, rules);
    SCOPED_TRACE("gradient goal " + std::to_string(goal));
    ExpectTruthful(minimum, watched, rules);
  }
}

TEST_P(OptimizerOnProblem, FindsTheMinimum) {
  if (!optimizer().Solves(problem().name)) {
    GTEST_SKIP() << "not one that this method solves";
  }
  // A gradient of 1e-6 on Hessians whose least eigenvalue is about 0.1.
  constexpr double kNear = 1e-4;
  constexpr double kCost = 1e-6;
  StoppingRules rules;
  rules.iterations = 5000;
  rules.gradient_goal = 1e-6;
  const Minimum minimum = Run(*problem().objective, rules);
  EXPECT_EQ(minimum.summary.termination, Termination::kGradient)
      << minimum.summary.message;
  EXPECT_NEAR(minimum.summary.final_cost, problem().minimum_value, kCost);
  if (problem().regular) {
    EXPECT_LT((minimum.x - problem().minimum).norm(), kNear);
  }
}

TEST_P(OptimizerOnProblem, GivesBackTheBestPointOfItsTrace) {
  for (const std::int64_t iterations : {1, 2, 3, 5, 10, 20, 50, 200}) {
    StoppingRules rules;
    rules.iterations = iterations;
    RunControl run;
    run.keep_trace = true;
    const WatchedObjective watched(*problem().objective);
    const Minimum minimum = Run(watched, rules, run);
    ExpectTruthful(minimum, watched, rules);
    const auto& trace = minimum.summary.trace;
    ASSERT_EQ(static_cast<std::int64_t>(trace.size()),
              minimum.summary.iterations + 1);
    EXPECT_EQ(trace.front().rms_error,
              std::sqrt(2.0 * minimum.summary.initial_cost));
    EXPECT_EQ(trace.front().gradient_norm,
              minimum.summary.initial_gradient_norm);
    // Of equal ones the last is given back.
    const TracePoint* best = &trace.front();
    for (std::size_t i = 1; i < trace.size(); ++i) {
      EXPECT_EQ(trace[i].iteration, static_cast<std::int64_t>(i));
      if (optimizer().never_rises) {
        EXPECT_LE(trace[i].rms_error, trace[i - 1].rms_error);
      }
      if (trace[i].rms_error <= best->rms_error) best = &trace[i];
    }
    EXPECT_EQ(best->rms_error, std::sqrt(2.0 * minimum.summary.final_cost));
    EXPECT_EQ(best->gradient_norm, minimum.summary.final_gradient_norm);
  }
}

// Points a difference quotient's step away serve the curvature; of all others
// the one given back has the lowest cost.
TEST_P(OptimizerOnProblem, GivesBackTheBestPointSeen) {
  // The longest step of a quotient is sigma = 1e-4 of netcg; the margin is for
  // the rounding of its length.
  const double quotient = 1.01 * ScaledConjugateGradientOptions().sigma;
  for (const std::int64_t evaluations : {2, 3, 4, 7, 12, 25, 60, 301}) {
    StoppingRules rules;
    rules.evaluations = evaluations;
    const WatchedObjective watched(*problem().objective);
    const Minimum minimum = Run(watched, rules);
    const double scale = std::max(1.0, minimum.x.norm());
    for (std::size_t i = 0; i < watched.points().size(); ++i) {
      const double distance = (watched.points()[i] - minimum.x).norm();
      if (distance <= quotient * scale) continue;
      EXPECT_FALSE(watched.costs()[i] < minimum.summary.final_cost)
          << "evaluation " << i << " of " << watched.evaluations();
    }
  }
}

TEST_P(OptimizerOnProblem, IterationBudgetHoldsExactly) {
  for (const std::int64_t iterations : {0, 1, 2, 5, 10}) {
    StoppingRules rules;
    rules.iterations = iterations;
    const WatchedObjective watched(*problem().objective);
    const Minimum minimum = Run(watched, rules);
    ExpectTruthful(minimum, watched, rules);
    if (iterations == 0) {
      EXPECT_EQ(minimum.x, problem().start);
      EXPECT_EQ(watched.evaluations(), 1);
    }
    if (!EndedByItself(minimum.summary)) {
      EXPECT_EQ(minimum.summary.termination, Termination::kIterationLimit);
      EXPECT_EQ(minimum.summary.iterations, iterations);
    }
  }
}

TEST_P(OptimizerOnProblem, EvaluationBudgetHoldsExactly) {
  for (std::int64_t evaluations = 1; evaluations <= 25; ++evaluations) {
    StoppingRules rules;
    rules.evaluations = evaluations;
    const WatchedObjective watched(*problem().objective);
    const Minimum minimum = Run(watched, rules);
    ExpectTruthful(minimum, watched, rules);
    if (!EndedByItself(minimum.summary)) {
      EXPECT_EQ(minimum.summary.termination, Termination::kEvaluationLimit);
      // Less than a pass may be left over.
      EXPECT_GT(minimum.summary.evaluations(),
                evaluations - optimizer().evaluations_per_pass);
    }
  }
}

TEST_P(OptimizerOnProblem, TimeBudgetHolds) {
  constexpr double kNoTime = 1e-12;
  StoppingRules rules;
  rules.seconds = kNoTime;
  const WatchedObjective watched(*problem().objective);
  const Minimum minimum = Run(watched, rules);
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
  const WatchedObjective watched(*problem().objective);
  const Minimum minimum = Run(watched, {}, run);
  ExpectTruthful(minimum, watched, {});
  EXPECT_EQ(minimum.x, problem().start);
  EXPECT_EQ(watched.evaluations(), 1);
  if (!EndedByItself(minimum.summary)) {
    EXPECT_EQ(minimum.summary.termination, Termination::kInterrupted);
    EXPECT_THAT(minimum.summary.message, HasSubstr("interrupted"));
  }
}

TEST_P(OptimizerOnProblem, AStopAskedForInBetweenEndsAfterThePass) {
  constexpr std::int64_t kStopAfter = 8;
  std::atomic<bool> stop = false;
  RunControl run;
  run.stop = &stop;
  WatchedObjective watched(*problem().objective);
  watched.AfterEach([&] { stop = watched.evaluations() >= kStopAfter; });
  const Minimum minimum = Run(watched, {}, run);
  ExpectTruthful(minimum, watched, {});
  EXPECT_LE(watched.evaluations(),
            kStopAfter + optimizer().evaluations_per_pass);
  if (!EndedByItself(minimum.summary)) {
    EXPECT_EQ(minimum.summary.termination, Termination::kInterrupted);
  }
}

TEST_P(OptimizerOnProblem, SameStartSamePathToTheLastBit) {
  StoppingRules rules;
  rules.iterations = 100;
  RunControl run;
  run.keep_trace = true;
  const Minimum first = Run(*problem().objective, rules, run);
  const Minimum second = Run(*problem().objective, rules, run);
  EXPECT_EQ(first.x, second.x);
  EXPECT_EQ(first.summary.evaluations(), second.summary.evaluations());
  ASSERT_EQ(first.summary.trace.size(), second.summary.trace.size());
  for (std::size_t i = 0; i < first.summary.trace.size(); ++i) {
    EXPECT_EQ(first.summary.trace[i].rms_error,
              second.summary.trace[i].rms_error);
  }
}

TEST_P(OptimizerOnProblem, StartsAtAMinimumAndStaysThere) {
  const Minimum minimum =
      optimizer().make({})->Minimize(*problem().objective, problem().minimum);
  EXPECT_EQ(minimum.summary.termination, Termination::kGradient);
  EXPECT_EQ(minimum.summary.iterations, 0);
  EXPECT_EQ(minimum.summary.evaluations(), 1);
  EXPECT_EQ(minimum.x, problem().minimum);
}

TEST_P(OptimizerOnProblem, CostGoalIsNoClaimOfAMinimum) {
  constexpr double kGoal = 0.5;
  StoppingRules rules;
  rules.iterations = 5000;
  rules.cost_goal = kGoal;
  const WatchedObjective watched(*problem().objective);
  const Minimum minimum = Run(watched, rules);
  ExpectTruthful(minimum, watched, rules);
  if (optimizer().Solves(problem().name)) {
    EXPECT_EQ(minimum.summary.termination, Termination::kCostGoal);
    EXPECT_FALSE(minimum.summary.converged());
    EXPECT_LT(std::sqrt(2.0 * minimum.summary.final_cost), kGoal);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All,
    OptimizerOnProblem,
    ::testing::Combine(::testing::ValuesIn(AllOptimizers()),
                       ::testing::ValuesIn(AllTestProblems())),
    [](const ::testing::TestParamInfo<std::tuple<OptimizerCase, TestProblem>>&
           instance) {
      return std::get<0>(instance.param).name + "On" +
             std::get<1>(instance.param).name;
    });

class EveryOptimizer : public ::testing::TestWithParam<OptimizerCase> {};

TEST_P(EveryOptimizer, TimeBudgetEndsASlowObjectiveWithinAPass) {
  constexpr double kSeconds = 0.05;
  constexpr auto kEach = std::chrono::milliseconds(5);
  // A pass ends after the limit; a loaded machine oversleeps.
  constexpr double kPatience = 5.0;
  const TestProblem problem = Rosenbrock();
  WatchedObjective slow(*problem.objective);
  slow.AfterEach([&] { std::this_thread::sleep_for(kEach); });
  StoppingRules rules;
  rules.seconds = kSeconds;
  const Minimum minimum = GetParam().make(rules)->Minimize(slow, problem.start);
  EXPECT_EQ(minimum.summary.termination, Termination::kTimeLimit);
  EXPECT_GE(minimum.summary.seconds, kSeconds);
  EXPECT_LT(minimum.summary.seconds, kPatience);
  // 10 sleeps of at least 5 ms fill the budget; a pass follows at most.
  EXPECT_LE(slow.evaluations(), 10 + GetParam().evaluations_per_pass);
}

TEST_P(EveryOptimizer, RefusesRulesOutOfRange) {
  StoppingRules rules;
  rules.iterations = -1;
  EXPECT_THROW(GetParam().make(rules), std::invalid_argument);
}

TEST_P(EveryOptimizer, StopsWhereTheErrorFallsTooSlowly) {
  constexpr double kHalf = 0.5;  // the error is to halve in five steps
  constexpr std::int64_t kInterval = 5;
  const TestProblem problem = Rosenbrock();
  StoppingRules rules;
  rules.slow_ratio = kHalf;
  rules.progress_interval = kInterval;
  RunControl run;
  run.keep_trace = true;
  const Minimum minimum =
      GetParam().make(rules)->Minimize(*problem.objective, problem.start, run);
  ASSERT_EQ(minimum.summary.termination, Termination::kSlowProgress);
  EXPECT_FALSE(minimum.summary.converged());
  ASSERT_EQ(minimum.summary.iterations % kInterval, 0);
  const auto& trace = minimum.summary.trace;
  for (std::size_t i = kInterval; i < trace.size(); i += kInterval) {
    const bool slow =
        trace[i].rms_error > kHalf * trace[i - kInterval].rms_error;
    EXPECT_EQ(slow, i + 1 == trace.size()) << "iteration " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All,
    EveryOptimizer,
    ::testing::ValuesIn(AllOptimizers()),
    [](const ::testing::TestParamInfo<OptimizerCase>& instance) {
      return instance.param.name;
    });

}  // namespace
}  // namespace errmap::fitting
