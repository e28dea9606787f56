#include "fitting/least_squares/extended_least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <Eigen/Householder>

#include "stats/not_a_number.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using stats::DoubleDouble;

void CheckExtended(const ExtendedMatrix& design,
                   const ExtendedVector& response) {
  const Index n = design.rows();
  const Index p = design.cols();
  if (p < 1 || n < p || response.size() != n) {
    throw std::invalid_argument(
        "SolveExtendedLeastSquares: design is " + std::to_string(n) + " x " +
        std::to_string(p) + ", response has " +
        std::to_string(response.size()) +
        "; as many rows, at least as many as columns, are needed");
  }
  if (!design.cast<double>().allFinite() ||
      !response.cast<double>().allFinite()) {
    throw std::invalid_argument(
        "SolveExtendedLeastSquares: values must be finite");
  }
}

// The power of two next to the length of each column: scaling by it is exact.
Eigen::VectorXd ColumnScales(const ExtendedMatrix& design) {
  Eigen::VectorXd scales(design.cols());
  for (Index j = 0; j < design.cols(); ++j) {
    const double length = design.col(j).cast<double>().stableNorm();
    scales[j] = length > 0.0 ? std::ldexp(1.0, -std::ilogb(length)) : 1.0;
  }
  return scales;
}

// Products of `matrix` by powers of two, column by column.
ExtendedMatrix Scaled(const ExtendedMatrix& matrix,
                      const Eigen::VectorXd& scales) {
  ExtendedMatrix scaled = matrix;
  for (Index j = 0; j < scaled.cols(); ++j) {
    for (Index i = 0; i < scaled.rows(); ++i) scaled(i, j) *= scales[j];
  }
  return scaled;
}

// Turns A = Q R of at least as many rows as columns to R (below it: what is
// left of the reflections), and y to Q' y, reflection by reflection.
template <typename Matrix, typename Vector>
void Rotate(Matrix* a, Vector* y) {
  using Scalar = typename Matrix::Scalar;
  const Index n = a->rows();
  const Index p = a->cols();
  Vector workspace(p);
  for (Index k = 0; k < p; ++k) {
    Scalar tau;
    Scalar length;
    a->col(k).tail(n - k).makeHouseholderInPlace(tau, length);
    const auto direction = a->col(k).tail(n - k - 1);
    a->bottomRightCorner(n - k, p - k - 1)
        .applyHouseholderOnTheLeft(direction, tau, workspace.data());
    y->tail(n - k).applyHouseholderOnTheLeft(direction, tau, workspace.data());
    (*a)(k, k) = length;
  }
}

template <typename Scalar>
ExtendedLeastSquaresFit Solve(const ExtendedMatrix& scaled,
                              const ExtendedVector& response,
                              const Eigen::VectorXd& scales,
                              int bits) {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using std::abs;
  using std::sqrt;
  const Index n = scaled.rows();
  const Index p = scaled.cols();
  Matrix design = scaled.cast<Scalar>();
  Vector rotated = response.cast<Scalar>();
  Rotate(&design, &rotated);
  const Matrix r = design.topRows(p);

  ExtendedLeastSquaresFit fit;
  fit.bits = bits;
  fit.degrees_of_freedom = n - p;
  fit.condition = fit.error_estimate = std::numeric_limits<double>::infinity();
  fit.coefficients = ExtendedVector::Constant(p, stats::kNaN);
  fit.standard_deviations = ExtendedVector::Constant(p, stats::kNaN);
  fit.residual_sum_of_squares = stats::kNaN;
  for (Index j = 0; j < p; ++j) {
    if (!(abs(r(j, j)) > Scalar(0.0))) return fit;
  }
  const Matrix inverse =
      r.template triangularView<Eigen::Upper>().solve(Matrix::Identity(p, p));
  Scalar r_square(0.0);
  Scalar inverse_square(0.0);
  for (Index j = 0; j < p; ++j) {
    // For columns of unit length, whatever the powers of two left.
    const Scalar column = r.col(j).head(j + 1).squaredNorm();
    r_square += Scalar(1.0);
    inverse_square += inverse.row(j).squaredNorm() * column;
  }
  fit.condition = static_cast<double>(Scalar(sqrt(r_square * inverse_square)));
  fit.full_rank =
      fit.condition * std::ldexp(1.0, -bits) * static_cast<double>(n) < 1.0;

  const Vector b =
      inverse.template triangularView<Eigen::Upper>() * rotated.head(p);
  // The residuals always in 106 bits: they cancel.
  const ExtendedVector extended_b = b.template cast<DoubleDouble>();
  const ExtendedVector residuals = response - scaled * extended_b;
  fit.residual_sum_of_squares = residuals.squaredNorm();
  const DoubleDouble variance =
      n > p ? fit.residual_sum_of_squares /
                  DoubleDouble(static_cast<double>(n - p))
            : DoubleDouble(stats::kNaN);
  const double y_length =
      std::ldexp(response.cast<double>().stableNorm(), -bits);
  // Rounding also turns the columns into the residuals: that part grows with
  // the square of the condition.
  const double turned =
      std::ldexp(std::sqrt(fit.residual_sum_of_squares.hi *
                           static_cast<double>(inverse.squaredNorm())),
                 -bits);
  fit.error_estimate = 0.0;
  for (Index j = 0; j < p; ++j) {
    const double b_j = extended_b[j].hi;
    const DoubleDouble length(
        static_cast<DoubleDouble>(Scalar(inverse.row(j).squaredNorm())));
    fit.error_estimate =
        std::max(fit.error_estimate,
                 (y_length + turned) * sqrt(length).hi / std::abs(b_j));
    fit.coefficients[j] = extended_b[j] * scales[j];
    fit.standard_deviations[j] = sqrt(variance * length) * scales[j];
  }
  return fit;
}

}  // namespace

void ExtendedLeastSquaresOptions::Validate() const {
  constexpr double kMost = 15.0;
  if (!(digits > 0.0 && digits <= kMost)) {
    throw std::invalid_argument(
        "ExtendedLeastSquaresOptions: digits must be above 0 and at most 15, "
        "found " +
        std::to_string(digits));
  }
}

ExtendedLeastSquaresFit SolveExtendedLeastSquares(
    const ExtendedMatrix& design,
    const ExtendedVector& response,
    const ExtendedLeastSquaresOptions& options) {
  options.Validate();
  CheckExtended(design, response);
  const Eigen::VectorXd scales = ColumnScales(design);
  const ExtendedMatrix scaled = Scaled(design, scales);
  const ExtendedLeastSquaresFit fit =
      Solve<double>(scaled, response, scales, stats::kDoubleBits);
  if (fit.error_estimate <= std::pow(10.0, -options.digits)) return fit;
  return Solve<DoubleDouble>(
      scaled, response, scales, stats::kDoubleDoubleBits);
}

}  // namespace errmap::fitting
