#include "fitting/least_squares/extended_least_squares.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <Eigen/Householder>

#include "stats/not_a_number.h"

namespace errmap::fitting {
namespace {

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
VectorXd ColumnScales(const ExtendedMatrix& design) {
  VectorXd scales(design.cols());
  for (Index j = 0; j < design.cols(); ++j) {
    const double length = design.col(j).cast<double>().stableNorm();
    scales[j] = length > 0.0 ? std::ldexp(1.0, -std::ilogb(length)) : 1.0;
  }
  return scales;
}

// Products of `matrix` by powers of two, column by column.
ExtendedMatrix Scaled(const ExtendedMatrix& matrix, const VectorXd& scales) {
  ExtendedMatrix scaled = matrix;
  for (Index j = 0; j < scaled.cols(); ++j) {
    for (Index i = 0; i < scaled.rows(); ++i) scaled(i, j) *= scales[j];
  }
  return scaled;
}

// Turns A = Q R of at least as many rows as columns to R (below it: what is
// left of the reflections), and y to Q' y, reflection by reflection.
void Rotate(ExtendedMatrix* a, ExtendedVector* y) {
  const Index n = a->rows();
  const Index p = a->cols();
  ExtendedVector workspace(p);
  for (Index k = 0; k < p; ++k) {
    DoubleDouble tau;
    DoubleDouble length;
    a->col(k).tail(n - k).makeHouseholderInPlace(tau, length);
    const auto direction = a->col(k).tail(n - k - 1);
    a->bottomRightCorner(n - k, p - k - 1)
        .applyHouseholderOnTheLeft(direction, tau, workspace.data());
    y->tail(n - k).applyHouseholderOnTheLeft(direction, tau, workspace.data());
    (*a)(k, k) = length;
  }
}

ExtendedLeastSquaresFit Solve(const ExtendedMatrix& scaled,
                              const ExtendedVector& response,
                              const VectorXd& scales) {
  const Index n = scaled.rows();
  const Index p = scaled.cols();
  ExtendedMatrix design = scaled;
  ExtendedVector rotated = response;
  Rotate(&design, &rotated);
  const ExtendedMatrix r = design.topRows(p);

  ExtendedLeastSquaresFit fit;
  fit.degrees_of_freedom = n - p;
  fit.condition = std::numeric_limits<double>::infinity();
  fit.coefficients = ExtendedVector::Constant(p, stats::kNaN);
  fit.standard_deviations = ExtendedVector::Constant(p, stats::kNaN);
  fit.residual_sum_of_squares = stats::kNaN;
  for (Index j = 0; j < p; ++j) {
    if (!(abs(r(j, j)) > DoubleDouble(0.0))) return fit;
  }
  const ExtendedMatrix inverse =
      r.triangularView<Eigen::Upper>().solve(ExtendedMatrix::Identity(p, p));
  DoubleDouble inverse_square(0.0);
  for (Index j = 0; j < p; ++j) {
    // For columns of unit length, whatever the powers of two left.
    inverse_square +=
        inverse.row(j).squaredNorm() * r.col(j).head(j + 1).squaredNorm();
  }
  fit.condition =
      sqrt(DoubleDouble(static_cast<double>(p)) * inverse_square).hi;
  fit.full_rank = fit.condition * std::ldexp(1.0, -stats::kDoubleDoubleBits) *
                      static_cast<double>(n) <
                  1.0;

  const ExtendedVector b =
      inverse.triangularView<Eigen::Upper>() * rotated.head(p);
  fit.residual_sum_of_squares = (response - scaled * b).squaredNorm();
  const DoubleDouble variance =
      n > p ? fit.residual_sum_of_squares /
                  DoubleDouble(static_cast<double>(n - p))
            : DoubleDouble(stats::kNaN);
  for (Index j = 0; j < p; ++j) {
    fit.coefficients[j] = b[j] * scales[j];
    fit.standard_deviations[j] =
        sqrt(variance * inverse.row(j).squaredNorm()) * scales[j];
  }
  return fit;
}

}  // namespace

ExtendedLeastSquaresFit SolveExtendedLeastSquares(
    const ExtendedMatrix& design, const ExtendedVector& response) {
  CheckExtended(design, response);
  const VectorXd scales = ColumnScales(design);
  return Solve(Scaled(design, scales), response, scales);
}

}  // namespace errmap::fitting
