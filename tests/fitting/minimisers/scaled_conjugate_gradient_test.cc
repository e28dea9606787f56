#include "fitting/minimisers/scaled_conjugate_gradient.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/net/net_objective.h"
#include "tests/fitting/claimed_minimum.h"
#include "tests/models/golden_netcg.h"
#include "tests/models/net/net_test_cases.h"
#include "tests/random_matrix.h"

namespace errmap::fitting {
namespace {

using errmap::testing::ExpectTrueClaim;
using errmap::testing::GoldenCase;
using errmap::testing::RandomMatrix;
using errmap::testing::ReadGoldenCase;
using errmap::testing::RiddersCurvature;
using ::testing::HasSubstr;

// A net over patterns of a smooth error map.
template <typename Scalar>
models::BasicNetObjective<Scalar> SmallNet() {
  constexpr Eigen::Index kPatterns = 120;
  const Eigen::MatrixXd inputs = RandomMatrix(kPatterns, 3, 1);
  const Eigen::MatrixXd targets =
      0.5 + 0.3 * (2.0 * inputs.col(0) + inputs.col(1)).array().sin() +
      0.1 * inputs.col(2).array() * inputs.col(0).array();
  return {{3, 8, 1}, inputs, targets, 1e-4};
}

Eigen::VectorXd SmallNetStart() { return 0.5 * RandomMatrix(41, 1, 2); }

template <typename Scalar>
Minimum MinimizeSmallNet(const BasicObjective<Scalar>& objective,
                         ScgVariant variant,
                         const StoppingRules& stopping) {
  ScaledConjugateGradientOptions options;
  options.variant = variant;
  options.stopping = stopping;
  return BasicScaledConjugateGradient<Scalar>(options).Minimize(
      objective, SmallNetStart().cast<Scalar>(), {.keep_trace = true});
}

// Hides an objective's own Path: everything through Evaluate.
class PlainlyEvaluated : public Objective {
 public:
  explicit PlainlyEvaluated(const Objective& objective)
      : objective_(objective) {}
  Eigen::Index num_parameters() const override {
    return objective_.num_parameters();
  }
  double Evaluate(const Vector& x, Vector* gradient) const override {
    return objective_.Evaluate(x, gradient);
  }

 private:
  const Objective& objective_;
};

// The same with curvatures by extrapolation, good to about ten digits.
class ExtrapolatedCurvature final : public PlainlyEvaluated {
 public:
  using PlainlyEvaluated::PlainlyEvaluated;
  std::unique_ptr<Path<double>> NewPath(const Vector& x) const override {
    return std::make_unique<RiddersPath>(*this, x);
  }

 private:
  class RiddersPath final : public Path<double> {
   public:
    RiddersPath(const Objective& f, const Vector& x) : f_(f), x_(x) {}
    void SetDirection(const Vector& p) override { p_ = p; }
    double Curvature() override { return RiddersCurvature(f_, x_, p_); }
    double Value(double a) override {
      return f_.Evaluate(x_ + a * p_, nullptr);
    }
    void Accept(double a) override { x_ += a * p_; }
    const Vector& Gradient() override {
      f_.Evaluate(x_, &gradient_);
      return gradient_;
    }

   private:
    const Objective& f_;
    Vector x_;
    Vector p_;
    Vector gradient_;
  };
};

void ExpectSameTrace(const FitSummary& found,
                     const FitSummary& expected,
                     double tolerance) {
  ASSERT_EQ(found.trace.size(), expected.trace.size());
  for (std::size_t i = 0; i < found.trace.size(); ++i) {
    SCOPED_TRACE("iteration " + std::to_string(i));
    EXPECT_NEAR(found.trace[i].rms_error,
                expected.trace[i].rms_error,
                tolerance * expected.trace[i].rms_error);
  }
  // A curvature is one evaluation of the net, two gradients through Evaluate.
  EXPECT_EQ(found.gradient_evaluations + 2 * found.curvature_evaluations,
            expected.gradient_evaluations + 2 * expected.curvature_evaluations);
  EXPECT_EQ(found.value_evaluations, expected.value_evaluations);
}

TEST(ScaledConjugateGradient, MollerOnANetIsMollerThroughPlainEvaluations) {
  // Ten digits of curvature, which the iteration amplifies; a difference of
  // gradients has eight.
  constexpr double kExtrapolated = 1e-8;
  constexpr double kQuotient = 1e-6;
  const auto net = SmallNet<double>();
  const StoppingRules rules{.iterations = 20};
  const auto run = [&](const Objective& f) {
    return MinimizeSmallNet<double>(f, ScgVariant::kMoller, rules).summary;
  };
  const FitSummary fast = run(net);
  EXPECT_EQ(fast.iterations, rules.iterations);
  ExpectSameTrace(fast, run(ExtrapolatedCurvature(net)), kExtrapolated);
  ExpectSameTrace(fast, run(PlainlyEvaluated(net)), kQuotient);
}

TEST(ScaledConjugateGradient, MollerTakesOneCurvatureAndOneValueAnIteration) {
  const FitSummary summary =
      MinimizeSmallNet<double>(
          SmallNet<double>(), ScgVariant::kMoller, {.iterations = 200})
          .summary;
  EXPECT_EQ(summary.iterations, 200);
  // A rejected trial costs a value, the first in a row another.
  EXPECT_LE(summary.curvature_evaluations, 200);
  EXPECT_LE(summary.value_evaluations, 240);
  // Those accepted, the start and the end.
  EXPECT_EQ(summary.gradient_evaluations, 202);
}

TEST(ScaledConjugateGradient, SolvesANetToAMinimumInEitherVariant) {
  for (const auto variant : {ScgVariant::kMoller, ScgVariant::kNetcg}) {
    SCOPED_TRACE(std::string(ToString(variant)));
    const auto net = SmallNet<double>();
    const Minimum minimum = MinimizeSmallNet<double>(
        net, variant, {.iterations = 20'000, .gradient_goal = 1e-8});
    EXPECT_EQ(minimum.summary.termination, Termination::kGradient);
    Eigen::VectorXd gradient;
    EXPECT_EQ(net.Evaluate(minimum.x, &gradient), minimum.summary.final_cost);
    EXPECT_EQ(gradient.norm(), minimum.summary.final_gradient_norm);
    EXPECT_LT(gradient.norm(), 1e-8 * minimum.x.norm());
  }
}

// A goal of 1e-12 lies below what the cost can resolve: the run ends where it
// has its minimum to nine digits, and says so. A goal of 1e-9, reached before,
// leaves a little more to gain.
TEST(ScaledConjugateGradient, ConvergesAtTheResolutionOfTheCost) {
  constexpr double kLeftByTheGoal = 1e-6;
  const auto net = SmallNet<double>();
  const auto run = [&](double goal) {
    return MinimizeSmallNet<double>(
        net,
        ScgVariant::kMoller,
        {.iterations = 20'000, .gradient_goal = goal});
  };
  const Minimum reachable = run(1e-9);
  EXPECT_EQ(reachable.summary.termination, Termination::kGradient);
  for (const double goal : {1e-12, 0.0}) {
    const Minimum minimum = run(goal);
    const FitSummary& summary = minimum.summary;
    EXPECT_EQ(summary.termination, Termination::kResolution) << summary.message;
    EXPECT_TRUE(summary.converged());
    EXPECT_THAT(summary.message, HasSubstr("the resolution of the cost"));
    EXPECT_GT(summary.iterations, reachable.summary.iterations);
    EXPECT_LE(summary.final_cost, reachable.summary.final_cost);
    EXPECT_GE(summary.final_cost,
              (1.0 - kLeftByTheGoal) * reachable.summary.final_cost);
    ExpectTrueClaim(net, minimum, goal);
    EXPECT_GT(summary.final_gradient_norm, goal * minimum.x.norm());
    Eigen::VectorXd gradient;
    EXPECT_EQ(net.Evaluate(minimum.x, &gradient), summary.final_cost);
    EXPECT_EQ(gradient.norm(), summary.final_gradient_norm);
  }
  // The 1995 program knows no such end.
  const Minimum netcg = MinimizeSmallNet<double>(
      net, ScgVariant::kNetcg, {.iterations = 20'000, .gradient_goal = 1e-12});
  EXPECT_NE(netcg.summary.termination, Termination::kResolution);
}

// The limit holds while the end looks around.
TEST(ScaledConjugateGradient, LooksAroundWithinItsEvaluations) {
  const auto net = SmallNet<double>();
  StoppingRules rules{.iterations = 20'000, .gradient_goal = 0.0};
  const std::int64_t all =
      MinimizeSmallNet<double>(net, ScgVariant::kMoller, rules)
          .summary.evaluations();
  for (const std::int64_t fewer : {1, 2, 3, 10, 30, 70, 100}) {
    rules.evaluations = all - fewer;
    const FitSummary summary =
        MinimizeSmallNet<double>(net, ScgVariant::kMoller, rules).summary;
    EXPECT_LE(summary.evaluations(), rules.evaluations);
    EXPECT_EQ(summary.termination, Termination::kEvaluationLimit);
  }
}

TEST(ScaledConjugateGradient, SinglePrecisionTellsOfThePointItGivesBack) {
  for (const auto variant : {ScgVariant::kMoller, ScgVariant::kNetcg}) {
    SCOPED_TRACE(std::string(ToString(variant)));
    const auto net = SmallNet<float>();
    const Minimum minimum =
        MinimizeSmallNet<float>(net, variant, {.iterations = 200});
    EXPECT_EQ(minimum.summary.iterations, 200);
    Eigen::VectorXf gradient;
    const float cost = net.Evaluate(minimum.x.cast<float>(), &gradient);
    EXPECT_EQ(static_cast<double>(cost), minimum.summary.final_cost);
    EXPECT_EQ(static_cast<double>(gradient.norm()),
              minimum.summary.final_gradient_norm);
    const double in_double = SmallNet<double>().Evaluate(minimum.x, nullptr);
    EXPECT_NEAR(minimum.summary.final_cost, in_double, 1e-5 * in_double);
    EXPECT_LT(minimum.summary.final_cost, 0.1 * minimum.summary.initial_cost);
  }
}

// A limit of single precision: it must end, and claim nothing.
TEST(ScaledConjugateGradient, SinglePrecisionClaimsNoDoubleMinimum) {
  for (const auto variant : {ScgVariant::kMoller, ScgVariant::kNetcg}) {
    const Minimum minimum = MinimizeSmallNet<float>(
        SmallNet<float>(), variant, {.iterations = 5000});
    EXPECT_FALSE(minimum.summary.converged()) << ToString(variant);
    EXPECT_GT(minimum.summary.final_gradient_norm, 0.0);
  }
}

TEST(ScaledConjugateGradient, KeepsATraceFromTheStartWhenAsked) {
  const GoldenCase golden = ReadGoldenCase("case_c");
  ScaledConjugateGradientOptions options;
  options.stopping.iterations = 5;
  const Minimum minimum = ScaledConjugateGradient(options).Minimize(
      golden.Objective(), golden.initial_weights, {.keep_trace = true});
  ASSERT_EQ(minimum.summary.trace.size(), 6U);
  EXPECT_EQ(minimum.summary.trace.front().iteration, 0);
  EXPECT_DOUBLE_EQ(minimum.summary.trace.back().rms_error,
                   std::sqrt(2.0 * minimum.summary.final_cost));
}

TEST(ScaledConjugateGradient, TellsTheObserverOfEveryPass) {
  for (const auto variant : {ScgVariant::kMoller, ScgVariant::kNetcg}) {
    std::vector<ScgPass> passes;
    ScaledConjugateGradientOptions options;
    options.variant = variant;
    options.stopping.iterations = 100;
    options.observer = [&](const ScgPass& pass) { passes.push_back(pass); };
    const Minimum minimum = ScaledConjugateGradient(options).Minimize(
        SmallNet<double>(), SmallNetStart());
    std::int64_t accepted = 0;
    for (std::size_t i = 0; i < passes.size(); ++i) {
      EXPECT_EQ(passes[i].pass, static_cast<std::int64_t>(i) + 1);
      accepted += passes[i].accepted ? 1 : 0;
      EXPECT_EQ(passes[i].iteration, accepted);
      EXPECT_GT(passes[i].lambda, 0.0);
    }
    EXPECT_EQ(accepted, minimum.summary.iterations);
  }
}

TEST(ScaledConjugateGradientOptions, RefuseEachValueOutOfRange) {
  const auto message = [](ScaledConjugateGradientOptions options) {
    try {
      options.Validate();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message({}), "");
  EXPECT_THAT(message({.initial_lambda = 0.0}), HasSubstr("initial_lambda"));
  EXPECT_THAT(message({.sigma = -1.0}), HasSubstr("sigma"));
  EXPECT_THAT(message({.stopping = {.iterations = -1}}),
              HasSubstr("iterations"));
}

}  // namespace
}  // namespace errmap::fitting
