#pragma once

#include <vector>

#include "fitting/least_squares/linear_least_squares.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::fitting {

/// A line of the coefficient table; NaN if undefined.
struct CoefficientEstimate {
  double estimate = 0.0;
  double standard_error = stats::kNaN;
  double t = stats::kNaN;
  double p = stats::kNaN;      // two-sided
  double lower = stats::kNaN;  // 95 % interval
  double upper = stats::kNaN;
  double standardised = stats::kNaN;
  double vif = stats::kNaN;
};

/// A fitted regression with the results of R's summary(lm), anova and
/// influence. Sums of squares are weighted, and about the (weighted) mean;
/// about 0 if there is no intercept.
struct RegressionDiagnostics {
  double observations = 0.0;
  Index rank = 0;  // number of coefficients, with intercept
  bool has_intercept = true;
  std::vector<Index> aliased;  // terms omitted, coefficient 0
  CoefficientEstimate intercept;
  std::vector<CoefficientEstimate> coefficients;  // (k)
  double regression_sum_of_squares = 0.0;
  double residual_sum_of_squares = 0.0;
  double total_sum_of_squares = 0.0;
  double residual_degrees_of_freedom = 0.0;
  double f = stats::kNaN;  // of all terms
  double f_p = stats::kNaN;
  double s = stats::kNaN;
  double r2 = stats::kNaN;
  double adjusted_r2 = stats::kNaN;
  /// For the design with intercept and columns of unit length: largest over
  /// smallest singular value (Belsley, Kuh and Welsch 1980), and the number of
  /// singular values above max(n, k) epsilon times the largest.
  double condition = 0.0;
  Index effective_rank = 0;
  /// Triangle R with (X_c R^-1)' (X_c R^-1) = I for the kept terms, centred;
  /// used for the leverages of other rows.
  MatrixXd triangle;
  VectorXd means;               // (k) weighted means of the terms
  std::vector<Index> kept;      // the terms of `triangle`
  int bits = 53;                // precision of the estimates
  double sum_of_weights = 0.0;  // 0 if there is no intercept

  Index regression_degrees_of_freedom() const {
    return rank - (has_intercept ? 1 : 0);
  }
  double total_degrees_of_freedom() const {
    return observations - (has_intercept ? 1.0 : 0.0);
  }
};

/// Returns the diagnostics of `solution` (for the intercept's column and the
/// terms), without its aliased terms. Coefficients, standard deviations and
/// residual sum of squares come from `solution` if it used 106 bits. Otherwise
/// they come from a Householder QR of centred columns of unit length. Throws
/// std::invalid_argument if shapes do not agree.
RegressionDiagnostics Diagnose(const RegressionProblem& problem,
                               const LeastSquaresFit& solution);
/// Solves with SolveLeastSquares and returns the diagnostics.
RegressionDiagnostics Diagnose(const RegressionProblem& problem);

/// Solves for the intercept's column and the terms, in this order.
LeastSquaresFit SolveRegression(const RegressionProblem& problem,
                                const LeastSquaresOptions& options = {});

/// Diagnostics that need a separate pass over all rows.
struct RowDiagnostics {
  double press = 0.0;  // sum of w (e / (1 - h))^2; infinite at leverage 1
  double largest_residual = 0.0;  // largest in size, with sign, not weighted
  Index largest_residual_row = -1;
  double largest_leverage = 0.0;
  Index leverage_one = 0;  // number of rows of leverage 1
  Index rows = 0;

  /// Adds rows (b x k terms, b responses, b weights or 0).
  void Add(const RegressionDiagnostics& fit,
           const MatrixXd& terms,
           const VectorXd& response,
           const VectorXd& weights);
  /// Returns 1 - PRESS / total sum of squares, for the terms as given.
  double PredictedR2(const RegressionDiagnostics& fit) const {
    return 1.0 - press / fit.total_sum_of_squares;
  }
};

/// A column as a weighted sum of others, if they determine it.
struct AliasRelation {
  bool constant = false;  // the column does not vary
  /// Columns (of those given) that contribute, largest first; contributions are
  /// compared for columns scaled to unit spread.
  std::vector<Index> columns;
};

/// Explains why `column` (n) adds nothing to `intercept` (n; 0: ones) and
/// `others` (n x k).
AliasRelation ExplainAlias(const VectorXd& column,
                           const MatrixXd& others,
                           const VectorXd& intercept = {});

}  // namespace errmap::fitting
