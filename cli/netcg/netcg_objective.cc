#include "cli/netcg/netcg_objective.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace errmap::netcg {

using Eigen::Index;

namespace {

template <typename Scalar>
Scalar Logistic(Scalar sum) {
  constexpr Scalar kSmallest = Scalar(-40);
  return sum >= kSmallest ? Scalar(1) / (Scalar(1) + std::exp(-sum))
                          : Scalar(0);
}

// The inputs of N hidden nodes from h on: N sums side by side, each over the
// pattern x in order.
template <int N, typename Layer, typename Pattern, typename Out>
void Activate(const Layer& w1, const Pattern& x, Index h, Out* out) {
  using Scalar = typename Layer::Scalar;
  Eigen::Array<Scalar, N, 1> sum = Eigen::Array<Scalar, N, 1>::Zero();
  for (Index i = 0; i < x.size(); ++i) {
    sum += w1.col(i).template segment<N>(h).array() * x[i];
  }
  out->template segment<N>(h) = sum.matrix();
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
      vhid_(hidden + 1, kBlock),
      vout_(targets.cols(), kBlock),
      delta1_(hidden, kBlock),
      delta2_(targets.cols(), kBlock),
      gm1_(hidden, inputs.cols() + 1),
      gm2_(targets.cols(), hidden + 1) {
  if (inputs.rows() < 1 || targets.rows() != inputs.rows() || hidden < 1 ||
      inputs.cols() < 1 || targets.cols() < 1) {
    throw std::invalid_argument(
        "NetcgObjective: inputs, targets and nodes do not agree in size");
  }
  patterns_.topRows(inputs.cols()) = inputs.transpose();
  patterns_.row(inputs.cols()).setOnes();
  vhid_.row(hidden).setOnes();
}

template <typename Scalar>
void NetcgObjective<Scalar>::Forward(Index p,
                                     Index k,
                                     const Layer& w1,
                                     const Layer& w2) const {
  constexpr int kMany = 16;
  constexpr int kFew = 4;
  const auto x = patterns_.col(p);
  auto vhid = vhid_.col(k);
  Index h = 0;
  for (; h + kMany <= hidden_; h += kMany) Activate<kMany>(w1, x, h, &vhid);
  for (; h + kFew <= hidden_; h += kFew) Activate<kFew>(w1, x, h, &vhid);
  for (; h < hidden_; ++h) Activate<1>(w1, x, h, &vhid);
  for (h = 0; h < hidden_; ++h) vhid[h] = Logistic(vhid[h]);
  for (Index j = 0; j < targets_.rows(); ++j) {
    Scalar sum = 0;
    for (h = 0; h <= hidden_; ++h) sum += w2(j, h) * vhid[h];
    vout_(j, k) = Logistic(sum);
  }
}

template <typename Scalar>
void NetcgObjective<Scalar>::Backward(Index p, Index k, const Layer& w2) const {
  for (Index j = 0; j < targets_.rows(); ++j) {
    const Scalar output = vout_(j, k);
    delta2_(j, k) = (targets_(j, p) - output) * (output * (Scalar(1) - output));
  }
  for (Index h = 0; h < hidden_; ++h) {
    const Scalar output = vhid_(h, k);
    Scalar sum = 0;
    for (Index j = 0; j < targets_.rows(); ++j) {
      sum += delta2_(j, k) * w2(j, h);
    }
    delta1_(h, k) = sum * (output * (Scalar(1) - output));
  }
}

template <typename Scalar>
void NetcgObjective<Scalar>::AddBlock(Index begin, Index count) const {
  for (Index i = 0; i < patterns_.rows(); ++i) {
    auto gm1 = gm1_.col(i);
    if (count == kBlock) {
      const auto x = patterns_.row(i).template segment<kBlock>(begin);
      gm1 = gm1 + delta1_.col(0) * x[0] + delta1_.col(1) * x[1] +
            delta1_.col(2) * x[2] + delta1_.col(3) * x[3];
    } else {
      for (Index k = 0; k < count; ++k) {
        gm1 += delta1_.col(k) * patterns_(i, begin + k);
      }
    }
  }
  for (Index k = 0; k < count; ++k) {
    for (Index h = 0; h <= hidden_; ++h) {
      gm2_.col(h) += delta2_.col(k) * vhid_(h, k);
    }
  }
}

template <typename Scalar>
Scalar NetcgObjective<Scalar>::Evaluate(const Vector& w,
                                        Vector* gradient) const {
  const Layer w1 = FirstLayer(w);
  const Layer w2 = SecondLayer(w);
  gm1_.setZero();
  gm2_.setZero();
  Scalar error = 0;
  for (Index begin = 0; begin < patterns_.cols(); begin += kBlock) {
    const Index count = std::min(kBlock, patterns_.cols() - begin);
    for (Index k = 0; k < count; ++k) {
      const Index p = begin + k;
      Forward(p, k, w1, w2);
      for (Index j = 0; j < targets_.rows(); ++j) {
        const Scalar difference = targets_(j, p) - vout_(j, k);
        error += difference * difference;
      }
      if (gradient != nullptr) Backward(p, k, w2);
    }
    if (gradient != nullptr) AddBlock(begin, count);
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
    Forward(p, 0, FirstLayer(w), SecondLayer(w));
    outputs.row(p) = vout_.col(0).transpose();
  }
  return outputs;
}

template class NetcgObjective<double>;
template class NetcgObjective<float>;

}  // namespace errmap::netcg
