#include "cli/netcg/netcg_objective.h"

#include <cmath>
#include <stdexcept>

namespace errmap::netcg {

namespace {

template <typename Scalar>
Scalar Logistic(Scalar sum) {
  constexpr Scalar kSmallest = Scalar(-40);
  return sum >= kSmallest ? Scalar(1) / (Scalar(1) + std::exp(-sum))
                          : Scalar(0);
}

}  // namespace

template <typename Scalar>
NetcgObjective<Scalar>::NetcgObjective(const Matrix& inputs,
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

template <typename Scalar>
void NetcgObjective<Scalar>::Forward(Index p,
                                     const Layer& w1,
                                     const Layer& w2) const {
  auto hidden = vhid_.head(hidden_);
  hidden.setZero();
  for (Index i = 0; i < patterns_.rows(); ++i) {
    hidden += w1.col(i) * patterns_(i, p);
  }
  hidden = hidden.unaryExpr(&Logistic<Scalar>).eval();
  for (Index j = 0; j < targets_.rows(); ++j) {
    Scalar sum = 0;
    for (Index h = 0; h <= hidden_; ++h) sum += w2(j, h) * vhid_[h];
    vout_[j] = Logistic(sum);
  }
}

template <typename Scalar>
void NetcgObjective<Scalar>::Backward(Index p, const Layer& w2) const {
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

template <typename Scalar>
Scalar NetcgObjective<Scalar>::Evaluate(const Vector& w,
                                        Vector* gradient) const {
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

template <typename Scalar>
typename NetcgObjective<Scalar>::Matrix NetcgObjective<Scalar>::Outputs(
    const Vector& w) const {
  Matrix outputs(targets_.cols(), targets_.rows());
  for (Index p = 0; p < patterns_.cols(); ++p) {
    Forward(p, FirstLayer(w), SecondLayer(w));
    outputs.row(p) = vout_.transpose();
  }
  return outputs;
}

template class NetcgObjective<double>;
template class NetcgObjective<float>;

}  // namespace errmap::netcg
