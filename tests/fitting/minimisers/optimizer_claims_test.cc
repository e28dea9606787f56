#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/minimisers/optimizer.h"
#include "models/net/net_objective.h"
#include "tests/fitting/claimed_minimum.h"
#include "tests/fitting/optimizer_cases.h"
#include "tests/fitting/test_problems.h"
#include "tests/fitting/watched_objective.h"
#include "tests/numbers.h"
#include "tests/random_matrix.h"

namespace errmap::fitting {
namespace {

using Eigen::VectorXd;
using errmap::testing::AllOptimizers;
using errmap::testing::ExpectTrueClaim;
using errmap::testing::FunctionObjective;
using errmap::testing::OptimizerCase;
using errmap::testing::RandomMatrix;
using errmap::testing::WatchedObjective;
using ::testing::IsEmpty;
using ::testing::Not;

// A function and a start where minimisation goes wrong, or may.
struct HardCase {
  std::string name;  // letters only: part of a test's name
  std::shared_ptr<const Objective> objective;
  VectorXd start;
};

void PrintTo(const HardCase& hard, std::ostream* out) { *out << hard.name; }

HardCase Function(std::string name,
                  VectorXd start,
                  FunctionObjective::Function function) {
  HardCase hard;
  hard.name = std::move(name);
  hard.objective =
      std::make_shared<FunctionObjective>(start.size(), std::move(function));
  hard.start = std::move(start);
  return hard;
}

// (x - 1)^2 seen up to x = 0.5 only: the way down leads outside. A region of
// f = -infinity is infeasible like one of NaN or +infinity.
HardCase Cliff(const std::string& name, double outside) {
  return Function("Cliff" + name,
                  VectorXd{{-3.0}},
                  [outside](const VectorXd& x, VectorXd* gradient) {
                    if (gradient != nullptr) {
                      (*gradient)[0] = x[0] > 0.5 ? kNaN : 2.0 * (x[0] - 1.0);
                    }
                    return x[0] > 0.5 ? outside : (x[0] - 1.0) * (x[0] - 1.0);
                  });
}

// 1/2 |x|^2 with another gradient than its own x.
HardCase Lie(const std::string& name,
             std::function<VectorXd(const VectorXd&)> gradient_of) {
  return Function("Lie" + name,
                  VectorXd{{3.0, -4.0, 0.5}},
                  [gradient_of](const VectorXd& x, VectorXd* gradient) {
                    if (gradient != nullptr) *gradient = gradient_of(x);
                    return 0.5 * x.squaredNorm();
                  });
}

// A net all of whose weights are `size`: every sigmoid stands at its end.
HardCase SaturatedNet(const std::string& name, double size, double wfactor) {
  const models::NetShape shape{2, 3, 2, models::OutputFunction::kSigmoid};
  HardCase hard;
  hard.name = "SaturatedNet" + name;
  hard.objective =
      std::make_shared<models::NetObjective>(shape,
                                             RandomMatrix(20, 2, 1),
                                             RandomMatrix(20, 2, 2).cwiseAbs(),
                                             wfactor);
  hard.start = VectorXd::Constant(shape.num_weights(), size);
  return hard;
}

std::vector<HardCase> AllHardCases() {
  std::vector<HardCase> cases = {
      // Its point of zero gradient is not a minimum, and there is none.
      Function("Saddle",
               VectorXd{{1.0, 1e-3}},
               [](const VectorXd& x, VectorXd* gradient) {
                 if (gradient != nullptr) *gradient << 2.0 * x[0], -2.0 * x[1];
                 return x[0] * x[0] - x[1] * x[1];
               }),
      Function("MonkeySaddle",
               VectorXd{{0.1, 0.0}},
               [](const VectorXd& x, VectorXd* gradient) {
                 if (gradient != nullptr) {
                   *gradient << 3.0 * (x[0] * x[0] - x[1] * x[1]),
                       -6.0 * x[0] * x[1];
                 }
                 return x[0] * x[0] * x[0] - 3.0 * x[0] * x[1] * x[1];
               }),
      Function("Plane",
               VectorXd{{0.0, 0.0}},
               [](const VectorXd& x, VectorXd* gradient) {
                 if (gradient != nullptr) *gradient << 1.0, -2.0;
                 return x[0] - 2.0 * x[1];
               }),
      Function("Hilltop",
               VectorXd{{0.1}},
               [](const VectorXd& x, VectorXd* gradient) {
                 if (gradient != nullptr) (*gradient)[0] = -std::sin(x[0]);
                 return 1.0 + std::cos(x[0]);
               }),
      // 1/x falls for ever, more and more slowly.
      Function("NoFloor",
               VectorXd{{1.0}},
               [](const VectorXd& x, VectorXd* gradient) {
                 if (!(x[0] > 0.0)) return kNaN;
                 if (gradient != nullptr) (*gradient)[0] = -1.0 / (x[0] * x[0]);
                 return 1.0 / x[0];
               }),
      Function("Kink",
               VectorXd{{1.0, -0.3}},
               [](const VectorXd& x, VectorXd* gradient) {
                 if (gradient != nullptr) *gradient = x.cwiseSign();
                 return x.lpNorm<1>();
               }),
      Function("Huge",
               VectorXd{{1.0, 2.0}},
               [](const VectorXd& x, VectorXd* gradient) {
                 if (gradient != nullptr) *gradient = 1e140 * x;
                 return 0.5e140 * x.squaredNorm();
               }),
      Function("NoGradientNearby",
               VectorXd{{1.0, 2.0}},
               [start = VectorXd{{1.0, 2.0}}](const VectorXd& x,
                                              VectorXd* gradient) {
                 if (gradient != nullptr) {
                   *gradient = x == start ? x : VectorXd::Constant(2, kNaN);
                 }
                 return 0.5 * x.squaredNorm();
               }),
      // The first step of a parabola leads where there is no gradient.
      Function("NoGradientAtTheMinimum",
               VectorXd{{1.0, 2.0}},
               [](const VectorXd& x, VectorXd* gradient) {
                 if (gradient != nullptr) {
                   *gradient = x.norm() > 0.5 ? x : VectorXd::Constant(2, kNaN);
                 }
                 return 0.5 * x.squaredNorm();
               }),
      Function("OnlyTheStartIsFeasible",
               VectorXd{{1.0, 2.0}},
               [start = VectorXd{{1.0, 2.0}}](const VectorXd& x,
                                              VectorXd* gradient) {
                 if (gradient != nullptr) *gradient = x;
                 return x == start ? 1.0 : kInfinity;
               }),
      Cliff("NaN", kNaN),
      Cliff("Infinity", kInfinity),
      Cliff("MinusInfinity", -kInfinity),
      Lie("Uphill", [](const VectorXd& x) { return VectorXd(-x); }),
      Lie("Sideways",
          [](const VectorXd& x) {
            return VectorXd{{-x[1], x[0], 0.0}};
          }),
      Lie("TooLong", [](const VectorXd& x) { return VectorXd(1e6 * x); }),
      Lie("Constant",
          [](const VectorXd& x) { return VectorXd::Ones(x.size()); }),
      // What is left to gain is hidden by the rest of the cost: by its
      // rounding, and far above it.
      Function("OnAPlateau",
               VectorXd{{1.0, 2.0}},
               [](const VectorXd& x, VectorXd* gradient) {
                 if (gradient != nullptr) *gradient = 1e-3 * x;
                 return 1e13 + 0.5e-3 * x.squaredNorm();
               }),
      Function("RoundedValley",
               VectorXd{{1.0, 1.0}},
               [](const VectorXd& x, VectorXd* gradient) {
                 if (gradient != nullptr) *gradient << x[0], 1e-9 * x[1];
                 return 1.0 + 0.5 * (x[0] * x[0] + 1e-9 * x[1] * x[1]);
               }),
      // A saddle at which the cost is too coarse to show the way down.
      Function("CoarseSaddle",
               VectorXd{{1e-9, 1e-9}},
               [](const VectorXd& x, VectorXd* gradient) {
                 if (gradient != nullptr) *gradient << x[0], -x[1];
                 return 1.0 + 0.5 * (x[0] * x[0] - x[1] * x[1]);
               }),
      Function("Flat",  // with a gradient that is none of it
               VectorXd{{1.0, 2.0}},
               [](const VectorXd&, VectorXd* gradient) {
                 if (gradient != nullptr) *gradient << 1.0, -1.0;
                 return 2.0;
               }),
  };
  for (const double size : {30.0, -30.0, 1e3, -1e3}) {
    const std::string name = (size > 0.0 ? "Plus" : "Minus") +
                             std::string(std::abs(size) > 100.0 ? "Far" : "");
    cases.push_back(SaturatedNet(name, size, 0.0));
    cases.push_back(SaturatedNet(name + "Decaying", size, 1e-3));
  }
  return cases;
}

class OptimizerInTrouble
    : public ::testing::TestWithParam<std::tuple<OptimizerCase, HardCase>> {
 protected:
  static const OptimizerCase& optimizer() { return std::get<0>(GetParam()); }
  static const HardCase& hard() { return std::get<1>(GetParam()); }
};

TEST_P(OptimizerInTrouble, EndsWithAPointAndAReasonThatAreTrue) {
  for (const double goal : {1e-3, 1e-12, 0.0}) {
    SCOPED_TRACE("gradient goal " + std::to_string(goal));
    StoppingRules rules;
    rules.iterations = 2000;
    rules.gradient_goal = goal;
    const WatchedObjective watched(*hard().objective);
    const Minimum minimum =
        optimizer().make(rules)->Minimize(watched, hard().start);
    const FitSummary& summary = minimum.summary;
    VectorXd gradient;
    const double cost = hard().objective->Evaluate(minimum.x, &gradient);
    EXPECT_TRUE(std::isfinite(cost));
    EXPECT_TRUE(minimum.x.allFinite());
    EXPECT_EQ(summary.final_cost, cost);
    EXPECT_EQ(summary.final_gradient_norm, gradient.norm());
    EXPECT_LE(summary.final_cost, summary.initial_cost);
    EXPECT_LE(summary.iterations, rules.iterations);
    EXPECT_EQ(summary.value_evaluations, watched.values());
    EXPECT_EQ(summary.gradient_evaluations, watched.gradients());
    ExpectTrueClaim(*hard().objective, minimum, goal);
    if (!summary.converged()) {
      EXPECT_THAT(summary.termination,
                  ::testing::AnyOf(Termination::kNoDescent,
                                   Termination::kIterationLimit));
    }
    EXPECT_THAT(summary.message, Not(IsEmpty()));
    EXPECT_NE(summary.message, "not run");
    EXPECT_NE(summary.message, "still running");
    if (summary.message.find("not finite") != std::string::npos) {
      EXPECT_TRUE(watched.has_seen_infeasible())
          << "'" << summary.message << "', but it was everywhere";
    }
  }
}

TEST_P(OptimizerInTrouble, KeepsItsLimits) {
  for (std::int64_t evaluations = 1; evaluations <= 40; ++evaluations) {
    StoppingRules rules;
    rules.evaluations = evaluations;
    const WatchedObjective watched(*hard().objective);
    const FitSummary summary =
        optimizer().make(rules)->Minimize(watched, hard().start).summary;
    EXPECT_LE(summary.evaluations(), evaluations);
  }
  const std::atomic<bool> stop = true;
  const Minimum minimum = optimizer().make({})->Minimize(
      *hard().objective, hard().start, {.stop = &stop});
  EXPECT_EQ(minimum.x, hard().start);
}

TEST_P(OptimizerInTrouble, IsTheSameTwice) {
  StoppingRules rules;
  rules.iterations = 200;
  const auto run = [&] {
    return optimizer().make(rules)->Minimize(*hard().objective, hard().start);
  };
  const Minimum first = run();
  const Minimum second = run();
  EXPECT_EQ(first.x, second.x);
  EXPECT_EQ(first.summary.message, second.summary.message);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    OptimizerInTrouble,
    ::testing::Combine(::testing::ValuesIn(AllOptimizers()),
                       ::testing::ValuesIn(AllHardCases())),
    [](const ::testing::TestParamInfo<std::tuple<OptimizerCase, HardCase>>&
           instance) {
      return std::get<0>(instance.param).name + "On" +
             std::get<1>(instance.param).name;
    });

class OptimizerAtABadStart : public ::testing::TestWithParam<OptimizerCase> {};

TEST_P(OptimizerAtABadStart, FailsWithAReason) {
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
      const Minimum minimum = GetParam().make({})->Minimize(*f, start);
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

INSTANTIATE_TEST_SUITE_P(
    All,
    OptimizerAtABadStart,
    ::testing::ValuesIn(AllOptimizers()),
    [](const ::testing::TestParamInfo<OptimizerCase>& instance) {
      return instance.param.name;
    });

TEST(EveryOptimizer, EndsAfterTheIterationAtWhichItsCallerSaysSo) {
  for (const OptimizerCase& tried : errmap::testing::AllOptimizers()) {
    SCOPED_TRACE(tried.name);
    const errmap::testing::TestProblem problem = errmap::testing::Rosenbrock();
    constexpr std::int64_t kLast = 3;
    std::vector<double> costs;
    Eigen::VectorXd x;
    const auto goes_on = [&](const Iterate& at) {
      EXPECT_EQ(at.iteration, static_cast<std::int64_t>(costs.size()) + 1);
      EXPECT_NEAR(at.cost,
                  problem.objective->Evaluate(at.x, nullptr),
                  1e-12 * (1.0 + at.cost));
      costs.push_back(at.cost);
      x = at.x;
      return at.iteration < kLast;
    };
    const Minimum minimum = tried.make({})->Minimize(
        *problem.objective, problem.start, {.after_iteration = goes_on});
    EXPECT_EQ(minimum.summary.termination, Termination::kInterrupted);
    EXPECT_EQ(minimum.summary.message, "ended by the caller");
    EXPECT_EQ(minimum.summary.iterations, kLast);
    EXPECT_EQ(costs.size(), static_cast<std::size_t>(kLast));
    EXPECT_LE(minimum.summary.final_cost, costs.back() * (1.0 + 1e-12));
  }
}

}  // namespace
}  // namespace errmap::fitting
