#include "fitting/nonlinear/nonlinear_regression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/minimisers/gradient_check.h"
#include "fitting/nonlinear/variable_projection.h"

namespace errmap::fitting {
namespace {

using stats::DoubleDouble;

// b1 (1 - exp(-b2 x)): NIST's BoxBOD, whose start 1 leads into a flat region.
struct Growth {
  static constexpr int kParameters = 2;
  static constexpr int kLinear[] = {0};
  template <typename T, typename X>
  static T Predict(const T* b, const X* x) {
    using std::exp;
    return b[0] * (T(X(1.0)) - exp(-b[1] * T(x[0])));
  }
};

// The same with its linear part written twice and once more as half of it:
// columns that depend on each other.
struct TripleGrowth {
  static constexpr int kParameters = 4;
  static constexpr int kLinear[] = {0, 1, 2};
  template <typename T, typename X>
  static T Predict(const T* b, const X* x) {
    using std::exp;
    const T growth = T(X(1.0)) - exp(-b[3] * T(x[0]));
    return b[0] * growth + b[1] * growth + b[2] * T(X(0.5)) * growth;
  }
};

// Every operation and function of Dual.
struct Everything {
  static constexpr int kParameters = 3;
  template <typename T, typename X>
  static T Predict(const T* b, const X* x) {
    using std::atan;
    using std::cos;
    using std::exp;
    using std::log;
    using std::pow;
    using std::sin;
    const T t(x[0]);
    return exp(-b[0] * t) * sin(b[1] * t) - cos(b[2]) / (t + b[0]) +
           log(b[1] + t) * atan(b[2] - t) + pow(b[0] + t, b[1]);
  }
};

FormulaRegression<Growth> BoxBod() {
  ExtendedMatrix x(6, 1);
  x << 1.0, 2.0, 3.0, 5.0, 7.0, 10.0;
  ExtendedVector y(6);
  y << 109.0, 149.0, 149.0, 191.0, 213.0, 224.0;
  return {x, y};
}

constexpr StoppingRules kStopping{.iterations = 1000};

TEST(FitNonlinearRegression, ReachesNistsDigitsFromBothStarts) {
  for (const Eigen::Vector2d& start :
       {Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d(100.0, 0.75)}) {
    const RegressionFit fit =
        FitNonlinearRegression(BoxBod(), start, kStopping);
    const RegressionStatistics& found = fit.statistics;
    // NIST StRD BoxBOD, 11 digits.
    EXPECT_NEAR(found.parameters[0], 213.80940889, 1e-8);
    EXPECT_NEAR(found.parameters[1], 0.54723748542, 1e-11);
    EXPECT_NEAR(found.standard_deviations[0], 12.354515176, 1e-9);
    EXPECT_NEAR(found.standard_deviations[1], 0.10455993237, 1e-11);
    EXPECT_NEAR(found.residual_sum_of_squares, 1168.0088766, 1e-7);
    EXPECT_EQ(found.degrees_of_freedom, 4);
    EXPECT_EQ(fit.summary.termination, Termination::kGradient);
    EXPECT_THAT(fit.summary.message, ::testing::HasSubstr("converged"));
  }
}

TEST(FitNonlinearRegression, SaysThatALimitStoppedIt) {
  const RegressionFit fit = FitNonlinearRegression(
      BoxBod(), Eigen::Vector2d(1.0, 1.0), {.iterations = 0});
  EXPECT_TRUE(fit.summary.converged() ==
              (fit.summary.message.find(", converged") != std::string::npos));
}

TEST(PolishRegression, FindsDigitsBelowTheRoundingOfTheCost) {
  ExtendedVector rough(2);
  rough << 213.8094, 0.547237;
  const PolishedParameters polished = PolishRegression(BoxBod(), rough);
  EXPECT_TRUE(polished.converged);
  ExtendedVector residuals;
  ExtendedMatrix jacobian;
  BoxBod().Evaluate(polished.parameters, &residuals, &jacobian);
  const ExtendedVector gradient = jacobian.transpose() * residuals;
  for (const DoubleDouble& g : gradient) EXPECT_LT(std::abs(g.hi), 1e-9);
}

TEST(PolishRegression, LeavesADeficientJacobianAlone) {
  ExtendedVector flat(2);
  flat << 0.0, 1.0;  // b1 = 0: b2 has no effect
  const PolishedParameters polished = PolishRegression(BoxBod(), flat);
  EXPECT_FALSE(polished.converged);
  EXPECT_EQ(polished.steps, 0);
}

TEST(AssessRegression, DeviationsOfADeficientJacobianAreNaN) {
  ExtendedVector flat(2);
  flat << 0.0, 1.0;
  const RegressionStatistics statistics = AssessRegression(BoxBod(), flat);
  EXPECT_TRUE(std::isnan(statistics.standard_deviations[0]));
  EXPECT_DOUBLE_EQ(
      statistics.residual_sum_of_squares,
      109.0 * 109 + 2 * 149.0 * 149 + 191.0 * 191 + 213.0 * 213 + 224.0 * 224);
  EXPECT_THROW(AssessRegression(BoxBod(), ExtendedVector::Zero(3)),
               std::invalid_argument);
}

TEST(FormulaRegression, DerivativesAgreeWithRidders) {
  ExtendedMatrix x(5, 1);
  x << 0.3, 0.7, 1.1, 1.9, 2.4;
  const FormulaRegression<Everything> function(
      x, ExtendedVector::Constant(5, 1.0));
  const RegressionObjective objective(function);
  constexpr double kRidders = 1e-8;
  EXPECT_LT(CheckGradient(objective, Eigen::Vector3d(0.8, 1.3, 0.4))
                .worst_relative_error,
            kRidders);
}

TEST(FormulaRegression, BothPrecisionsAgree) {
  const Eigen::Vector2d b(200.0, 0.5);
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  BoxBod().Evaluate(b, &residuals, &jacobian);
  ExtendedVector extended;
  ExtendedMatrix extended_jacobian;
  BoxBod().Evaluate(b.cast<DoubleDouble>(), &extended, &extended_jacobian);
  EXPECT_TRUE(residuals.isApprox(extended.cast<double>(), 1e-14));
  EXPECT_TRUE(jacobian.isApprox(extended_jacobian.cast<double>(), 1e-14));
}

TEST(ProjectedObjective, GradientIsExactThoughTheJacobianIsKaufmans) {
  const FormulaRegression<Growth> function = BoxBod();
  const ProjectedObjective projected(function);
  EXPECT_EQ(projected.num_parameters(), 1);
  constexpr double kRidders = 1e-8;
  for (const double b2 : {0.2, 0.7, 1.5}) {
    const Eigen::VectorXd a = Eigen::VectorXd::Constant(1, b2);
    EXPECT_LT(CheckGradient(projected, a).worst_relative_error, kRidders);
  }
}

TEST(ProjectedObjective, CompletesWithTheBestLinearParameters) {
  const FormulaRegression<Growth> function = BoxBod();
  const ProjectedObjective projected(function);
  const Eigen::VectorXd b =
      projected.Complete(Eigen::VectorXd::Constant(1, 0.54723748542));
  EXPECT_NEAR(b[0], 213.80940889, 1e-7);
  EXPECT_EQ(projected.Reduce(b)[0], b[1]);
}

TEST(ProjectedObjective, DependentColumnsChangeNothing) {
  constexpr double kRounding = 1e-12;
  const auto alone = BoxBod();
  ExtendedMatrix x(6, 1);
  x << 1.0, 2.0, 3.0, 5.0, 7.0, 10.0;
  ExtendedVector y(6);
  y << 109.0, 149.0, 149.0, 191.0, 213.0, 224.0;
  const FormulaRegression<TripleGrowth> tripled(x, y);
  const ProjectedObjective expected(alone);
  const ProjectedObjective found(tripled);
  for (const double rate : {0.1, 0.54, 1.0, 3.0}) {
    const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, rate);
    Eigen::VectorXd expected_gradient;
    Eigen::VectorXd found_gradient;
    const double value = expected.Evaluate(at, &expected_gradient);
    EXPECT_NEAR(found.Evaluate(at, &found_gradient), value, kRounding * value);
    EXPECT_NEAR(found_gradient[0], expected_gradient[0], 1e-9 * value);
    const Eigen::VectorXd complete = found.Complete(at);
    EXPECT_EQ(complete[1], 0.0);
    EXPECT_EQ(complete[2], 0.0);
    EXPECT_NEAR(complete[0], expected.Complete(at)[0], 1e-10);
  }
}

TEST(ProjectedObjective, NeedsParametersOfBothKinds) {
  ExtendedMatrix x = ExtendedMatrix::Constant(5, 1, 1.0);
  const FormulaRegression<Everything> function(
      x, ExtendedVector::Constant(5, 1.0));
  EXPECT_THROW(ProjectedObjective{function}, std::invalid_argument);
}

}  // namespace
}  // namespace errmap::fitting
