#include "fitting/least_squares/penalized_regression.h"

#include <stdexcept>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "fitting/least_squares/linear_least_squares.h"
#include "tests/fitting/regression_test_data.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::UniformMatrix;

struct Sample {
  MatrixXd terms;
  VectorXd response;
  VectorXd weights;
};

// Collinear columns of different scales; more columns than rows where asked.
Sample MakeSample(Index rows, Index cols, bool weighted, std::uint64_t seed) {
  Sample sample;
  const VectorXd common = UniformMatrix(rows, 1, seed);
  sample.terms = UniformMatrix(rows, cols, seed + 1);
  sample.terms += 2.0 * common * VectorXd::Ones(cols).transpose();
  for (Index j = 0; j < cols; ++j) {
    sample.terms.col(j) *= 1.0 + 3.0 * static_cast<double>(j);
    sample.terms.col(j).array() += 10.0 * static_cast<double>(j);
  }
  sample.response = 4.0 + common.array() + 0.3 * sample.terms.col(1).array() +
                    0.2 * UniformMatrix(rows, 1, seed + 2).array();
  if (weighted) sample.weights = 1.5 + UniformMatrix(rows, 1, 9).array();
  return sample;
}

// Weighted, centred columns of variance 1 and the residual, by definition.
void Standardise(const Sample& sample,
                 const VectorXd& coefficients,
                 MatrixXd* x,
                 VectorXd* residual,
                 VectorXd* w,
                 VectorXd* spread) {
  *w = sample.weights.size() != 0 ? sample.weights
                                  : VectorXd::Ones(sample.response.size());
  *w /= w->sum();
  *x = sample.terms;
  spread->resize(x->cols());
  for (Index j = 0; j < x->cols(); ++j) {
    x->col(j).array() -= w->dot(x->col(j));
    (*spread)[j] = std::sqrt(w->dot(x->col(j).cwiseAbs2()));
    if ((*spread)[j] > 0.0) x->col(j) /= (*spread)[j];
  }
  *residual = sample.response - sample.terms * coefficients;
  residual->array() -= w->dot(*residual);
}

TEST(PenalizedRegression, LassoMeetsItsOptimalityConditionsAlongThePath) {
  constexpr double kSlack = 1e-10;
  for (const auto& [rows, cols, weighted] :
       {std::tuple<Index, Index, bool>{40, 8, false},
        {40, 8, true},
        {20, 50, false}}) {
    const Sample sample = MakeSample(rows, cols, weighted, 20);
    const auto path = MakePath(Penalty::kLasso,
                               {sample.terms, sample.response, sample.weights});
    for (const double share : {0.9, 0.3, 0.05, 0.01}) {
      const double strength = share * path->largest_strength();
      const VectorXd coefficients = path->Coefficients(strength);
      MatrixXd x;
      VectorXd residual;
      VectorXd w;
      VectorXd spread;
      Standardise(sample, coefficients, &x, &residual, &w, &spread);
      const VectorXd gradient = x.transpose() * w.cwiseProduct(residual);
      for (Index j = 0; j < cols; ++j) {
        if (coefficients[j] == 0.0) {
          EXPECT_LE(std::abs(gradient[j]), strength + kSlack);
        } else {
          EXPECT_NEAR(
              gradient[j], std::copysign(strength, coefficients[j]), kSlack);
        }
      }
    }
    EXPECT_TRUE(path->Coefficients(path->largest_strength()).isZero());
  }
}

TEST(PenalizedRegression, RidgeSolvesItsNormalEquations) {
  constexpr double kSlack = 1e-10;
  for (const auto& [rows, cols, weighted] :
       {std::tuple<Index, Index, bool>{40, 8, false},
        {40, 8, true},
        {20, 50, false}}) {
    const Sample sample = MakeSample(rows, cols, weighted, 30);
    const auto path = MakePath(Penalty::kRidge,
                               {sample.terms, sample.response, sample.weights});
    for (const double strength : {10.0, 0.1, 1e-4}) {
      const VectorXd coefficients = path->Coefficients(strength);
      MatrixXd x;
      VectorXd residual;
      VectorXd w;
      VectorXd spread;
      Standardise(sample, coefficients, &x, &residual, &w, &spread);
      const VectorXd gradient = x.transpose() * w.cwiseProduct(residual) -
                                strength * coefficients.cwiseProduct(spread);
      EXPECT_LT(gradient.cwiseAbs().maxCoeff(), kSlack);
    }
  }
}

TEST(PenalizedRegression, NoPenaltyIsLeastSquares) {
  constexpr double kRelative = 1e-8;
  const Sample sample = MakeSample(60, 5, true, 40);
  MatrixXd design(60, 6);
  design << VectorXd::Ones(60), sample.terms;
  const VectorXd expected =
      SolveLeastSquares(design, sample.response, sample.weights).coefficients;
  for (const Penalty penalty : {Penalty::kRidge, Penalty::kLasso}) {
    PenalizedOptions options;
    options.penalty = penalty;
    options.strength = 0.0;
    const PenalizedFit fit = FitPenalized(
        {sample.terms, sample.response, sample.weights}, {}, options);
    // The lasso's path is followed down to 1e-7 of its largest strength.
    const double tolerance = penalty == Penalty::kRidge ? kRelative : 1e-5;
    EXPECT_TRUE(fit.coefficients.isApprox(expected.tail(5), tolerance));
    EXPECT_NEAR(
        fit.intercept, expected[0], 100.0 * tolerance * std::abs(expected[0]));
  }
}

TEST(PenalizedRegression, CopiesAndConstantsDoNoHarm) {
  Sample sample = MakeSample(30, 4, false, 50);
  sample.terms.col(2) = sample.terms.col(1);
  sample.terms.col(3).setConstant(3.0);
  for (const Penalty penalty : {Penalty::kRidge, Penalty::kLasso}) {
    const auto path =
        MakePath(penalty, {sample.terms, sample.response, sample.weights});
    const VectorXd coefficients =
        path->Coefficients(0.01 * path->largest_strength());
    EXPECT_TRUE(coefficients.allFinite());
    EXPECT_EQ(coefficients[3], 0.0);
  }
}

TEST(PenalizedRegression, CrossValidationPrefersAPenaltyWhereNoiseRules) {
  const Sample sample = MakeSample(40, 30, false, 60);
  FoldCodes folds;
  for (Index i = 0; i < 40; ++i) folds.codes.push_back(i % 5);
  for (const Penalty penalty : {Penalty::kRidge, Penalty::kLasso}) {
    PenalizedOptions options;
    options.penalty = penalty;
    const RegressionProblem problem{
        sample.terms, sample.response, sample.weights};
    const PenalizedFit fit = FitPenalized(problem, folds, options);
    ASSERT_EQ(fit.strengths.size(), fit.mean_squared_errors.size());
    EXPECT_GT(fit.strength, fit.strengths.back());
    options.one_standard_error = true;
    EXPECT_GE(FitPenalized(problem, folds, options).strength, fit.strength);
    EXPECT_THROW(FitPenalized(problem, {}, options), std::invalid_argument);
    options.strength = -1.0;
    EXPECT_THROW(FitPenalized(problem, folds, options), std::invalid_argument);
  }
}

}  // namespace
}  // namespace errmap::fitting
