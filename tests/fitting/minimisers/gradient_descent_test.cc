#include "fitting/minimisers/gradient_descent.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fitting/test_problems.h"

namespace errmap::fitting {
namespace {

using Eigen::VectorXd;
using errmap::testing::FunctionObjective;
using ::testing::HasSubstr;

// 1/2 (x - 3)^2: the gradient is x - 3.
FunctionObjective Parabola() {
  return {1, [](const VectorXd& x, VectorXd* gradient) {
            if (gradient != nullptr) (*gradient)[0] = x[0] - 3.0;
            return 0.5 * (x[0] - 3.0) * (x[0] - 3.0);
          }};
}

Minimum Descend(double learning_rate,
                double momentum,
                std::int64_t iterations,
                const RunControl& run = {}) {
  GradientDescentOptions options;
  options.stopping.iterations = iterations;
  options.learning_rate = learning_rate;
  options.momentum = momentum;
  return GradientDescent(options).Minimize(Parabola(), VectorXd{{0.0}}, run);
}

TEST(GradientDescent, StepsByTheRateAndAShareOfTheLastStep) {
  // Eq. (70) by hand, in numbers that binary fractions hold exactly:
  // step 1 = 0.25 * 3, step 2 = 0.25 * 2.25 + 0.5 * 0.75.
  EXPECT_EQ(Descend(0.25, 0.5, 1).x[0], 0.75);
  EXPECT_EQ(Descend(0.25, 0.5, 2).x[0], 0.75 + 0.9375);
}

TEST(GradientDescent, WithoutMomentumIsSteepestDescent) {
  // The distance to the minimum falls by 1 - rate at each step.
  EXPECT_EQ(Descend(0.25, 0.0, 1).x[0], 3.0 - 3.0 * 0.75);
  EXPECT_EQ(Descend(0.25, 0.0, 2).x[0], 3.0 - 3.0 * 0.75 * 0.75);
  EXPECT_EQ(Descend(1.0, 0.0, 5).summary.termination, Termination::kGradient);
}

TEST(GradientDescent, TakesOneEvaluationAStep) {
  const FitSummary summary = Descend(0.25, 0.5, 7).summary;
  EXPECT_EQ(summary.gradient_evaluations, 8);
  EXPECT_EQ(summary.evaluations(), 8);
}

TEST(GradientDescent, DivergesAtTooLargeARateAndKeepsTheBestPoint) {
  const Minimum minimum = Descend(2.5, 0.0, 100'000, {.keep_trace = true});
  EXPECT_EQ(minimum.summary.termination, Termination::kNoDescent);
  EXPECT_THAT(minimum.summary.message, HasSubstr("learning rate is too large"));
  EXPECT_EQ(minimum.x[0], 0.0);  // each step was worse than the start
  EXPECT_EQ(minimum.summary.final_cost, 4.5);
  EXPECT_GT(minimum.summary.trace.back().rms_error, 1e100);
}

TEST(GradientDescentOptions, RefuseEachValueOutOfRange) {
  const auto message = [](double learning_rate, double momentum) {
    GradientDescentOptions options;
    options.learning_rate = learning_rate;
    options.momentum = momentum;
    try {
      GradientDescent{options};
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(1.0, 0.9), "");
  EXPECT_EQ(message(1e-12, 0.0), "");
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THAT(message(bad, 0.9),
                HasSubstr("GradientDescentOptions: learning_rate must be above "
                          "0, found"));
  }
  for (const double bad : {1.0, -0.1, std::nan("")}) {
    EXPECT_THAT(message(1.0, bad),
                HasSubstr("GradientDescentOptions: momentum must be at least 0 "
                          "and below 1, found"));
  }
}

}  // namespace
}  // namespace errmap::fitting
