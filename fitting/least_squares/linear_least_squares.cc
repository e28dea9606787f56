#include "fitting/least_squares/linear_least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <Eigen/QR>

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void CheckShapes(const MatrixXd& design,
                 const VectorXd& response,
                 const VectorXd& weights) {
  const auto size = [](Index n) { return std::to_string(n); };
  if (design.rows() < 1 || design.cols() < 1) {
    throw std::invalid_argument("SolveLeastSquares: empty design matrix (" +
                                size(design.rows()) + " x " +
                                size(design.cols()) + ")");
  }
  if (response.size() != design.rows() ||
      (weights.size() != 0 && weights.size() != design.rows())) {
    throw std::invalid_argument("SolveLeastSquares: design has " +
                                size(design.rows()) + " rows, response " +
                                size(response.size()) + ", weights " +
                                size(weights.size()));
  }
  if (!design.allFinite() || !response.allFinite() || !weights.allFinite()) {
    throw std::invalid_argument("SolveLeastSquares: values must be finite");
  }
  if (weights.size() != 0 && weights.minCoeff() < 0.0) {
    throw std::invalid_argument(
        "SolveLeastSquares: weights must not be negative");
  }
}

}  // namespace

LeastSquaresFit SolveLeastSquares(const MatrixXd& design,
                                  const VectorXd& response,
                                  const VectorXd& weights) {
  CheckShapes(design, response, weights);
  MatrixXd scaled = design;
  VectorXd y = response;
  if (weights.size() != 0) {
    const VectorXd roots = weights.cwiseSqrt();
    scaled = roots.asDiagonal() * scaled;
    y = roots.cwiseProduct(y);
  }
  VectorXd lengths(scaled.cols());
  for (Index j = 0; j < scaled.cols(); ++j) {
    const double length = scaled.col(j).stableNorm();
    lengths[j] = length > 0.0 ? length : 1.0;
    scaled.col(j) /= lengths[j];
  }
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  const double size =
      static_cast<double>(std::max(design.rows(), design.cols()));
  qr.setThreshold(size * std::numeric_limits<double>::epsilon());
  qr.compute(scaled);

  LeastSquaresFit fit;
  fit.rank = qr.rank();
  fit.coefficients = VectorXd::Zero(design.cols());
  if (fit.rank > 0) fit.coefficients = qr.solve(y);
  const auto& order = qr.colsPermutation().indices();
  for (Index j = fit.rank; j < design.cols(); ++j) {
    fit.aliased.push_back(order[j]);
    fit.coefficients[order[j]] = 0.0;
  }
  std::sort(fit.aliased.begin(), fit.aliased.end());
  fit.residual_sum_of_squares = (y - scaled * fit.coefficients).squaredNorm();
  fit.coefficients = fit.coefficients.cwiseQuotient(lengths);
  if (fit.rank > 0) {
    fit.condition = std::abs(qr.matrixR()(0, 0)) /
                    std::abs(qr.matrixR()(fit.rank - 1, fit.rank - 1));
  }
  return fit;
}

}  // namespace errmap::fitting
