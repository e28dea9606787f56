#pragma once

#include "stats/double_double.h"
#include "stats/eigen.h"

namespace errmap::fitting {

using ExtendedVector = Eigen::Matrix<stats::DoubleDouble, Eigen::Dynamic, 1>;
using ExtendedMatrix =
    Eigen::Matrix<stats::DoubleDouble, Eigen::Dynamic, Eigen::Dynamic>;

/// Solution of min |y - X b| with measures of its accuracy.
struct ExtendedLeastSquaresFit {
  ExtendedVector coefficients;         // (p)
  ExtendedVector standard_deviations;  // (p) of the coefficients; NaN if n = p
  stats::DoubleDouble residual_sum_of_squares;
  Index degrees_of_freedom = 0;  // n - p
  /// |R| |R^-1| (Frobenius) of the design with columns of unit length.
  double condition = 0.0;
  /// False if the columns are dependent to working precision. The coefficients
  /// are then meaningless.
  bool full_rank = false;
};

/// Least squares in 106 bits by Householder QR on columns scaled by powers of
/// two. This helps only if the design was formed in extended precision: powers
/// of a decimal x are not doubles.
///
/// `design` (n x p), `response` (n). Throws std::invalid_argument if shapes do
/// not agree, n < p, p < 1 or a value is not finite.
ExtendedLeastSquaresFit SolveExtendedLeastSquares(
    const ExtendedMatrix& design, const ExtendedVector& response);

}  // namespace errmap::fitting
