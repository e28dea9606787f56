#include "fitting/minimisers/scaled_conjugate_gradient.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/net/net_objective.h"
#include "tests/fitting/claimed_minimum.h"
#include "tests/fitting/test_problems.h"
#include "tests/models/golden_netcg.h"
#include "tests/models/net/net_test_cases.h"
#include "tests/random_matrix.h"

namespace errmap::fitting {
namespace {

using errmap::testing::ExpectTrueClaim;
using errmap::testing::GoldenCase;
using errmap::testing::GoldenPath;
using errmap::testing::RandomMatrix;
using errmap::testing::ReadGoldenCase;
using errmap::testing::RiddersCurvature;
using models::NetArithmetic;
using ::testing::HasSubstr;

// How far a comparison of trajectories means anything: rounding is amplified
// by the iteration (tests/golden/README.md).
constexpr double kSameDigits = 1e-9;
constexpr double kLateDigits = 1e-6;
constexpr double kSingleDigits = 1e-3;

struct GoldenRun {
  Minimum minimum;
  std::vector<ScgPass> passes;
};

template <typename Scalar = double>
GoldenRun RunCase(const GoldenCase& golden) {
  const auto& run = golden.json["run"];
  GoldenRun result;
  ScaledConjugateGradientOptions options;
  options.variant = ScgVariant::kNetcg;
  options.stopping = {.iterations = run["niter"],
                      .cost_goal = run["egoal"],
                      .gradient_goal = run["gwgoal"],
                      .slow_ratio = run["errdel"],
                      .progress_interval = run["nfreq"]};
  options.observer = [&](const ScgPass& pass) {
    result.passes.push_back(pass);
  };
  const models::BasicNetObjective<Scalar> objective(golden.shape,
                                                    golden.inputs,
                                                    golden.scaled_targets,
                                                    golden.wfactor,
                                                    {},
                                                    NetArithmetic::kPlain);
  result.minimum = BasicScaledConjugateGradient<Scalar>(options).Minimize(
      objective, golden.initial_weights.template cast<Scalar>());
  return result;
}

bool Has(const std::string& events, const std::string& event) {
  const std::string marked = "|" + events + "|";
  return marked.find("|" + event + "|") != std::string::npos;
}

// Compares E_rms pass by pass up to `iterations`, and every event with it.
void ExpectSameTrajectory(const GoldenCase& golden,
                          const GoldenRun& run,
                          std::int64_t iterations,
                          double tolerance) {
  const auto& rows = golden.json["trajectory"];
  std::size_t compared = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& row = rows[i];
    if (row[1].get<std::int64_t>() > iterations) break;
    ASSERT_LT(i - 1, run.passes.size());
    const ScgPass& pass = run.passes[i - 1];
    const double expected = row[3];
    const std::string events = row[7];
    SCOPED_TRACE("pass " + std::to_string(i) + ", events " + events);
    EXPECT_NEAR(std::sqrt(2.0 * pass.cost), expected, tolerance * expected);
    EXPECT_EQ(pass.iteration, row[1].get<std::int64_t>());
    EXPECT_EQ(pass.accepted, !Has(events, "fail"));
    EXPECT_EQ(pass.made_definite, Has(events, "deltak<=0"));
    EXPECT_EQ(pass.restarted, Has(events, "restart"));
    EXPECT_EQ(pass.gave_up_direction, Has(events, "fail_restart"));
    ++compared;
  }
  EXPECT_GE(compared, static_cast<std::size_t>(iterations));
}

TEST(ScaledConjugateGradient, FollowsTheReportsProgramOnRawInputs) {
  const GoldenCase golden = ReadGoldenCase("case_a");
  ExpectSameTrajectory(golden, RunCase(golden), 30, kSameDigits);
}

TEST(ScaledConjugateGradient, FollowsTheReportsProgramOnScaledInputs) {
  const GoldenCase golden = ReadGoldenCase("case_b");
  ExpectSameTrajectory(golden, RunCase(golden), 30, kSameDigits);
}

TEST(ScaledConjugateGradient, FollowsTheReportsProgramToTheEndOfASmallRun) {
  const GoldenCase golden = ReadGoldenCase("case_c");
  const GoldenRun run = RunCase(golden);
  ExpectSameTrajectory(golden, run, 60, kSameDigits);
  EXPECT_EQ(run.minimum.summary.termination, Termination::kIterationLimit);
  EXPECT_FALSE(run.minimum.summary.converged());
  const Eigen::VectorXd expected =
      errmap::testing::ToVector(golden.json["weights_final"]);
  EXPECT_LT((run.minimum.x - expected).norm(), 1e-8 * expected.norm());
}

TEST(ScaledConjugateGradient, RepairsFailsAndRestartsInTheSamePasses) {
  const GoldenCase golden = ReadGoldenCase("case_d1");
  const GoldenRun run = RunCase(golden);
  ExpectSameTrajectory(golden, run, 100, kSameDigits);
  ExpectSameTrajectory(golden, run, 120, kLateDigits);
}

TEST(ScaledConjugateGradient, MultipliesLambdaBySixteenAfterAPoorSuccess) {
  const GoldenCase golden = ReadGoldenCase("case_d2");
  ExpectSameTrajectory(golden, RunCase(golden), 120, kLateDigits);
}

TEST(ScaledConjugateGradient, FollowsTheReportsProgramInSinglePrecision) {
  nlohmann::json single;
  std::ifstream(GoldenPath("single.json")) >> single;
  const auto expect = [&](const std::string& name, std::int64_t iterations) {
    SCOPED_TRACE(name);
    GoldenCase golden = ReadGoldenCase(name);
    golden.json["trajectory"] = single[name];
    ExpectSameTrajectory(
        golden, RunCase<float>(golden), iterations, kSingleDigits);
  };
  expect("case_a", 5);
  expect("case_b", 5);
  expect("case_c", 5);
  expect("case_d1", 3);
}

void ExpectSameEnd(const std::string& name, Termination termination) {
  const GoldenCase golden = ReadGoldenCase(name);
  const GoldenRun run = RunCase(golden);
  EXPECT_EQ(run.minimum.summary.termination, termination) << name;
  EXPECT_EQ(run.minimum.summary.iterations,
            golden.json["result"]["k"].get<std::int64_t>())
      << name;
}

TEST(ScaledConjugateGradient, StopsWhereTheReportsProgramStops) {
  ExpectSameEnd("case_c_stop_egoal", Termination::kCostGoal);
  ExpectSameEnd("case_c_stop_gwgoal", Termination::kGradient);
  ExpectSameEnd("case_c_stop_slow", Termination::kSlowProgress);
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
  EXPECT_EQ(found.curvature_evaluations, expected.curvature_evaluations);
  EXPECT_EQ(found.value_evaluations, expected.value_evaluations);
  EXPECT_EQ(found.gradient_evaluations, expected.gradient_evaluations);
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

// A quadratic whose path tells of a share of its gradient or cost.
class LyingPathObjective final : public Objective {
 public:
  LyingPathObjective(double gradient_share, double cost_share)
      : gradient_share_(gradient_share), cost_share_(cost_share) {}

  Eigen::Index num_parameters() const override { return 3; }
  double Evaluate(const Vector& x, Vector* gradient) const override {
    if (gradient != nullptr) *gradient = scales_.cwiseProduct(x);
    return 0.5 * x.dot(scales_.cwiseProduct(x));
  }
  std::unique_ptr<Path<double>> NewPath(const Vector& x) const override {
    return std::make_unique<LyingPath>(*this, x);
  }

 private:
  class LyingPath final : public Path<double> {
   public:
    LyingPath(const LyingPathObjective& owner, const Vector& x)
        : owner_(owner), x_(x) {}
    void SetDirection(const Vector& p) override { p_ = p; }
    double Curvature() override {
      return p_.dot(owner_.scales_.cwiseProduct(p_));
    }
    double Value(double a) override {
      return owner_.cost_share_ * owner_.Evaluate(x_ + a * p_, nullptr);
    }
    void Accept(double a) override { x_ += a * p_; }
    const Vector& Gradient() override {
      owner_.Evaluate(x_, &gradient_);
      gradient_ *= owner_.gradient_share_;
      return gradient_;
    }

   private:
    const LyingPathObjective& owner_;
    Vector x_;
    Vector p_;
    Vector gradient_;
  };

  const Eigen::Vector3d scales_{1.0, 10.0, 100.0};
  double gradient_share_;
  double cost_share_;
};

TEST(ScaledConjugateGradient, BelievesNoPathThatClaimsAMinimum) {
  constexpr double kGoal = 1e-3;
  const LyingPathObjective f(1e-9, 1.0);
  ScaledConjugateGradientOptions options;
  options.stopping.gradient_goal = kGoal;
  for (const std::int64_t iterations : {1, 2, 3}) {
    options.stopping.iterations = iterations;
    const Minimum early = ScaledConjugateGradient(options).Minimize(
        f, Eigen::Vector3d(1.0, 2.0, 3.0));
    EXPECT_EQ(early.summary.termination, Termination::kIterationLimit);
    Eigen::VectorXd gradient;
    EXPECT_EQ(early.summary.final_cost, f.Evaluate(early.x, &gradient));
    EXPECT_EQ(early.summary.final_gradient_norm, gradient.norm());
    EXPECT_GT(gradient.norm(), kGoal);
  }
  // From steepest descent each time it gets there all the same.
  options.stopping.iterations = 10'000;
  const Minimum minimum = ScaledConjugateGradient(options).Minimize(
      f, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(minimum.summary.termination, Termination::kGradient);
  EXPECT_LT(minimum.summary.final_gradient_norm, kGoal * 1.0);
}

TEST(ScaledConjugateGradient, BelievesNoPathThatClaimsTheCostGoal) {
  const LyingPathObjective f(1.0, 1e-9);
  ScaledConjugateGradientOptions options;
  options.stopping.cost_goal = 1e-2;
  options.stopping.iterations = 1;
  const Minimum minimum = ScaledConjugateGradient(options).Minimize(
      f, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(minimum.summary.termination, Termination::kIterationLimit);
  EXPECT_EQ(minimum.summary.final_cost, f.Evaluate(minimum.x, nullptr));
  EXPECT_GT(minimum.summary.final_cost, 1e-4);
}

// Eq. (109) of NISTIR 5367: p1 = r1 + beta p0, beta = (|r1|^2 - r1'r0) / mu0.
TEST(ScaledConjugateGradient, MollerTurnsByTheBetaOfEquation109) {
  constexpr double kRounding = 1e-12;
  const auto problem = errmap::testing::Wood();
  std::vector<ScgPass> passes;
  const auto point_after = [&](std::int64_t iterations) {
    passes.clear();
    ScaledConjugateGradientOptions options;
    options.stopping.iterations = iterations;
    options.observer = [&](const ScgPass& pass) { passes.push_back(pass); };
    return ScaledConjugateGradient(options)
        .Minimize(*problem.objective, problem.start)
        .x;
  };
  const Eigen::VectorXd x1 = point_after(1);
  const Eigen::VectorXd x2 = point_after(2);
  for (const ScgPass& pass : passes) {
    ASSERT_FALSE(pass.restarted || pass.gave_up_direction);
  }
  Eigen::VectorXd r0;
  Eigen::VectorXd r1;
  problem.objective->Evaluate(problem.start, &r0);
  problem.objective->Evaluate(x1, &r1);
  r0 = -r0;
  r1 = -r1;
  const double beta = (r1.squaredNorm() - r1.dot(r0)) / r0.squaredNorm();
  const Eigen::VectorXd p1 = r1 + beta * r0;
  const Eigen::VectorXd step = x2 - x1;
  EXPECT_NEAR(step.dot(p1),
              step.norm() * p1.norm(),
              kRounding * step.norm() * p1.norm());
  EXPECT_NEAR((x1 - problem.start).dot(r0),
              (x1 - problem.start).norm() * r0.norm(),
              kRounding * (x1 - problem.start).norm() * r0.norm());
}

// Eq. (110) and (111): lambda halves after a good success (comparison >= 0.75),
// stays after a fair one, grows by delta (1 - comparison) / |p|^2 below 0.25.
TEST(ScaledConjugateGradient, MollerScalesLambdaByTheComparisonOfEquation110) {
  const auto problem = errmap::testing::Wood();
  std::vector<ScgPass> passes;
  ScaledConjugateGradientOptions options;
  options.stopping.iterations = 60;
  options.observer = [&](const ScgPass& pass) { passes.push_back(pass); };
  ScaledConjugateGradient(options).Minimize(*problem.objective, problem.start);
  int good = 0;
  int poor = 0;
  double before = options.initial_lambda;
  for (const ScgPass& pass : passes) {
    if (!pass.made_definite && !pass.restarted && !pass.gave_up_direction) {
      if (pass.accepted && pass.comparison >= 0.75) {
        EXPECT_EQ(pass.lambda, 0.5 * before);
        ++good;
      } else if (pass.accepted && pass.comparison >= 0.25) {
        EXPECT_EQ(pass.lambda, before);
      } else {
        EXPECT_GT(pass.lambda, before);
        ++poor;
      }
    }
    before = pass.lambda;
  }
  EXPECT_GT(good, 5);
  EXPECT_GT(poor, 0);
}

// Trials that fail renew the cost by the path; what is told at the end is the
// objective's own word all the same.
TEST(ScaledConjugateGradient, TellsTheObjectivesCostAfterTrialsThatFailed) {
  const LyingPathObjective f(1.0, 1e6);
  const Eigen::VectorXd start = Eigen::Vector3d(1.0, 2.0, 3.0);
  for (std::int64_t evaluations = 1; evaluations <= 30; ++evaluations) {
    ScaledConjugateGradientOptions options;
    options.stopping.evaluations = evaluations;
    const Minimum minimum = ScaledConjugateGradient(options).Minimize(f, start);
    Eigen::VectorXd gradient;
    EXPECT_EQ(minimum.summary.final_cost, f.Evaluate(minimum.x, &gradient))
        << evaluations;
    EXPECT_EQ(minimum.summary.final_gradient_norm, gradient.norm());
    EXPECT_LE(minimum.summary.evaluations(), evaluations);
  }
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

// 1 + cos x, whose Hessian is negative where the run begins.
class Cosine final : public Objective {
 public:
  Eigen::Index num_parameters() const override { return 1; }
  double Evaluate(const Eigen::VectorXd& x,
                  Eigen::VectorXd* gradient) const override {
    if (gradient != nullptr) {
      *gradient = Eigen::VectorXd::Constant(1, -std::sin(x[0]));
    }
    return 1.0 + std::cos(x[0]);
  }
};

// Eq. (105) turns delta = p'Hp + lambda p'p into -p'Hp, whatever lambda was.
TEST(ScaledConjugateGradient, MollerTurnsNegativeCurvatureRound) {
  std::vector<ScgPass> passes;
  ScaledConjugateGradientOptions options;
  options.stopping.iterations = 1;
  options.observer = [&](const ScgPass& pass) { passes.push_back(pass); };
  ScaledConjugateGradient(options).Minimize(Cosine(), Eigen::VectorXd::Ones(1));
  ASSERT_FALSE(passes.empty());
  EXPECT_TRUE(passes[0].made_definite);
  constexpr double kOfDifferences = 1e-4;  // p'Hp by default
  EXPECT_NEAR(passes[0].alpha, 1.0 / std::cos(1.0), kOfDifferences);
}

}  // namespace
}  // namespace errmap::fitting
