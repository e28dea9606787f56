#pragma once

#include <functional>
#include <vector>

#include "fitting/least_squares/extended_least_squares.h"
#include "stats/eigen.h"

namespace errmap::fitting {

/// Solution of min |sqrt(weights) (y - X b)|.
struct LeastSquaresFit {
  VectorXd coefficients;  // (p) 0 for aliased columns
  Index rank = 0;
  std::vector<Index> aliased;  // columns determined by earlier ones
  /// Columns that earlier ones nearly determine, but that 106 bits distinguish,
  /// so they are kept. The solution is then computed in 106 bits.
  std::vector<Index> nearly_aliased;
  double residual_sum_of_squares = 0.0;  // weighted
  /// Largest over smallest pivot of the scaled columns kept: a lower bound of
  /// their condition number, and usually close to it.
  double condition = 0.0;
  /// (p) of the coefficients, NaN if aliased. (0) unless requested, needed (53
  /// bits give too few digits) and affordable for the size of the design.
  VectorXd standard_deviations;
  int bits = 53;  // precision of the solution: 53 or 106
};

/// A design (n x p) and its response (n) in 106 bits.
struct ExtendedSystem {
  ExtendedMatrix design;
  ExtendedVector response;
};

/// A leverage this close to 1 counts as 1: one coefficient fits this row alone.
inline constexpr double kLeastSlack = 1e-9;

/// Limit of rows times rank: about half a second in 106 bits. A larger design
/// is refined only if a column is nearly determined by others.
inline constexpr double kMostRefinedValues = 2e6;

/// A column is aliased if earlier columns leave at most this share of its
/// length, in double (rule and value of R's lm) ...
inline constexpr double kAliased = 1e-7;
/// ... and those kept leave at most this share in 106 bits.
inline constexpr double kConfirmed = 1e-13;

struct LeastSquaresOptions {
  /// Digits wanted in every coefficient, 0 to 15. If condition and residuals
  /// show that double may give fewer, the solution is refined to all 15, with
  /// residuals in 106 bits. 0: as many digits as double gives.
  double digits = 0.0;
  /// True to compute standard deviations to the same digits, at many times the
  /// cost. Changes nothing else.
  bool with_deviations = false;
  /// Returns design and response before rounding; null: the doubles are exact.
  /// Called only if 106 bits are needed.
  std::function<ExtendedSystem()> exact = {};
  /// Length of the effect of data rounding on a `combination` (p) of the
  /// columns, weights included. A column that leaves at most 64 times that is
  /// aliased, too. Null: data without rounding.
  std::function<double(const VectorXd& combination)> noise = {};

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Returns the number of rows that count as observations: all `rows`, or those
/// with weight above 0, as in R's lm. `weights` (rows) or (0).
double CountObservations(Index rows, const VectorXd& weights);

/// A regression of y on an intercept and k terms, some of which may be selected
/// first. The references must outlive all users of the problem.
struct RegressionProblem {
  const MatrixXd& terms;     // (n x k), without the intercept
  const VectorXd& response;  // (n)
  const VectorXd& weights;   // (n) not negative, or (0): all equal
  /// (n) the intercept's column, if the rows are those of a triangle and not
  /// observations. (0): ones; zeros: no intercept.
  VectorXd intercept = {};
  double observations = 0.0;  // 0: number of rows with weight above 0

  double num_observations() const {
    return observations > 0.0 ? observations
                              : CountObservations(response.size(), weights);
  }
  VectorXd InterceptColumn() const {
    return intercept.size() != 0 ? intercept : VectorXd::Ones(response.size());
  }
  /// Returns the intercept's column and the terms (n x k + 1).
  MatrixXd Design() const;
  /// Returns `column` (n) times the roots of the weights.
  VectorXd Weighted(VectorXd column) const {
    if (weights.size() != 0) column.array() *= weights.array().sqrt();
    return column;
  }
};

/// Least squares by Householder QR on columns scaled to unit length, in the
/// order given, without normal equations. If digits require it, the solution is
/// refined by Bjorck's iteration (BIT 7, 1967) with residuals in 106 bits.
/// Among dependent columns, the later ones are aliased: they get coefficient 0,
/// are listed, and do not affect the solution.
///
/// `design` (n x p), `response` (n), `weights` (n) not negative or (0): equal.
/// Throws std::invalid_argument if shapes do not agree, n < 1, p < 1, or a
/// value is not finite. n < p is allowed; then rank <= n.
LeastSquaresFit SolveLeastSquares(const MatrixXd& design,
                                  const VectorXd& response,
                                  const VectorXd& weights = {},
                                  const LeastSquaresOptions& options = {});

/// Returns an orthonormal basis (n x rank) of the columns of `design` (n x p)
/// that SolveLeastSquares keeps.
MatrixXd OrthonormalColumns(const MatrixXd& design);

}  // namespace errmap::fitting
