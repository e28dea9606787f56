#pragma once

#include <Eigen/Core>

#include "fitting/objective.h"
#include "models/error_model.h"

namespace errmap::models {

/// Nodes of a one-hidden-layer net and the layout of its weight vector w:
/// w1 (H x (I+1)) column by column, then w2 (J x (H+1)) likewise; the last
/// column of each is the bias (NISTIR 5367, Eq. 14-17).
struct NetShape {
  Eigen::Index inputs = 0;   // I
  Eigen::Index hidden = 0;   // H
  Eigen::Index outputs = 1;  // J
  OutputFunction output = OutputFunction::kSigmoid;

  Eigen::Index num_weights1() const { return hidden * (inputs + 1); }
  Eigen::Index num_weights() const {
    return num_weights1() + outputs * (hidden + 1);
  }
};

/// E(w) = (sum of squared residuals of the scaled target) / (2 P J)
///        + wfactor |w|^2 / (2 N)
/// over P patterns (Eq. 20 as the report's program codes it), with its
/// back-propagated gradient. Memory beyond the patterns is that of one block
/// of rows.
template <typename Scalar>
class BasicNetObjective final : public fitting::BasicObjective<Scalar> {
 public:
  using Vector = fitting::VectorOf<Scalar>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  /// `inputs` (P x I) and `targets` (P x J) are scaled already. `weights` (P)
  /// positive, or (0); they are normalised to mean 1.
  /// Throws std::invalid_argument on shapes that do not agree, P < 1, values
  /// that are not finite, or wfactor < 0.
  BasicNetObjective(const NetShape& shape,
                    const Eigen::MatrixXd& inputs,
                    const Eigen::MatrixXd& targets,
                    double wfactor,
                    const Eigen::VectorXd& weights = {});

  Eigen::Index num_parameters() const override { return shape_.num_weights(); }
  Scalar Evaluate(const Vector& w, Vector* gradient) const override;

 private:
  NetShape shape_;
  Matrix patterns_;  // ((I+1) x P) scaled inputs, last row 1
  Matrix targets_;   // (J x P)
  Vector weights_;   // (P) or (0)
  Scalar wfactor_;
  // Scratch of one block of patterns.
  mutable Matrix hidden_;        // (H x block) y_h, Eq. 16
  mutable Matrix hidden_delta_;  // (H x block)
  mutable Matrix outputs_;       // (J x block) z_j, Eq. 17
  mutable Matrix output_delta_;  // (J x block)
};

using NetObjective = BasicNetObjective<double>;

extern template class BasicNetObjective<double>;
extern template class BasicNetObjective<float>;

}  // namespace errmap::models
