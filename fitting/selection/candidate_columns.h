#pragma once

#include <Eigen/Core>

namespace errmap::fitting {

/// Columns offered to a selection: a matrix X (n x m) that need not be stored.
/// Immutable, safe to use from several threads.
class CandidateColumns {
 public:
  virtual ~CandidateColumns() = default;
  virtual Eigen::Index rows() const = 0;
  virtual Eigen::Index cols() const = 0;
  /// Returns column `index` (n).
  virtual Eigen::VectorXd Column(Eigen::Index index) const = 0;
  /// Returns X' v (m) for `v` (n).
  virtual Eigen::VectorXd TransposeTimes(const Eigen::VectorXd& v) const = 0;
  /// Returns (X o X)' v (m), X squared element by element: the weighted squared
  /// lengths of the columns.
  virtual Eigen::VectorXd SquaresTransposeTimes(
      const Eigen::VectorXd& v) const = 0;

  /// Returns the columns `indices` side by side (n x k).
  template <typename Indices>
  Eigen::MatrixXd Columns(const Indices& indices) const {
    Eigen::MatrixXd matrix(rows(), static_cast<Eigen::Index>(indices.size()));
    Eigen::Index column = 0;
    for (const Eigen::Index index : indices) {
      matrix.col(column++) = Column(index);
    }
    return matrix;
  }
};

/// A stored design matrix.
class MatrixColumns final : public CandidateColumns {
 public:
  explicit MatrixColumns(Eigen::MatrixXd matrix);

  Eigen::Index rows() const override { return matrix_.rows(); }
  Eigen::Index cols() const override { return matrix_.cols(); }
  Eigen::VectorXd Column(Eigen::Index index) const override {
    return matrix_.col(index);
  }
  Eigen::VectorXd TransposeTimes(const Eigen::VectorXd& v) const override;
  Eigen::VectorXd SquaresTransposeTimes(
      const Eigen::VectorXd& v) const override;

 private:
  Eigen::MatrixXd matrix_;
};

/// All terms of degree 1 and 2 of p inputs: x1 .. xp, x1^2, x1 x2, .. xp^2.
/// Their products are never formed: X' v is one triangle of B' diag(v) B with B
/// = [1, inputs], so a pass reads n p numbers instead of n p^2 / 2.
class QuadraticColumns final : public CandidateColumns {
 public:
  explicit QuadraticColumns(const Eigen::MatrixXd& inputs);

  Eigen::Index rows() const override { return base_.rows(); }
  Eigen::Index cols() const override;
  Eigen::VectorXd Column(Eigen::Index index) const override;
  Eigen::VectorXd TransposeTimes(const Eigen::VectorXd& v) const override;
  Eigen::VectorXd SquaresTransposeTimes(
      const Eigen::VectorXd& v) const override;

 private:
  using RowMajor =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Eigen::VectorXd Triangle(const RowMajor& base,
                           const Eigen::VectorXd& v) const;

  Eigen::Index num_inputs_;
  RowMajor base_;     // (n x width) 1, inputs, zeros as padding
  RowMajor squared_;  // element by element
};

}  // namespace errmap::fitting
