#include "fitting/selection/candidate_columns.h"

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fitting/multiversion.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rows are padded to this many doubles, so that the loops need no remainder.
constexpr Index kWidth = 8;

// sums[i * width + j] += sum over rows of v b_i b_j for j from the block of i
// on. Four rows at a time, so that the sums are read and written less often.
// The sums run over rows in their order whatever the instruction set.
ERRMAP_MULTIVERSION
void AddWeightedProducts(const double* base,
                         const double* v,
                         std::ptrdiff_t rows,
                         std::ptrdiff_t used,
                         std::ptrdiff_t width,
                         double* sums) {
  std::ptrdiff_t row = 0;
  for (; row + 4 <= rows; row += 4) {
    const double* b0 = base + row * width;
    const double* b1 = b0 + width;
    const double* b2 = b1 + width;
    const double* b3 = b2 + width;
    for (std::ptrdiff_t i = 0; i < used; ++i) {
      const double f0 = v[row] * b0[i];
      const double f1 = v[row + 1] * b1[i];
      const double f2 = v[row + 2] * b2[i];
      const double f3 = v[row + 3] * b3[i];
      double* sum = sums + i * width;
      for (std::ptrdiff_t j = i / kWidth * kWidth; j < width; ++j) {
        sum[j] += (f0 * b0[j] + f1 * b1[j]) + (f2 * b2[j] + f3 * b3[j]);
      }
    }
  }
  for (; row < rows; ++row) {
    const double* b = base + row * width;
    for (std::ptrdiff_t i = 0; i < used; ++i) {
      const double factor = v[row] * b[i];
      double* sum = sums + i * width;
      for (std::ptrdiff_t j = i / kWidth * kWidth; j < width; ++j) {
        sum[j] += factor * b[j];
      }
    }
  }
}

void RequireRows(Index found, Index expected) {
  if (found != expected) {
    throw std::invalid_argument("CandidateColumns: a vector has " +
                                std::to_string(found) + " rows, the columns " +
                                std::to_string(expected));
  }
}

}  // namespace

MatrixColumns::MatrixColumns(MatrixXd matrix) : matrix_(std::move(matrix)) {}

VectorXd MatrixColumns::TransposeTimes(const VectorXd& v) const {
  RequireRows(v.size(), rows());
  return matrix_.transpose() * v;
}

VectorXd MatrixColumns::SquaresTransposeTimes(const VectorXd& v) const {
  RequireRows(v.size(), rows());
  VectorXd products(cols());
  for (Index j = 0; j < cols(); ++j) {
    products[j] = matrix_.col(j).cwiseAbs2().dot(v);
  }
  return products;
}

QuadraticColumns::QuadraticColumns(const MatrixXd& inputs)
    : num_inputs_(inputs.cols()) {
  const Index width = (num_inputs_ + 1 + kWidth - 1) / kWidth * kWidth;
  base_.setZero(inputs.rows(), width);
  base_.col(0).setOnes();
  base_.middleCols(1, num_inputs_) = inputs;
  squared_ = base_.cwiseAbs2();
}

Index QuadraticColumns::cols() const {
  return num_inputs_ + num_inputs_ * (num_inputs_ + 1) / 2;
}

VectorXd QuadraticColumns::Column(Index index) const {
  if (index < num_inputs_) return base_.col(index + 1);
  Index place = index - num_inputs_;
  Index first = 0;
  while (place >= num_inputs_ - first) place -= num_inputs_ - first++;
  return base_.col(first + 1).cwiseProduct(base_.col(first + place + 1));
}

VectorXd QuadraticColumns::TransposeTimes(const VectorXd& v) const {
  return Triangle(base_, v);
}

VectorXd QuadraticColumns::SquaresTransposeTimes(const VectorXd& v) const {
  return Triangle(squared_, v);
}

VectorXd QuadraticColumns::Triangle(const RowMajor& base,
                                    const VectorXd& v) const {
  RequireRows(v.size(), rows());
  const Index used = num_inputs_ + 1;
  const Index width = base.cols();
  std::vector<double> sums(static_cast<std::size_t>(used * width), 0.0);
  AddWeightedProducts(
      base.data(), v.data(), base.rows(), used, width, sums.data());
  VectorXd products(cols());
  Index place = 0;
  // Row 0, the one of the constant, holds the terms of degree 1.
  for (Index i = 0; i < used; ++i) {
    for (Index j = std::max<Index>(i, 1); j < used; ++j) {
      products[place++] = sums[static_cast<std::size_t>(i * width + j)];
    }
  }
  return products;
}

}  // namespace errmap::fitting
