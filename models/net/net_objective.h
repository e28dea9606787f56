#pragma once

#include <memory>

#include <Eigen/Core>

#include "fitting/minimisers/objective.h"
#include "models/net/net_problem.h"

namespace errmap::models {

/// E(w) = (sum of squared residuals of the scaled target) / (2 P J)
///        + wfactor |w|^2 / (2 N)
/// over P patterns (Eq. 20 as the report's program codes it; w without biases
/// where the shape says so, N with them), with its
/// back-propagated gradient (Eq. 40-67) and exact curvatures along a path.
/// Memory beyond the patterns is that of a block of rows.
template <typename Scalar>
class BasicNetObjective final : public fitting::BasicObjective<Scalar> {
 public:
  using Vector = fitting::VectorOf<Scalar>;

  /// `inputs` (P x I) and `targets` (P x J) are scaled already. `weights` (P)
  /// positive, or (0); they are normalised to mean 1.
  /// Throws std::invalid_argument on shapes that do not agree, P < 1, values
  /// that are not finite, wfactor < 0 or slope <= 0.
  BasicNetObjective(const NetShape& shape,
                    const Eigen::MatrixXd& inputs,
                    const Eigen::MatrixXd& targets,
                    double wfactor,
                    const Eigen::VectorXd& weights = {},
                    NetArithmetic arithmetic = NetArithmetic::kFast);

  Eigen::Index num_parameters() const override {
    return problem_.shape.num_weights();
  }
  Scalar Evaluate(const Vector& w, Vector* gradient) const override;
  std::unique_ptr<fitting::Path<Scalar>> NewPath(
      const Vector& w) const override;
  /// models/net/net_residuals.h; in double precision and with decay on all
  /// weights only, else null.
  const fitting::ResidualFunction* residuals() const override;

 private:
  // Of one block of patterns.
  struct Scratch;
  struct FreeScratch {
    void operator()(Scratch* scratch) const;
  };

  NetProblem<Scalar> problem_;
  std::unique_ptr<Scratch, FreeScratch> scratch_;
  mutable std::unique_ptr<fitting::ResidualFunction> residuals_;
};

using NetObjective = BasicNetObjective<double>;

extern template class BasicNetObjective<double>;
extern template class BasicNetObjective<float>;

}  // namespace errmap::models
