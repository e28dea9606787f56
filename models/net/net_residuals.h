#pragma once

#include <memory>

#include "fitting/minimisers/objective.h"
#include "models/net/net_problem.h"
#include "stats/eigen.h"

namespace errmap::models {

/// A net's objective as a sum of squares: with P patterns, J outputs and N
/// weights, E = 1/2 |r|^2 + 1/2 (wfactor / N) |w|^2, and
///   r_(j P + p) = sqrt(row weight_p / (P J)) (target_jp - z_jp).
///
/// For each pair of outputs, J J' is, with k_jp = dr_jp / do_jp, w2_j the
/// weights into output j and X the patterns with the bias row,
///   (A_j A_l') .* (X'X),  A_j (P x H) = diag(k_j) (y (1 - y))' diag(w2_j),
/// plus, for j = l, B_j B_j' of the second layer, B_j (P x (H+1)) = diag(k_j)
/// [y' 1]. These are products of (P x H) matrices, while J is (P J x N) (slopes
/// c as in NetProblem).
class NetResiduals final : public fitting::ResidualFunction {
 public:
  /// `problem` must outlive this object and all objects that it makes.
  explicit NetResiduals(const NetProblem<double>& problem);

  Index num_residuals() const override {
    return problem_.num_patterns() * problem_.shape.outputs;
  }
  double ridge() const override { return problem_.decay; }
  void Evaluate(const VectorXd& w,
                VectorXd* residuals,
                MatrixXd* jacobian) const override;
  std::unique_ptr<fitting::Linearization> NewLinearization() const override;

 private:
  const NetProblem<double>& problem_;
  // For one block of patterns.
  mutable PackedWeights<double> weights_;
  mutable AlignedMatrix<double> hidden_;
  mutable AlignedMatrix<double> outputs_;
  // X'X (P x P), once needed.
  mutable std::shared_ptr<const MatrixXd> inner_products_;
};

}  // namespace errmap::models
