#pragma once

#include <cmath>
#include <stdexcept>

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
                 double wfactor)
      : hidden_(hidden),
        wfactor_(static_cast<Scalar>(wfactor)),
        patterns_(inputs.cols() + 1, inputs.rows()),
        targets_(targets.transpose()),
        vhid_(hidden + 1),
        vout_(targets.cols()),
        delta1_(hidden),
        delta2_(targets.cols()),
        gm1_(hidden, inputs.cols() + 1),
        gm2_(targets.cols(), hidden + 1) {
    if (inputs.rows() < 1 || targets.rows() != inputs.rows() || hidden < 1 ||
        inputs.cols() < 1 || targets.cols() < 1) {
      throw std::invalid_argument(
          "NetcgObjective: inputs, targets and nodes do not agree in size");
    }
    patterns_.topRows(inputs.cols()) = inputs.transpose();
    patterns_.row(inputs.cols()).setOnes();
    vhid_[hidden] = Scalar(1);
  }

  Index num_parameters() const override {
    return hidden_ * patterns_.rows() + targets_.rows() * (hidden_ + 1);
  }
  Scalar Evaluate(const Vector& w, Vector* gradient) const override {
    const Layer w1 = FirstLayer(w);
    const Layer w2 = SecondLayer(w);
    gm1_.setZero();
    gm2_.setZero();
    Scalar error = 0;
    for (Index p = 0; p < patterns_.cols(); ++p) {
      Forward(p, w1, w2);
      for (Index j = 0; j < targets_.rows(); ++j) {
        const Scalar difference = targets_(j, p) - vout_[j];
        error += difference * difference;
      }
      if (gradient != nullptr) Backward(p, w2);
    }
    const Scalar div = static_cast<Scalar>(targets_.size());
    const Scalar num_weights = static_cast<Scalar>(w.size());
    error /= Scalar(2) * div;
    Scalar squares = 0;
    for (const Scalar weight : w) squares += weight * weight;
    error += wfactor_ * (squares / (Scalar(2) * num_weights));
    if (gradient != nullptr) {
      gradient->resize(w.size());
      *gradient << gm1_.reshaped(), gm2_.reshaped();
      *gradient = (wfactor_ / num_weights) * w - *gradient / div;
    }
    return error;
  }

  /// Returns the outputs at w (P x J).
  Matrix Outputs(const Vector& w) const {
    Matrix outputs(targets_.cols(), targets_.rows());
    for (Index p = 0; p < patterns_.cols(); ++p) {
      Forward(p, FirstLayer(w), SecondLayer(w));
      outputs.row(p) = vout_.transpose();
    }
    return outputs;
  }

 private:
  static Scalar Logistic(Scalar sum) {
    constexpr Scalar kSmallest = Scalar(-40);
    return sum >= kSmallest ? Scalar(1) / (Scalar(1) + std::exp(-sum))
                            : Scalar(0);
  }

  using Layer = Eigen::Map<const Matrix>;
  Layer FirstLayer(const Vector& w) const {
    return {w.data(), hidden_, patterns_.rows()};
  }
  Layer SecondLayer(const Vector& w) const {
    return {
        w.data() + hidden_ * patterns_.rows(), targets_.rows(), hidden_ + 1};
  }
  // Hidden outputs and outputs of pattern p, in vhid_ and vout_.
  void Forward(Index p, const Layer& w1, const Layer& w2) const {
    auto hidden = vhid_.head(hidden_);
    hidden.setZero();
    for (Index i = 0; i < patterns_.rows(); ++i) {
      hidden += w1.col(i) * patterns_(i, p);
    }
    hidden = hidden.unaryExpr(&Logistic).eval();
    for (Index j = 0; j < targets_.rows(); ++j) {
      Scalar sum = 0;
      for (Index h = 0; h <= hidden_; ++h) sum += w2(j, h) * vhid_[h];
      vout_[j] = Logistic(sum);
    }
  }

  // Its deltas, and what they add to the negative gradients.
  void Backward(Index p, const Layer& w2) const {
    for (Index j = 0; j < targets_.rows(); ++j) {
      const Scalar output = vout_[j];
      delta2_[j] = (targets_(j, p) - output) * (output * (Scalar(1) - output));
    }
    for (Index h = 0; h < hidden_; ++h) {
      const Scalar output = vhid_[h];
      Scalar sum = 0;
      for (Index j = 0; j < targets_.rows(); ++j) sum += delta2_[j] * w2(j, h);
      delta1_[h] = sum * (output * (Scalar(1) - output));
    }
    for (Index i = 0; i < patterns_.rows(); ++i) {
      gm1_.col(i) += delta1_ * patterns_(i, p);
    }
    for (Index h = 0; h <= hidden_; ++h) gm2_.col(h) += delta2_ * vhid_[h];
  }

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

}  // namespace errmap::netcg
