#pragma once

#include "fitting/minimisers/objective.h"
#include "stats/eigen.h"

namespace errmap::netcg {

/// E(w) and its gradient, computed as in subroutines FORWARD and FUNC of NISTIR
/// 5367, Appendix A. Every sum has the program's order and precision, and the
/// logistic function is 0 below -40. So results agree with the program's to the
/// last digit. Weights w (N): w1 (H x (I+1)) column by column, then w2 (J x
/// (H+1)) in the same way; the last column of each is the bias.
template <typename Scalar>
class NetcgObjective final : public fitting::BasicObjective<Scalar> {
 public:
  using Vector = fitting::VectorOf<Scalar>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  /// `inputs` (P x I) and `targets` (P x J) are scaled to 0.01 .. 0.99. Throws
  /// std::invalid_argument if there are no patterns or hidden nodes, or the
  /// numbers of rows differ.
  NetcgObjective(const Matrix& inputs,
                 const Matrix& targets,
                 Index hidden,
                 double wfactor);

  Index num_parameters() const override {
    return hidden_ * patterns_.rows() + targets_.rows() * (hidden_ + 1);
  }
  Scalar Evaluate(const Vector& w, Vector* gradient) const override;

  /// Returns the outputs at w (P x J).
  Matrix Outputs(const Vector& w) const;

 private:
  using Layer = Eigen::Map<const Matrix>;
  Layer FirstLayer(const Vector& w) const {
    return {w.data(), hidden_, patterns_.rows()};
  }
  Layer SecondLayer(const Vector& w) const {
    return {
        w.data() + hidden_ * patterns_.rows(), targets_.rows(), hidden_ + 1};
  }
  // Hidden outputs and outputs of pattern p, in vhid_ and vout_.
  void Forward(Index p, const Layer& w1, const Layer& w2) const;
  // Its deltas, and what they add to the negative gradients.
  void Backward(Index p, const Layer& w2) const;

  Index hidden_;
  Scalar wfactor_;
  Matrix patterns_;  // ((I+1) x P), last row 1
  Matrix targets_;   // (J x P)
  // Scratch of a pattern, named as in the program.
  mutable Vector vhid_;    // (H+1), last 1
  mutable Vector vout_;    // (J)
  mutable Vector delta1_;  // (H)
  mutable Vector delta2_;  // (J)
  mutable Matrix gm1_;
  mutable Matrix gm2_;
};

extern template class NetcgObjective<double>;
extern template class NetcgObjective<float>;

}  // namespace errmap::netcg
