#pragma once

#include <Eigen/Core>

#include "stats/double_double.h"

namespace errmap::fitting {

using ExtendedVector = Eigen::Matrix<stats::DoubleDouble, Eigen::Dynamic, 1>;
using ExtendedMatrix =
    Eigen::Matrix<stats::DoubleDouble, Eigen::Dynamic, Eigen::Dynamic>;

struct ExtendedLeastSquaresOptions {
  /// Correct digits wanted in every coefficient, above 0 and at most 15. The
  /// solution is computed in double if error_estimate <= 10^-digits, else in
  /// 106 bits.
  double digits = 14.0;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Solution of min |y - X b| with measures of its accuracy.
struct ExtendedLeastSquaresFit {
  ExtendedVector coefficients;         // (p)
  ExtendedVector standard_deviations;  // (p) of the coefficients; NaN if n = p
  stats::DoubleDouble residual_sum_of_squares;
  Eigen::Index degrees_of_freedom = 0;  // n - p
  /// |R| |R^-1| (Frobenius) of the design with columns of unit length.
  double condition = 0.0;
  /// max over j of 2^-bits |row j of R^-1| (|y| + |R^-1| |r|) / |b_j|: relative
  /// error that rounding may cause in the worst coefficient. Infinite if one is
  /// 0.
  double error_estimate = 0.0;
  int bits = 0;  // precision of the solution: 53 or 106
  /// False if the columns depend on each other to working precision: the
  /// coefficients are then meaningless.
  bool full_rank = false;
};

/// Least squares by Householder QR on columns scaled by powers of two: first in
/// double, then in 106 bits if the condition leaves too few digits. This helps
/// only if the design was formed in extended precision: powers of a decimal x
/// are not doubles.
///
/// `design` (n x p), `response` (n). Throws std::invalid_argument if shapes do
/// not agree, n < p, p < 1 or a value is not finite.
ExtendedLeastSquaresFit SolveExtendedLeastSquares(
    const ExtendedMatrix& design,
    const ExtendedVector& response,
    const ExtendedLeastSquaresOptions& options = {});

}  // namespace errmap::fitting
