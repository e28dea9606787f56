#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include "fitting/least_squares/linear_least_squares.h"

namespace errmap::fitting {

/// What is fitted: y on an intercept and k terms.
struct RegressionProblem {
  const Eigen::MatrixXd& terms;     // (n x k), without the intercept
  const Eigen::VectorXd& response;  // (n)
  const Eigen::VectorXd& weights;   // (n) not negative, or (0)
  /// (n) the intercept's column where rows are those of a triangle; (0): ones;
  /// zeros: there is no intercept.
  Eigen::VectorXd intercept = {};
  double observations = 0.0;  // 0: the rows of a weight above 0
};

/// A line of the coefficient table; NaN where there is nothing to say.
struct CoefficientEstimate {
  double estimate = 0.0;
  double standard_error = std::numeric_limits<double>::quiet_NaN();
  double t = std::numeric_limits<double>::quiet_NaN();
  double p = std::numeric_limits<double>::quiet_NaN();      // two-sided
  double lower = std::numeric_limits<double>::quiet_NaN();  // 95 % interval
  double upper = std::numeric_limits<double>::quiet_NaN();
  double standardised = std::numeric_limits<double>::quiet_NaN();
  double vif = std::numeric_limits<double>::quiet_NaN();
};

/// A fitted regression as R's summary(lm), anova and influence give it.
/// Sums of squares are weighted, and about the (weighted) mean; about 0 where
/// there is no intercept.
struct RegressionDiagnostics {
  double observations = 0.0;
  Eigen::Index rank = 0;  // coefficients, intercept included
  bool has_intercept = true;
  std::vector<Eigen::Index> aliased;  // terms left out, coefficient 0
  CoefficientEstimate intercept;
  std::vector<CoefficientEstimate> coefficients;  // (k)
  double regression_sum_of_squares = 0.0;
  double residual_sum_of_squares = 0.0;
  double total_sum_of_squares = 0.0;
  double residual_degrees_of_freedom = 0.0;
  double f = std::numeric_limits<double>::quiet_NaN();  // of the whole
  double f_p = std::numeric_limits<double>::quiet_NaN();
  double s = std::numeric_limits<double>::quiet_NaN();
  double r2 = std::numeric_limits<double>::quiet_NaN();
  double adjusted_r2 = std::numeric_limits<double>::quiet_NaN();
  /// Of the design with intercept, columns of unit length: largest over
  /// smallest singular value (Belsley, Kuh and Welsch 1980), and the number of
  /// singular values above max(n, k) epsilon times the largest.
  double condition = 0.0;
  Eigen::Index effective_rank = 0;
  /// Triangle R with (X_c R^-1)' (X_c R^-1) = I of the terms kept, centred:
  /// for the leverages of rows seen elsewhere.
  Eigen::MatrixXd triangle;
  Eigen::VectorXd means;           // (k) weighted means of the terms
  std::vector<Eigen::Index> kept;  // terms that `triangle` is of
  int bits = 53;                   // of the arithmetic of the estimates
  double sum_of_weights = 0.0;     // 0 where there is no intercept

  Eigen::Index regression_degrees_of_freedom() const {
    return rank - (has_intercept ? 1 : 0);
  }
  double total_degrees_of_freedom() const {
    return observations - (has_intercept ? 1.0 : 0.0);
  }
};

/// What `solution` (of the intercept's column and the terms) says: its aliased
/// terms are left out, and where it took 106 bits its coefficients, standard
/// deviations and residual sum of squares are taken over. Else these come
/// from a Householder QR of centred columns of unit length. Throws
/// std::invalid_argument on shapes that do not agree.
RegressionDiagnostics Diagnose(const RegressionProblem& problem,
                               const LeastSquaresFit& solution);
/// The same of the solution by SolveLeastSquares.
RegressionDiagnostics Diagnose(const RegressionProblem& problem);

/// Least squares of the intercept's column and the terms, in this order.
LeastSquaresFit SolveRegression(const RegressionProblem& problem,
                                const LeastSquaresOptions& options = {});

/// What needs every row: found in a pass of its own.
struct RowDiagnostics {
  double press = 0.0;  // sum of w (e / (1 - h))^2; infinite at leverage 1
  double largest_residual = 0.0;  // in size; with its sign, not weighted
  Eigen::Index largest_residual_row = -1;
  double largest_leverage = 0.0;
  Eigen::Index leverage_one = 0;  // rows that a coefficient has to itself
  Eigen::Index rows = 0;

  /// Adds rows (b x k terms, b responses, b weights or 0).
  void Add(const RegressionDiagnostics& fit,
           const Eigen::MatrixXd& terms,
           const Eigen::VectorXd& response,
           const Eigen::VectorXd& weights);
  /// 1 - PRESS / total sum of squares, the terms taken as given.
  double PredictedR2(const RegressionDiagnostics& fit) const {
    return 1.0 - press / fit.total_sum_of_squares;
  }
};

/// How the other columns give a column: x = sum of weights x columns, where
/// they do.
struct AliasRelation {
  bool constant = false;  // the column does not vary
  /// Columns (of those given) with a part in it, largest first; parts are of
  /// columns scaled to unit spread.
  std::vector<Eigen::Index> columns;
};

/// Explains why `column` (n) adds nothing to `intercept` (n; 0: ones) and
/// `others` (n x k).
AliasRelation ExplainAlias(const Eigen::VectorXd& column,
                           const Eigen::MatrixXd& others,
                           const Eigen::VectorXd& intercept = {});

}  // namespace errmap::fitting
