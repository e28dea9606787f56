#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "fitting/least_squares/extended_least_squares.h"

namespace errmap::fitting {

/// Solution of min |sqrt(weights) (y - X b)|.
struct LeastSquaresFit {
  Eigen::VectorXd coefficients;  // (p) 0 for aliased columns
  Eigen::Index rank = 0;
  std::vector<Eigen::Index> aliased;  // columns that those before determine
  /// Columns that all but follow from those before them and are kept, since
  /// 106 bits tell them apart: the solution is then one in 106 bits.
  std::vector<Eigen::Index> nearly_aliased;
  double residual_sum_of_squares = 0.0;  // weighted
  /// Largest over smallest pivot of the scaled columns kept: a lower bound of
  /// their condition number, and rarely far from it.
  double condition = 0.0;
  /// (p) of the coefficients, NaN where aliased; (0) unless asked for and 53
  /// bits have not the digits wanted (extended_least_squares.h).
  Eigen::VectorXd standard_deviations;
  int bits = 53;  // of the arithmetic that the condition asked for: 53 or 106
};

/// A design (n x p) and its response (n) to 106 bits.
struct ExtendedSystem {
  ExtendedMatrix design;
  ExtendedVector response;
};

/// Rows times rank; a larger design, about half a second in 106 bits, is not
/// asked for further digits, unless a column all but follows from others.
inline constexpr double kMostRefinedValues = 2e6;

struct LeastSquaresOptions {
  /// A column is aliased where those before it leave at most this share of its
  /// length, in double (the rule of R's lm, and its value) ...
  double aliased = 1e-7;
  /// ... and those kept at most this share in 106 bits. At most `aliased`,
  /// above 0.
  double confirmed = 1e-13;
  /// Digits wanted of every coefficient: where rounding may leave fewer in
  /// double, by condition and residuals, the solution is refined with residuals
  /// in 106 bits until it has all 15; 0: as many as double gives. 0 to 15.
  double digits = 0.0;
  /// Their standard deviations are wanted in the same way: for those who read
  /// them, at many times the cost. Changes nothing else.
  bool with_deviations = false;
  /// The numbers that design and response are roundings of; null: the doubles
  /// are meant as they are. Called where 106 bits are needed only.
  std::function<ExtendedSystem()> exact = {};
  /// Length of what rounding of the data may do to a combination (p) of the
  /// columns, weights worked in; a column that leaves no more than 64 times
  /// that follows from the others, too. Null: nothing.
  std::function<double(const Eigen::VectorXd& combination)> noise = {};

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Rows that count as observations: all of `rows`, or those whose weight is
/// above 0, as R's lm has it. `weights` (rows) or (0).
double CountObservations(Eigen::Index rows, const Eigen::VectorXd& weights);

/// Least squares by Householder QR on columns scaled to unit length, in the
/// order given; never the normal equations; where digits ask for it refined by
/// Bjorck's iteration (BIT 7, 1967), whose residuals are in 106 bits. Of
/// columns that depend on each other the later ones are aliased: they get
/// coefficient 0 and are named, and the solution is that of the problem without
/// them.
///
/// `design` (n x p), `response` (n), `weights` (n) not negative or (0): equal.
/// Throws std::invalid_argument on shapes that do not agree, n < 1, p < 1, or
/// values that are not finite. n < p is allowed: rank <= n then.
LeastSquaresFit SolveLeastSquares(const Eigen::MatrixXd& design,
                                  const Eigen::VectorXd& response,
                                  const Eigen::VectorXd& weights = {},
                                  const LeastSquaresOptions& options = {});

/// Orthonormal basis (n x rank) of the columns that SolveLeastSquares keeps of
/// `design` (n x p).
Eigen::MatrixXd OrthonormalColumns(const Eigen::MatrixXd& design);

}  // namespace errmap::fitting
