#include "fitting/minimisers/guarded_run.h"

#include <cmath>
#include <new>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/interruption.h"
#include "tests/fitting/optimizer_cases.h"
#include "tests/fitting/test_problems.h"
#include "tests/fitting/watched_objective.h"

namespace errmap::fitting {
namespace {

using Eigen::VectorXd;
using errmap::testing::FunctionObjective;
using errmap::testing::WatchedObjective;
using ::testing::HasSubstr;

constexpr std::int64_t kPatience = 10;

FunctionObjective BowlInGuardedRun() {
  return {2, [](const VectorXd& x, VectorXd* gradient) {
            if (gradient != nullptr) *gradient = x;
            return 0.5 * x.squaredNorm();
          }};
}

TEST(GuardedRun, AnswersTheSamePointFromMemory) {
  const FunctionObjective bowl = BowlInGuardedRun();
  const WatchedObjective watched(bowl);
  const StoppingRules rules;
  const RunControl control;
  GuardedRun run(watched, rules, control, kPatience);
  const VectorXd start{{3.0, 4.0}};
  ASSERT_TRUE(run.Start(start));
  EXPECT_TRUE(run.Evaluate(start.data()));
  EXPECT_EQ(watched.evaluations(), 1);
  EXPECT_EQ(run.cost(), 12.5);
  EXPECT_EQ(run.gradient(), start);
}

TEST(GuardedRun, CountsAnIterationOnlyWhereTheCostFell) {
  const FunctionObjective bowl = BowlInGuardedRun();
  const StoppingRules rules;
  const RunControl control;
  GuardedRun run(bowl, rules, control, kPatience);
  const VectorXd lower{{1.0, 1.0}};
  const VectorXd higher{{5.0, 5.0}};
  ASSERT_TRUE(run.Start(VectorXd{{3.0, 4.0}}));
  EXPECT_TRUE(run.Evaluate(higher.data()));
  run.EndIteration();
  EXPECT_TRUE(run.Evaluate(lower.data()));
  run.EndIteration();
  EXPECT_TRUE(run.Evaluate(higher.data()));
  run.EndIteration();
  const Minimum minimum = run.Finish("enough");
  EXPECT_EQ(minimum.summary.iterations, 1);
  EXPECT_EQ(minimum.x, lower);
  EXPECT_EQ(minimum.summary.final_cost, 1.0);
  EXPECT_EQ(minimum.summary.termination, Termination::kNoDescent);
  EXPECT_THAT(minimum.summary.message, HasSubstr("enough"));
}

TEST(GuardedRun, ClaimsNoMinimumWhereTheSolverIsContentAndTheGradientIsNot) {
  const FunctionObjective bowl = BowlInGuardedRun();
  const StoppingRules rules;
  const RunControl control;
  GuardedRun run(bowl, rules, control, kPatience);
  ASSERT_TRUE(run.Start(VectorXd{{3.0, 4.0}}));
  const Minimum minimum = run.Finish("CONVERGENCE (USER_SUCCESS)");
  EXPECT_FALSE(minimum.summary.converged());
  EXPECT_THAT(minimum.summary.message, HasSubstr("CONVERGENCE (USER_SUCCESS)"));
}

TEST(GuardedRun, LosesPatienceWithASolverThatAsksForEver) {
  const FunctionObjective bowl = BowlInGuardedRun();
  const StoppingRules rules;
  const RunControl control;
  GuardedRun run(bowl, rules, control, kPatience);
  const VectorXd start{{3.0, 4.0}};
  ASSERT_TRUE(run.Start(start));
  for (std::int64_t i = 0; i < kPatience; ++i) {
    EXPECT_TRUE(run.Evaluate(start.data()));
  }
  EXPECT_FALSE(run.Evaluate(start.data()));
  EXPECT_TRUE(run.stopped());
  const Minimum minimum = run.Finish("");
  EXPECT_EQ(minimum.summary.termination, Termination::kNoDescent);
  EXPECT_THAT(minimum.summary.message, HasSubstr("the last 10 points"));
}

TEST(GuardedRun, DoesNotAskTheObjectiveOutsideTheNumbers) {
  const FunctionObjective bowl = BowlInGuardedRun();
  const WatchedObjective watched(bowl);
  const StoppingRules rules;
  const RunControl control;
  GuardedRun run(watched, rules, control, kPatience);
  ASSERT_TRUE(run.Start(VectorXd{{3.0, 4.0}}));
  const VectorXd lost{{std::nan(""), 1.0}};
  EXPECT_FALSE(run.Evaluate(lost.data()));
  EXPECT_FALSE(run.stopped());
  EXPECT_EQ(watched.evaluations(), 1);
}

// Every foreign solver, on an objective that throws after a while.
class ForeignSolver
    : public ::testing::TestWithParam<errmap::testing::OptimizerCase> {};

TEST_P(ForeignSolver, KeepsBestPointAndTextWhereTheObjectiveThrows) {
  const auto problem = errmap::testing::Rosenbrock();
  for (const int last : {1, 2, 5, 20}) {
    int evaluations = 0;
    double best = problem.objective->Evaluate(problem.start, nullptr);
    const FunctionObjective throwing(
        2, [&](const VectorXd& x, VectorXd* gradient) {
          if (++evaluations > last) throw std::runtime_error("out of paper");
          const double value = problem.objective->Evaluate(x, gradient);
          best = std::min(best, value);
          return value;
        });
    const Minimum minimum =
        GetParam().make({})->Minimize(throwing, problem.start);
    EXPECT_EQ(minimum.summary.termination, Termination::kNoDescent);
    EXPECT_THAT(minimum.summary.message, HasSubstr("out of paper"));
    EXPECT_EQ(minimum.summary.final_cost, best);
    EXPECT_EQ(problem.objective->Evaluate(minimum.x, nullptr), best);
  }
}

TEST_P(ForeignSolver, FailsWhereTheObjectiveThrowsAtTheStart) {
  const FunctionObjective throwing(2, [](const VectorXd&, VectorXd*) -> double {
    throw std::runtime_error("out of paper");
  });
  const VectorXd start{{1.0, 2.0}};
  const Minimum minimum = GetParam().make({})->Minimize(throwing, start);
  EXPECT_EQ(minimum.summary.termination, Termination::kFailed);
  EXPECT_THAT(minimum.summary.message, HasSubstr("out of paper"));
  EXPECT_EQ(minimum.x, start);
}

// After 0 evaluations: at the start.
TEST_P(ForeignSolver, HasNoResultWhereThereIsNotEnoughMemory) {
  const auto problem = errmap::testing::Rosenbrock();
  for (const int last : {0, 1, 2, 5, 20}) {
    int evaluations = 0;
    const FunctionObjective throwing(
        2, [&](const VectorXd& x, VectorXd* gradient) {
          if (++evaluations > last) throw std::bad_alloc();
          return problem.objective->Evaluate(x, gradient);
        });
    EXPECT_THROW(GetParam().make({})->Minimize(throwing, problem.start),
                 std::bad_alloc);
  }
}

TEST_P(ForeignSolver, IsInterruptedWhereTheObjectiveIs) {
  const auto problem = errmap::testing::Rosenbrock();
  int evaluations = 0;
  const FunctionObjective throwing(
      2, [&](const VectorXd& x, VectorXd* gradient) {
        if (++evaluations > 5) throw Interrupted();
        return problem.objective->Evaluate(x, gradient);
      });
  const Minimum minimum =
      GetParam().make({})->Minimize(throwing, problem.start);
  EXPECT_EQ(minimum.summary.termination, Termination::kInterrupted);
}

TEST(GuardedRun, HasNoResultWhereTheCallerFindsNotEnoughMemory) {
  const FunctionObjective bowl = BowlInGuardedRun();
  const StoppingRules rules;
  const RunControl control{
      .after_iteration = [](const auto&) -> bool { throw std::bad_alloc(); }};
  GuardedRun run(bowl, rules, control, kPatience);
  const VectorXd lower{{1.0, 1.0}};
  ASSERT_TRUE(run.Start(VectorXd{{3.0, 4.0}}));
  EXPECT_TRUE(run.Evaluate(lower.data()));
  run.EndIteration();
  EXPECT_TRUE(run.stopped());
  EXPECT_THROW(run.Finish("enough"), std::bad_alloc);
}

std::vector<errmap::testing::OptimizerCase> ForeignSolvers() {
  std::vector<errmap::testing::OptimizerCase> foreign;
  for (auto& optimizer : errmap::testing::AllOptimizers()) {
    if (optimizer.name.starts_with("Ceres") ||
        optimizer.name.starts_with("Nlopt")) {
      foreign.push_back(std::move(optimizer));
    }
  }
  return foreign;
}

INSTANTIATE_TEST_SUITE_P(
    All,
    ForeignSolver,
    ::testing::ValuesIn(ForeignSolvers()),
    [](const ::testing::TestParamInfo<errmap::testing::OptimizerCase>&
           instance) { return instance.param.name; });

}  // namespace
}  // namespace errmap::fitting
