#pragma once

#include <Eigen/Core>

namespace errmap::fitting {

/// Orthonormal basis Q (n x k) and triangle R (k x k) of columns A = Q R that
/// come and go one at a time.
///
/// Columns enter by Gram-Schmidt done twice, which keeps Q orthonormal to
/// machine precision ("twice is enough": Giraud, Langou and Rozloznik 2005),
/// and leave by Givens rotations (Golub and Van Loan, 6.5.2).
class OrthogonalBasis {
 public:
  explicit OrthogonalBasis(Eigen::Index rows) : rows_(rows) {}

  Eigen::Index size() const { return size_; }
  auto Q() const { return q_.leftCols(size_); }
  auto R() const { return r_.topLeftCorner(size_, size_); }

  /// What Q leaves of `column` (n); its coefficients in Q go to `along`
  /// unless null.
  Eigen::VectorXd Remainder(const Eigen::VectorXd& column,
                            Eigen::VectorXd* along = nullptr) const;

  /// Appends a column of which `remainder`, not zero, and `along` are known.
  void Append(const Eigen::VectorXd& remainder, const Eigen::VectorXd& along);

  /// Takes out column `index` (0-based place); returns the unit vector (n)
  /// that leaves the span.
  Eigen::VectorXd Remove(Eigen::Index index);

  /// R^-1 (k x k), upper triangular.
  Eigen::MatrixXd InverseTriangle() const;

 private:
  Eigen::Index rows_;
  Eigen::Index size_ = 0;
  Eigen::MatrixXd q_;  // capacity grows by doubling
  Eigen::MatrixXd r_;
};

}  // namespace errmap::fitting
