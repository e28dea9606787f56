#include "fitting/minimisers/levenberg_marquardt.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/minimisers/damped_least_squares.h"
#include "tests/decompositions.h"
#include "tests/fitting/claimed_minimum.h"
#include "tests/fitting/optimizer_cases.h"
#include "tests/fitting/residual_problems.h"
#include "tests/fitting/test_problems.h"
#include "tests/numbers.h"
#include "tests/random_matrix.h"

namespace errmap::fitting {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::AllResidualProblems;
using errmap::testing::ExpectTrueClaim;
using errmap::testing::FunctionObjective;
using errmap::testing::RandomMatrix;
using errmap::testing::ResidualCode;
using errmap::testing::ResidualObjective;
using errmap::testing::ResidualProblem;
using ::testing::AnyOf;
using ::testing::HasSubstr;

struct Way {
  std::string name;  // letters only: part of a test's name
  LmSpace space;
  LmScaling scaling;
};

void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

std::vector<Way> AllWays() {
  return {{"Parameters", LmSpace::kParameters, LmScaling::kNone},
          {"Scaled", LmSpace::kParameters, LmScaling::kMarquardt},
          {"Patterns", LmSpace::kPatterns, LmScaling::kNone}};
}

LevenbergMarquardt Make(const Way& way, const StoppingRules& stopping = {}) {
  return LevenbergMarquardt(
      {.stopping = stopping, .scaling = way.scaling, .space = way.space});
}

class LmOnProblem
    : public ::testing::TestWithParam<std::tuple<Way, ResidualProblem>> {
 protected:
  static const Way& way() { return std::get<0>(GetParam()); }
  static const ResidualProblem& problem() { return std::get<1>(GetParam()); }
};

TEST_P(LmOnProblem, FindsAMinimum) {
  // 2 f of the catalogue is given to about ten digits.
  constexpr double kNear = 1e-9;
  const ResidualObjective f = problem().Objective();
  const Minimum minimum =
      Make(way(), {.iterations = 500, .gradient_goal = 1e-10})
          .Minimize(f, problem().start);
  EXPECT_EQ(minimum.summary.termination, Termination::kGradient)
      << minimum.summary.message;
  double nearest = kInfinity;
  for (const double squares : problem().least_squares) {
    nearest = std::min(nearest,
                       std::abs(2.0 * minimum.summary.final_cost - squares) /
                           std::max(1.0, squares));
  }
  EXPECT_LT(nearest, kNear);
}

TEST_P(LmOnProblem, SaysWhatIsTrueHoweverItEnds) {
  for (const double goal : {1e-2, 1e-8, 1e-12, 0.0}) {
    const StoppingRules rules{.iterations = 300, .gradient_goal = goal};
    const ResidualObjective f = problem().Objective();
    const Minimum minimum =
        Make(way(), rules).Minimize(f, problem().start, {.keep_trace = true});
    const FitSummary& summary = minimum.summary;
    EXPECT_LE(summary.iterations, rules.iterations);
    EXPECT_EQ(summary.value_evaluations, f.values());
    EXPECT_EQ(summary.gradient_evaluations, f.jacobians());
    VectorXd gradient;
    EXPECT_EQ(summary.final_cost, f.Evaluate(minimum.x, &gradient));
    EXPECT_EQ(summary.final_gradient_norm, gradient.norm());
    ExpectTrueClaim(f, minimum, goal);
    if (!summary.converged()) {
      EXPECT_THAT(summary.termination,
                  AnyOf(Termination::kNoDescent, Termination::kIterationLimit));
    }
    // The cost rises by no more than its resolution, here in its root.
    for (std::size_t i = 1; i < summary.trace.size(); ++i) {
      EXPECT_LE(summary.trace[i].rms_error,
                summary.trace[i - 1].rms_error * (1.0 + 1e-10));
    }
  }
}

TEST_P(LmOnProblem, KeepsItsLimits) {
  for (std::int64_t limit = 1; limit <= 30; ++limit) {
    const ResidualObjective f = problem().Objective();
    const Minimum minimum =
        Make(way(), {.evaluations = limit}).Minimize(f, problem().start);
    EXPECT_EQ(minimum.summary.evaluations(), f.values() + f.jacobians());
    EXPECT_LE(minimum.summary.evaluations(), limit);
    EXPECT_LE(minimum.summary.final_cost, minimum.summary.initial_cost);
    const FitSummary summary =
        Make(way(), {.iterations = limit}).Minimize(f, problem().start).summary;
    EXPECT_LE(summary.iterations, limit);
  }
}

TEST_P(LmOnProblem, AStopAskedForBeforeLeavesTheStart) {
  const std::atomic<bool> stop = true;
  const ResidualObjective f = problem().Objective();
  const Minimum minimum =
      Make(way()).Minimize(f, problem().start, {.stop = &stop});
  EXPECT_EQ(minimum.summary.termination, Termination::kInterrupted);
  EXPECT_EQ(minimum.x, problem().start);
  EXPECT_EQ(f.values() + f.jacobians(), 1);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    LmOnProblem,
    ::testing::Combine(::testing::ValuesIn(AllWays()),
                       ::testing::ValuesIn(AllResidualProblems())),
    [](const ::testing::TestParamInfo<std::tuple<Way, ResidualProblem>>&
           instance) {
      return std::get<0>(instance.param).name + "On" +
             std::get<1>(instance.param).name;
    });

// r = A x - b.
ResidualObjective Linear(const MatrixXd& a, const VectorXd& b) {
  return {
      a.rows(), a.cols(), [a, b](const VectorXd& x, VectorXd* r, MatrixXd* j) {
        *r = a * x - b;
        if (j != nullptr) *j = a;
      }};
}

LevenbergMarquardt OneUndampedStep(const Way& way) {
  return LevenbergMarquardt({.stopping = {.iterations = 1},
                             .initial_damping = 1e-14,
                             .scaling = way.scaling,
                             .space = way.space});
}

TEST(LevenbergMarquardt, SolvesLinearLeastSquaresInOneStep) {
  constexpr double kTolerance = 1e-10;
  const MatrixXd a = RandomMatrix(30, 4, 1);
  const VectorXd b = RandomMatrix(30, 1, 2);
  const VectorXd expected = testing::LeastSquares(a, b);
  for (const Way& way : AllWays()) {
    SCOPED_TRACE(way.name);
    // Of J J' + mu I, singular but for mu, little is left.
    const double tolerance =
        way.space == LmSpace::kPatterns ? 1e-1 : kTolerance;
    const Minimum minimum =
        OneUndampedStep(way).Minimize(Linear(a, b), VectorXd::Ones(4));
    EXPECT_LT((minimum.x - expected).norm(), tolerance);
  }
}

// Where the ridge is most of the cost, a step is judged by it.
TEST(LevenbergMarquardt, SolvesRidgeRegressionInOneStep) {
  constexpr double kTolerance = 1e-8;
  constexpr double kRidge = 1e8;
  const MatrixXd a = RandomMatrix(30, 4, 1);
  const VectorXd b = RandomMatrix(30, 1, 2);
  const VectorXd expected = testing::SolveSymmetric(
      a.transpose() * a + kRidge * MatrixXd::Identity(4, 4), a.transpose() * b);
  ResidualObjective f = Linear(a, b);
  f.SetRidge(kRidge);
  for (const Way& way : AllWays()) {
    SCOPED_TRACE(way.name);
    const Minimum minimum = OneUndampedStep(way).Minimize(f, VectorXd::Zero(4));
    EXPECT_LT((minimum.x - expected).norm(), kTolerance * expected.norm());
  }
}

TEST(LevenbergMarquardt, BothSpacesGiveTheSameStep) {
  constexpr double kTolerance = 1e-9;
  for (const double ridge : {0.0, 1e-3, 2.0}) {
    for (const auto& [rows, columns] :
         {std::pair{12, 5}, std::pair{5, 12}, std::pair{7, 7}}) {
      const MatrixXd a = RandomMatrix(rows, columns, 3);
      ResidualObjective f(
          rows, columns, [a](const VectorXd& x, VectorXd* r, MatrixXd* j) {
            const VectorXd s = a * x;
            *r = s.array().tanh() + 0.3;
            if (j == nullptr) return;
            *j = (1.0 - s.array().tanh().square()).matrix().asDiagonal() * a;
          });
      f.SetRidge(ridge);
      const VectorXd start = RandomMatrix(columns, 1, 4);
      VectorXd in_parameters;
      for (const Way& way : {AllWays()[0], AllWays()[2]}) {
        const VectorXd x = Make(way, {.iterations = 3}).Minimize(f, start).x;
        if (way.space == LmSpace::kParameters) {
          in_parameters = x;
        } else {
          EXPECT_LT((x - in_parameters).norm(), kTolerance)
              << rows << " x " << columns << ", ridge " << ridge;
        }
      }
    }
  }
}

TEST(LevenbergMarquardt, TakesTheSmallerSpaceByItself) {
  for (const auto& [rows, columns] : {std::pair{12, 5}, std::pair{5, 12}}) {
    const ResidualObjective f =
        Linear(RandomMatrix(rows, columns, 1), RandomMatrix(rows, 1, 2));
    const VectorXd start = VectorXd::Ones(columns);
    const auto run = [&](LmSpace space) {
      return LevenbergMarquardt({.stopping = {.iterations = 2}, .space = space})
          .Minimize(f, start)
          .x;
    };
    EXPECT_EQ(run(LmSpace::kAuto),
              run(rows < columns ? LmSpace::kPatterns : LmSpace::kParameters));
  }
}

// Costs are told apart to 1e-16, so the parameters of a minimum with residuals
// to 1e-8 by costs alone.
TEST(LevenbergMarquardt, FindsParametersToTheDigitsOfTheGradient) {
  // NIST StRD, BoxBOD: certified to 11 digits, from both starts.
  constexpr double kDigits = 5e-11;
  const VectorXd t{{1.0, 2.0, 3.0, 5.0, 7.0, 10.0}};
  const VectorXd y{{109.0, 149.0, 149.0, 191.0, 213.0, 224.0}};
  const ResidualObjective f(
      6, 2, [t, y](const VectorXd& b, VectorXd* r, MatrixXd* j) {
        const Eigen::ArrayXd e = (-b[1] * t.array()).exp();
        *r = y.array() - b[0] * (1.0 - e);
        if (j == nullptr) return;
        j->col(0) = e - 1.0;
        j->col(1) = -b[0] * t.array() * e;
      });
  // A Gauss-Newton step from the first start ends where f is flat.
  for (const auto& [start, damping] :
       {std::pair{VectorXd{{1.0, 1.0}}, 100.0},
        std::pair{VectorXd{{100.0, 0.75}}, 1e-3}}) {
    const LevenbergMarquardt lm(
        {.initial_damping = damping, .scaling = LmScaling::kMarquardt});
    const Minimum minimum = lm.Minimize(f, start);
    EXPECT_NEAR(minimum.x[0] / 2.1380940889e+02, 1.0, kDigits)
        << minimum.summary.message;
    EXPECT_NEAR(minimum.x[1] / 5.4723748542e-01, 1.0, kDigits);
  }
}

TEST(LevenbergMarquardt, ScaledStepsDoNotDependOnUnits) {
  constexpr double kTolerance = 1e-6;
  constexpr double kUnit = 1e7;
  const ResidualProblem bard = AllResidualProblems().back();
  const ResidualObjective f = bard.Objective();
  const VectorXd units{{1.0, kUnit, 1.0 / kUnit}};
  const ResidualObjective g(
      bard.m, 3, [&](const VectorXd& x, VectorXd* r, MatrixXd* j) {
        bard.code(x.cwiseProduct(units), r, j);
        if (j != nullptr) *j *= units.asDiagonal();
      });
  const auto lm = Make(AllWays()[1], {.iterations = 4});
  const VectorXd x = lm.Minimize(f, bard.start).x;
  const VectorXd z = lm.Minimize(g, bard.start.cwiseQuotient(units)).x;
  EXPECT_LT((z.cwiseProduct(units) - x).norm(), kTolerance);
}

// What goes wrong, in one parameter from x = 2 with r = x - 1.
struct Trouble {
  std::string name;  // letters only: part of a test's name
  ResidualCode code;
  double start = 2.0;
};

void PrintTo(const Trouble& trouble, std::ostream* out) {
  *out << trouble.name;
}

Trouble Make(std::string name,
             double (*residual)(double),
             double (*slope)(double),
             double start = 2.0) {
  return {std::move(name),
          [residual, slope](const VectorXd& x, VectorXd* r, MatrixXd* j) {
            (*r)[0] = residual(x[0]);
            if (j != nullptr) (*j)(0, 0) = slope(x[0]);
          },
          start};
}

std::vector<Trouble> AllTroubles() {
  return {
      Make(
          "Uphill", [](double x) { return x; }, [](double) { return -1.0; }),
      Make(
          "Flat", [](double) { return 1.0; }, [](double) { return 1.0; }),
      Make(
          "GoesFlat",
          [](double x) { return x < 1.0 ? 1.0 : x; },
          [](double x) { return x < 1.0 ? 0.0 : 1.0; }),
      Make(
          "NaNBelow",
          [](double x) { return x < 1.0 ? kNaN : x; },
          [](double) { return 1.0; }),
      Make(
          "InfiniteBelow",
          [](double x) { return x < 1.0 ? -kInfinity : x; },
          [](double) { return 1.0; }),
      Make(
          "NoJacobianBelow",
          [](double x) { return x; },
          [](double x) { return x < 2.0 ? kNaN : 1.0; }),
      Make(
          "OverflowingSlope",
          [](double x) { return x; },
          [](double) { return 1e150; }),
      Make(
          "NoFloor",
          [](double x) { return std::exp(-x); },
          [](double x) { return -std::exp(-x); }),
      Make(
          "Kink",
          [](double x) { return 1.0 + std::abs(x); },
          [](double x) { return x < 0.0 ? -1.0 : 1.0; }),
      Make(
          "TooSteep",
          [](double x) { return 1.0 + x * x; },
          [](double x) { return 2e6 * x; }),
  };
}

class LmInTrouble : public ::testing::TestWithParam<std::tuple<Way, Trouble>> {
};

TEST_P(LmInTrouble, EndsWithAPointAndAReasonThatAreTrue) {
  const Trouble& trouble = std::get<1>(GetParam());
  for (const double ridge : {0.0, 1e-3}) {
    for (const double goal : {1e-3, 1e-12, 0.0}) {
      ResidualObjective f(1, 1, trouble.code);
      f.SetRidge(ridge);
      const Minimum minimum =
          Make(std::get<0>(GetParam()), {.gradient_goal = goal})
              .Minimize(f, VectorXd{{trouble.start}});
      const FitSummary& summary = minimum.summary;
      VectorXd gradient;
      const double cost = f.Evaluate(minimum.x, &gradient);
      EXPECT_TRUE(std::isfinite(cost));
      EXPECT_EQ(summary.final_cost, cost);
      EXPECT_LE(summary.final_cost, summary.initial_cost);
      EXPECT_NE(summary.message, "still running");
      ExpectTrueClaim(f, minimum, goal);
      if (!summary.converged()) {
        EXPECT_THAT(
            summary.termination,
            AnyOf(Termination::kNoDescent, Termination::kIterationLimit));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All,
    LmInTrouble,
    ::testing::Combine(::testing::ValuesIn(AllWays()),
                       ::testing::ValuesIn(AllTroubles())),
    [](const ::testing::TestParamInfo<std::tuple<Way, Trouble>>& instance) {
      return std::get<0>(instance.param).name + "On" +
             std::get<1>(instance.param).name;
    });

// A residual form beside an objective that it is not, or a gradient.
class TwoWords final : public Objective {
 public:
  TwoWords(double cost_factor, double gradient_factor)
      : cost_factor_(cost_factor),
        gradient_factor_(gradient_factor),
        form_(Linear(MatrixXd{{1.0}, {2.0}}, VectorXd{{1.0, 1.0}})) {}
  Eigen::Index num_parameters() const override { return 1; }
  const ResidualFunction* residuals() const override { return &form_; }
  double Evaluate(const VectorXd& x, VectorXd* gradient) const override {
    const double cost = form_.Evaluate(x, gradient);
    if (gradient != nullptr) {
      *gradient = gradient_factor_ * *gradient;
      gradient->array() += gradient_factor_ - 1.0;
    }
    return cost_factor_ * cost;
  }

 private:
  double cost_factor_;
  double gradient_factor_;
  ResidualObjective form_;
};

TEST(LevenbergMarquardt, SaysThatTheResidualFormIsNotTheObjective) {
  const Minimum minimum =
      LevenbergMarquardt({}).Minimize(TwoWords(1.001, 1.0), VectorXd{{3.0}});
  EXPECT_EQ(minimum.summary.termination, Termination::kFailed);
  EXPECT_THAT(minimum.summary.message, HasSubstr("does not give"));
  EXPECT_EQ(minimum.x[0], 3.0);
}

// The same objective but for the lowest costs, of which it has `share`.
class LateDisagreement final : public Objective {
 public:
  explicit LateDisagreement(double share)
      : share_(share),
        form_(Linear(MatrixXd{{1.0}, {2.0}}, VectorXd{{1.0, 1.0}})) {}
  Eigen::Index num_parameters() const override { return 1; }
  const ResidualFunction* residuals() const override { return &form_; }
  double Evaluate(const VectorXd& x, VectorXd* gradient) const override {
    const double cost = form_.Evaluate(x, gradient);
    return x[0] < 2.0 ? share_ * cost : cost;
  }

 private:
  double share_;
  ResidualObjective form_;
};

TEST(LevenbergMarquardt, KeepsTheLowerPointWhereTheFormsPartLate) {
  const auto run = [](double share) {
    const LateDisagreement f(share);
    const Minimum minimum = LevenbergMarquardt({}).Minimize(f, VectorXd{{3.0}});
    EXPECT_EQ(minimum.summary.termination, Termination::kNoDescent);
    EXPECT_THAT(minimum.summary.message, HasSubstr("does not give"));
    EXPECT_EQ(minimum.summary.final_cost, f.Evaluate(minimum.x, nullptr));
    return minimum.x[0];
  };
  EXPECT_NEAR(run(1.01), 0.6, 1e-2);  // the form's minimum
  EXPECT_EQ(run(1e6), 3.0);           // the start is lower than that
}

TEST(LevenbergMarquardt, ClaimsAMinimumAtTheResolutionOfTheCost) {
  for (const ResidualProblem& problem : AllResidualProblems()) {
    if (problem.name != "Bard" && problem.name != "FreudensteinRoth") continue;
    const ResidualObjective f = problem.Objective();
    const Minimum minimum =
        LevenbergMarquardt(
            {.stopping = {.iterations = 500, .gradient_goal = 0.0}})
            .Minimize(f, problem.start);
    EXPECT_EQ(minimum.summary.termination, Termination::kResolution)
        << problem.name << ": " << minimum.summary.message;
    ExpectTrueClaim(f, minimum, 0.0);
  }
}

TEST(LevenbergMarquardt, ScalesByTheColumnsOfThePointsThatItTakes) {
  const ResidualObjective f(
      2, 2, [](const VectorXd& x, VectorXd* r, MatrixXd* jacobian) {
        *r = x.cwiseAbs2();
        if (jacobian != nullptr) *jacobian = (2.0 * x).asDiagonal();
      });
  const VectorXd start{{1.0, 2.0}};
  const VectorXd trial{{3.0, 0.5}};
  const VectorXd v{{1.0, 1.0}};
  const auto scale = std::make_shared<VectorXd>();
  const auto here = MakeParameterSpace(*f.residuals(), scale);
  const auto there = MakeParameterSpace(*f.residuals(), scale);
  here->MoveTo(start);
  EXPECT_DOUBLE_EQ(here->ScaledSquaredNorm(v), 4.0 + 16.0);
  there->MoveTo(trial);
  EXPECT_DOUBLE_EQ(there->ScaledSquaredNorm(v), 4.0 + 16.0);
  here->MoveTo(start);
  EXPECT_DOUBLE_EQ(here->ScaledSquaredNorm(v), 4.0 + 16.0);
  there->Settle();
  EXPECT_DOUBLE_EQ(there->ScaledSquaredNorm(v), 36.0 + 16.0);
  // The same step as from columns that were scaled so from the beginning.
  const auto anew = MakeParameterSpace(*f.residuals(), scale);
  anew->MoveTo(trial);
  VectorXd step;
  VectorXd expected;
  ASSERT_TRUE(there->Solve(0.7, &step));
  ASSERT_TRUE(anew->Solve(0.7, &expected));
  EXPECT_LT((step - expected).norm(), 1e-14 * expected.norm());
}

TEST(LevenbergMarquardt, ClaimsNoMinimumWhereTheObjectiveDoesNot) {
  const Minimum minimum =
      LevenbergMarquardt({}).Minimize(TwoWords(1.0, 1.001), VectorXd{{3.0}});
  EXPECT_EQ(minimum.summary.termination, Termination::kNoDescent);
  EXPECT_THAT(minimum.summary.message, HasSubstr("the objective's own is not"));
}

TEST(LevenbergMarquardt, FailsAtAStartThatIsNotFinite) {
  const ResidualObjective f(
      1, 1, [](const VectorXd&, VectorXd* r, MatrixXd*) { (*r)[0] = kNaN; });
  const Minimum minimum = LevenbergMarquardt({}).Minimize(f, VectorXd{{1.0}});
  EXPECT_EQ(minimum.summary.termination, Termination::kFailed);
  EXPECT_THAT(minimum.summary.message, HasSubstr("not finite at the start"));
}

std::string MessageOf(const LevenbergMarquardtOptions& options) {
  try {
    options.Validate();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(LevenbergMarquardt, RefusesAnObjectiveWithoutResidualForm) {
  const FunctionObjective f(1, [](const VectorXd& x, VectorXd* gradient) {
    if (gradient != nullptr) *gradient = x;
    return 0.5 * x.squaredNorm();
  });
  try {
    LevenbergMarquardt({}).Minimize(f, VectorXd{{1.0}});
    ADD_FAILURE() << "was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("has no residual form"));
  }
}

TEST(LevenbergMarquardtOptions, RefuseWhatIsOutOfRange) {
  EXPECT_EQ(MessageOf({}), "");
  EXPECT_EQ(MessageOf({.step_tolerance = 0.0, .cost_resolution = 0.0}), "");
  for (const double bad : {0.0, -1.0, kNaN, kInfinity}) {
    EXPECT_THAT(MessageOf({.initial_damping = bad}),
                HasSubstr("initial_damping must be above 0 and finite, found"));
  }
  EXPECT_THAT(MessageOf({.step_tolerance = -1e-9}),
              HasSubstr("step_tolerance must be at least 0, found"));
  EXPECT_THAT(MessageOf({.cost_resolution = 1.0}),
              HasSubstr("cost_resolution must be at least 0 and below 1"));
  EXPECT_THAT(MessageOf({.scaling = LmScaling::kMarquardt,
                         .space = LmSpace::kPatterns}),
              HasSubstr("kMarquardt scales parameters"));
}

}  // namespace
}  // namespace errmap::fitting
