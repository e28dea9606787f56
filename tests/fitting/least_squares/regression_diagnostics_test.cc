#include "fitting/least_squares/regression_diagnostics.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/least_squares/triangular_reduction.h"
#include "tests/fitting/regression_test_data.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::UniformMatrix;
using ::testing::ElementsAre;

const VectorXd kEqual;

TEST(RegressionDiagnostics, NeedsNoDegreeOfFreedom) {
  // n = terms + 1: an exact fit, of which nothing can be said.
  const MatrixXd terms = UniformMatrix(5, 4, 1);
  const VectorXd response = UniformMatrix(5, 1, 2);
  const RegressionDiagnostics fit = Diagnose({terms, response, kEqual});
  EXPECT_EQ(fit.residual_degrees_of_freedom, 0.0);
  EXPECT_LT(fit.residual_sum_of_squares, 1e-25);
  EXPECT_TRUE(std::isnan(fit.s));
  EXPECT_TRUE(std::isnan(fit.coefficients[0].standard_error));
  EXPECT_TRUE(std::isnan(fit.f_p));
  RowDiagnostics rows;
  rows.Add(fit, terms, response, kEqual);
  EXPECT_EQ(rows.leverage_one, 5);
  EXPECT_TRUE(std::isinf(rows.press));
}

TEST(RegressionDiagnostics, CountsARowThatACoefficientHasToItself) {
  MatrixXd terms = UniformMatrix(12, 2, 3);
  terms.col(1).setZero();
  terms(4, 1) = 1.0;  // a dummy for row 4
  const VectorXd response = UniformMatrix(12, 1, 4);
  const RegressionDiagnostics fit = Diagnose({terms, response, kEqual});
  RowDiagnostics rows;
  rows.Add(fit, terms, response, kEqual);
  EXPECT_EQ(rows.leverage_one, 1);
  EXPECT_NEAR(rows.largest_leverage, 1.0, 1e-12);
  EXPECT_TRUE(std::isinf(rows.press));
  EXPECT_TRUE(std::isfinite(fit.s));
}

// As in R's summary(lm).
TEST(RegressionDiagnostics, CountsNoRowOfWeightZero) {
  constexpr double kRelative = 1e-12;
  const MatrixXd terms = UniformMatrix(20, 3, 7);
  const VectorXd response = terms.col(0) + 0.2 * UniformMatrix(20, 1, 8);
  VectorXd weights = 1.5 + UniformMatrix(20, 1, 9).array();
  weights.tail(6).setZero();
  const MatrixXd few_terms = terms.topRows(14);
  const VectorXd few_response = response.head(14);
  const VectorXd few_weights = weights.head(14);
  const RegressionDiagnostics fit = Diagnose({terms, response, weights});
  const RegressionDiagnostics few =
      Diagnose({few_terms, few_response, few_weights});
  EXPECT_EQ(fit.observations, 14.0);
  EXPECT_EQ(fit.residual_degrees_of_freedom, few.residual_degrees_of_freedom);
  EXPECT_NEAR(fit.s, few.s, kRelative * few.s);
  EXPECT_NEAR(fit.f_p, few.f_p, kRelative);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(fit.coefficients[j].standard_error,
                few.coefficients[j].standard_error,
                kRelative * few.coefficients[j].standard_error);
    EXPECT_NEAR(fit.coefficients[j].p, few.coefficients[j].p, kRelative);
  }
}

TEST(RegressionDiagnostics, NamesCopiesAndGoesOnWithoutThem) {
  MatrixXd terms = UniformMatrix(30, 4, 5);
  terms.col(2) = 3.0 - 2.0 * terms.col(0).array();
  terms.col(3).setConstant(22.5);
  const VectorXd response = terms.col(1) + 0.1 * UniformMatrix(30, 1, 6);
  const RegressionDiagnostics fit = Diagnose({terms, response, kEqual});
  EXPECT_EQ(fit.rank, 3);
  ASSERT_EQ(fit.aliased.size(), 2U);
  EXPECT_EQ(fit.aliased[1], 3);
  EXPECT_EQ(fit.effective_rank, 3);
  EXPECT_TRUE(std::isfinite(fit.s));
}

TEST(RegressionDiagnostics, ATriangleStandsForItsRows) {
  constexpr double kRelative = 1e-10;
  const MatrixXd terms = 20.0 + UniformMatrix(200, 6, 7).array();
  const VectorXd response =
      terms.col(1) - terms.col(4) + 0.3 * UniformMatrix(200, 1, 8);
  const VectorXd weights = 1.5 + UniformMatrix(200, 1, 9).array();
  MatrixXd all(200, 8);
  all << VectorXd::Ones(200), terms, response;
  all = weights.cwiseSqrt().asDiagonal() * all;
  const MatrixXd triangle =
      ReduceToTriangle(200, 8, [&](Index first, Eigen::Ref<MatrixXd> block) {
        block = all.middleRows(first, block.rows());
      });
  const MatrixXd reduced = triangle.middleCols(1, 6);
  const VectorXd last = triangle.col(7);
  const RegressionDiagnostics by_triangle =
      Diagnose({reduced, last, kEqual, triangle.col(0), 200.0});
  const RegressionDiagnostics by_rows = Diagnose({terms, response, weights});
  const auto same = [](double found, double expected) {
    EXPECT_NEAR(found, expected, kRelative * std::abs(expected));
  };
  same(by_triangle.s, by_rows.s);
  same(by_triangle.f, by_rows.f);
  same(by_triangle.intercept.standard_error, by_rows.intercept.standard_error);
  for (std::size_t j = 0; j < 6; ++j) {
    same(by_triangle.coefficients[j].estimate,
         by_rows.coefficients[j].estimate);
    same(by_triangle.coefficients[j].p, by_rows.coefficients[j].p);
    same(by_triangle.coefficients[j].vif, by_rows.coefficients[j].vif);
    same(by_triangle.coefficients[j].standardised,
         by_rows.coefficients[j].standardised);
  }
  same(by_triangle.condition, by_rows.condition);
}

TEST(RegressionDiagnostics, ExplainsAnAlias) {
  const MatrixXd others = UniformMatrix(20, 3, 10);
  EXPECT_TRUE(ExplainAlias(VectorXd::Constant(20, 4.0), others).constant);
  EXPECT_THAT(ExplainAlias(5.0 - 2.0 * others.col(1).array(), others).columns,
              ElementsAre(1));
  EXPECT_THAT(ExplainAlias(others.col(0) + 3.0 * others.col(2), others).columns,
              ElementsAre(2, 0));
}

TEST(RegressionDiagnostics, RefusesShapesThatDoNotAgree) {
  const MatrixXd terms = UniformMatrix(4, 2, 1);
  const VectorXd response = UniformMatrix(5, 1, 1);
  EXPECT_THROW(Diagnose({terms, response, kEqual}), std::invalid_argument);
}

}  // namespace
}  // namespace errmap::fitting
