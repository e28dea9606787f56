#pragma once

#include <Eigen/Core>

namespace errmap::fitting {

/// Orthonormal basis Q (n x k) and triangle R (k x k) of columns A = Q R that
/// are added and removed one at a time.
///
/// Gram-Schmidt done twice adds columns and keeps Q orthonormal to machine
/// precision ("twice is enough": Giraud, Langou and Rozloznik 2005). Givens
/// rotations remove them (Golub and Van Loan, 6.5.2).
class OrthogonalBasis {
 public:
  explicit OrthogonalBasis(Eigen::Index rows) : rows_(rows) {}

  Eigen::Index size() const { return size_; }
  auto Q() const { return q_.leftCols(size_); }
  auto R() const { return r_.topLeftCorner(size_, size_); }

  /// Returns the part of `column` (n) orthogonal to Q. `along`, unless null,
  /// gets its coefficients in Q.
  Eigen::VectorXd Remainder(const Eigen::VectorXd& column,
                            Eigen::VectorXd* along = nullptr) const;

  /// Appends a column, given its `remainder` (not zero) and `along`.
  void Append(const Eigen::VectorXd& remainder, const Eigen::VectorXd& along);

  /// Removes column `index` (0-based). Returns the unit vector (n) that leaves
  /// the span.
  Eigen::VectorXd Remove(Eigen::Index index);

  /// Returns R^-1 (k x k), upper triangular.
  Eigen::MatrixXd InverseTriangle() const;

 private:
  Eigen::Index rows_;
  Eigen::Index size_ = 0;
  Eigen::MatrixXd q_;  // capacity grows by doubling
  Eigen::MatrixXd r_;
};

}  // namespace errmap::fitting
