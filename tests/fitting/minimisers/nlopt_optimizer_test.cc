#include "fitting/minimisers/nlopt_optimizer.h"

#include <cmath>
#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fitting/test_problems.h"

namespace errmap::fitting {
namespace {

using Eigen::VectorXd;
using errmap::testing::FunctionObjective;
using errmap::testing::Rosenbrock;
using ::testing::HasSubstr;
using ::testing::Property;
using ::testing::Throws;

FunctionObjective BowlInNloptOptimizer(Eigen::Index size) {
  return {size, [](const VectorXd& x, VectorXd* gradient) {
            if (gradient != nullptr) *gradient = x;
            return 0.5 * x.squaredNorm();
          }};
}

TEST(NloptOptions, DefaultsAreInRangeAndEachBoundBites) {
  EXPECT_NO_THROW(NloptOptions().Validate());
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    NloptOptions options;
    options.box = bad;
    EXPECT_THAT([&] { options.Validate(); },
                Throws<std::invalid_argument>(
                    Property(&std::exception::what, HasSubstr("box"))));
  }
  NloptOptions options;
  options.memory = 0;
  EXPECT_THAT([&] { options.Validate(); },
              Throws<std::invalid_argument>(
                  Property(&std::exception::what, HasSubstr("memory"))));
}

TEST(NloptOptimizer, NamesItsMethod) {
  EXPECT_EQ(NloptOptimizer({}).name(), "nlopt:lbfgs");
  EXPECT_EQ(NloptOptimizer({.method = NloptMethod::kCrs2Lm}).name(),
            "nlopt:crs2_lm");
}

TEST(NloptOptimizer, RefusesToSearchMoreParametersThanCrs2Can) {
  const NloptOptimizer crs2({.method = NloptMethod::kCrs2Lm});
  EXPECT_NO_THROW(
      NloptOptimizer(
          {.stopping = {.iterations = 1}, .method = NloptMethod::kCrs2Lm})
          .Minimize(BowlInNloptOptimizer(100), VectorXd::Ones(100)));
  EXPECT_THAT(
      [&] { crs2.Minimize(BowlInNloptOptimizer(101), VectorXd::Ones(101)); },
      Throws<std::invalid_argument>(
          Property(&std::exception::what,
                   HasSubstr("crs2_lm searches at most 100 parameters, found "
                             "101; use lbfgs"))));
}

// 2 + x/20 - cos(x) in each coordinate: a minimum near every multiple of 2 pi,
// the lowest of them at the box's end.
TEST(NloptOptimizer, Crs2LeavesTheValleyOfTheStartForALowerOneInTheBox) {
  const FunctionObjective valleys(2, [](const VectorXd& x, VectorXd* gradient) {
    if (gradient != nullptr) *gradient = 0.05 + x.array().sin();
    return (2.0 + 0.05 * x.array() - x.array().cos()).sum();
  });
  const VectorXd start{{6.2, 6.2}};
  const double box = 1.5;
  const Minimum local = NloptOptimizer({}).Minimize(valleys, start);
  const Minimum global = NloptOptimizer({.stopping = {.gradient_goal = 1e-6},
                                         .method = NloptMethod::kCrs2Lm,
                                         .box = box})
                             .Minimize(valleys, start);
  EXPECT_LT(global.summary.final_cost, local.summary.final_cost - 0.5);
  EXPECT_TRUE(((global.x - start).array().abs() <= box * start.array()).all());
}

TEST(NloptOptimizer, Crs2RepeatsWithItsSeedOnEveryThread) {
  const auto problem = Rosenbrock();
  const auto run = [&](std::uint64_t seed) {
    return NloptOptimizer({.stopping = {.evaluations = 3000},
                           .method = NloptMethod::kCrs2Lm,
                           .seed = seed})
        .Minimize(*Rosenbrock().objective, problem.start)
        .x;
  };
  const VectorXd alone = run(7);
  EXPECT_NE(alone, run(8));
  VectorXd one;
  VectorXd other;
  std::thread first([&] { one = run(7); });
  std::thread second([&] { other = run(7); });
  first.join();
  second.join();
  EXPECT_EQ(one, alone);
  EXPECT_EQ(other, alone);
}

TEST(NloptOptimizer, KeepsAsFewVectorsAsAskedFor) {
  // More pairs than parameters are of no use, and NLopt takes them.
  const auto problem = Rosenbrock();
  for (const int memory : {1, 2, 1000}) {
    const Minimum minimum =
        NloptOptimizer({.stopping = {.gradient_goal = 1e-6}, .memory = memory})
            .Minimize(*problem.objective, problem.start);
    EXPECT_TRUE(minimum.summary.converged()) << memory;
  }
}

}  // namespace
}  // namespace errmap::fitting
