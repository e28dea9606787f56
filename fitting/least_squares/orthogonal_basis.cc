#include "fitting/least_squares/orthogonal_basis.h"

#include <algorithm>
#include <cassert>

#include "fitting/least_squares/decompositions.h"

namespace errmap::fitting {

VectorXd OrthogonalBasis::Remainder(const VectorXd& column,
                                    VectorXd* along) const {
  VectorXd rest = column;
  VectorXd sum = VectorXd::Zero(size_);
  constexpr int kTwiceIsEnough = 2;
  for (int pass = 0; pass < kTwiceIsEnough && size_ > 0; ++pass) {
    const VectorXd part = Q().transpose() * rest;
    rest.noalias() -= Q() * part;
    sum += part;
  }
  if (along != nullptr) *along = std::move(sum);
  return rest;
}

void OrthogonalBasis::Append(const VectorXd& remainder, const VectorXd& along) {
  assert(remainder.size() == rows_ && along.size() == size_);
  if (size_ == q_.cols()) {
    constexpr Index kFirstCapacity = 32;
    const Index capacity = std::max(kFirstCapacity, 2 * size_);
    q_.conservativeResize(rows_, capacity);
    r_.conservativeResize(capacity, capacity);
  }
  const double length = remainder.norm();
  q_.col(size_) = remainder / length;
  r_.col(size_).head(size_) = along;
  r_.row(size_).head(size_).setZero();
  r_(size_, size_) = length;
  ++size_;
}

VectorXd OrthogonalBasis::Remove(Index index) {
  assert(index >= 0 && index < size_);
  for (Index j = index; j + 1 < size_; ++j) {
    r_.col(j).head(size_) = r_.col(j + 1).head(size_).eval();
  }
  // R is now upper Hessenberg from `index` on: rotate the diagonal back.
  for (Index j = index; j + 1 < size_; ++j) {
    Eigen::JacobiRotation<double> rotation;
    double length = 0.0;
    rotation.makeGivens(r_(j, j), r_(j + 1, j), &length);
    r_.block(j, j, 2, size_ - 1 - j).applyOnTheLeft(0, 1, rotation.adjoint());
    r_(j, j) = length;
    r_(j + 1, j) = 0.0;
    q_.middleCols(j, 2).applyOnTheRight(0, 1, rotation);
  }
  --size_;
  return q_.col(size_);
}

MatrixXd OrthogonalBasis::InverseTriangle() const {
  return R().triangularView<Eigen::Upper>().solve(
      MatrixXd::Identity(size_, size_));
}

}  // namespace errmap::fitting
