#pragma once

#include <Eigen/Core>

#include "stats/double_double.h"

namespace errmap::fitting {

using ExtendedVector = Eigen::Matrix<stats::DoubleDouble, Eigen::Dynamic, 1>;
using ExtendedMatrix =
    Eigen::Matrix<stats::DoubleDouble, Eigen::Dynamic, Eigen::Dynamic>;

struct ExtendedLeastSquaresOptions {
  /// Correct digits wanted of every coefficient; the solution is worked out in
  /// double where error_estimate <= 10^-digits, else in 106 bits. Above 0, at
  /// most 15.
  double digits = 14.0;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Solution of min |y - X b| with what tells how far to trust it.
struct ExtendedLeastSquaresFit {
  ExtendedVector coefficients;         // (p)
  ExtendedVector standard_deviations;  // (p) of the coefficients; NaN: n = p
  stats::DoubleDouble residual_sum_of_squares;
  Eigen::Index degrees_of_freedom = 0;  // n - p
  /// |R| |R^-1| (Frobenius) of the design with columns of unit length.
  double condition = 0.0;
  /// max over j of 2^-bits |row j of R^-1| (|y| + |R^-1| |r|) / |b_j|: relative
  /// error that rounding may leave in the worst coefficient; infinite where
  /// one is 0.
  double error_estimate = 0.0;
  int bits = 0;  // of the arithmetic that gave the solution: 53 or 106
  /// False where the columns depend on each other to working precision: the
  /// coefficients then mean nothing.
  bool full_rank = false;
};

/// Least squares by Householder QR on columns scaled by powers of two, first in
/// double; where the condition eats the digits wanted, again in 106 bits. The
/// design must have been formed in extended precision to gain by that: powers
/// of a decimal x are not doubles.
///
/// `design` (n x p), `response` (n). Throws std::invalid_argument on shapes
/// that do not agree, n < p, p < 1 or values that are not finite.
ExtendedLeastSquaresFit SolveExtendedLeastSquares(
    const ExtendedMatrix& design,
    const ExtendedVector& response,
    const ExtendedLeastSquaresOptions& options = {});

}  // namespace errmap::fitting
