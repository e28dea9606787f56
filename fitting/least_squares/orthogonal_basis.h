#pragma once

#include "stats/eigen.h"

namespace errmap::fitting {

/// Orthonormal basis Q (n x k) and triangle R (k x k) of columns A = Q R that
/// are added and removed one at a time.
///
/// Gram-Schmidt, applied twice, adds columns and keeps Q orthonormal to machine
/// precision ("twice is enough": Giraud, Langou and Rozloznik 2005). Givens
/// rotations remove them (Golub and Van Loan, 6.5.2).
class OrthogonalBasis {
 public:
  explicit OrthogonalBasis(Index rows) : rows_(rows) {}

  Index size() const { return size_; }
  auto Q() const { return q_.leftCols(size_); }
  auto R() const { return r_.topLeftCorner(size_, size_); }

  /// Returns the part of `column` (n) orthogonal to Q. `along`, unless null,
  /// gets its coefficients in Q.
  VectorXd Remainder(const VectorXd& column, VectorXd* along = nullptr) const;

  /// Appends a column, given its `remainder` (not zero) and `along`.
  void Append(const VectorXd& remainder, const VectorXd& along);

  /// Removes column `index` (0-based). Returns the unit vector (n) that leaves
  /// the span.
  VectorXd Remove(Index index);

  /// Returns R^-1 (k x k), upper triangular.
  MatrixXd InverseTriangle() const;

 private:
  Index rows_;
  Index size_ = 0;
  MatrixXd q_;  // capacity grows by doubling
  MatrixXd r_;
};

}  // namespace errmap::fitting
