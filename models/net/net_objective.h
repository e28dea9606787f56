#pragma once

#include <memory>

#include "fitting/minimisers/objective.h"
#include "models/net/net_problem.h"
#include "stats/eigen.h"

namespace errmap::models {

/// E(w) = (sum of squared residuals of the scaled target) / (2 P J)
///        + wfactor |w|^2 / (2 N)
/// over P patterns, with back-propagated gradient (Eq. 40-67) and exact
/// curvatures along a path. This is Eq. 20 as coded in the report's program; if
/// the shape says so, w excludes biases (N does not). Besides the patterns, it
/// needs memory for one block of rows.
template <typename Scalar>
class BasicNetObjective final : public fitting::BasicObjective<Scalar> {
 public:
  using Vector = fitting::VectorOf<Scalar>;

  /// `inputs` (P x I) and `targets` (P x J) must be scaled. `weights` (P) are
  /// positive, or (0), and are normalised to mean 1. Throws
  /// std::invalid_argument if shapes do not agree, P < 1, a value is not
  /// finite, wfactor < 0 or slope <= 0.
  BasicNetObjective(const NetShape& shape,
                    const MatrixXd& inputs,
                    const MatrixXd& targets,
                    double wfactor,
                    const VectorXd& weights = {},
                    NetArithmetic arithmetic = NetArithmetic::kFast);

  Index num_parameters() const override { return problem_.shape.num_weights(); }
  Scalar Evaluate(const Vector& w, Vector* gradient) const override;
  std::unique_ptr<fitting::Path<Scalar>> NewPath(
      const Vector& w) const override;
  /// Returns the residuals (models/net/net_residuals.h), in double precision
  /// and with decay on all weights; else null.
  const fitting::ResidualFunction* residuals() const override;

 private:
  // For one block of patterns:
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
