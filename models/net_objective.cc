#include "models/net_objective.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace errmap::models {
namespace {

using Eigen::Index;

// A block's activations stay in the second-level cache at the report's sizes.
constexpr Index kBlock = 256;

// f(s) = 1 / (1 + e^-s), Eq. 18; e^-s overflowing to infinity gives 0. The C
// library's exp, not Eigen's: the last digit it has more keeps long runs on
// the path of the report's program.
template <typename Derived>
void ApplySigmoid(Eigen::MatrixBase<Derived>& activations) {
  using Scalar = typename Derived::Scalar;
  activations = activations.unaryExpr(
      [](Scalar s) { return Scalar(1) / (Scalar(1) + std::exp(-s)); });
}

}  // namespace

template <typename Scalar>
BasicNetObjective<Scalar>::BasicNetObjective(const NetShape& shape,
                                             const Eigen::MatrixXd& inputs,
                                             const Eigen::MatrixXd& targets,
                                             double wfactor,
                                             const Eigen::VectorXd& weights)
    : shape_(shape), wfactor_(static_cast<Scalar>(wfactor)) {
  const auto refuse = [](const std::string& why) {
    throw std::invalid_argument("NetObjective: " + why);
  };
  const Index num_patterns = inputs.rows();
  if (shape.inputs < 1 || shape.hidden < 1 || shape.outputs < 1) {
    refuse("a net needs at least one node in every layer");
  }
  if (num_patterns < 1 || inputs.cols() != shape.inputs ||
      targets.rows() != num_patterns || targets.cols() != shape.outputs ||
      (weights.size() != 0 && weights.size() != num_patterns)) {
    refuse("inputs, targets, weights and nodes do not agree in size");
  }
  if (!inputs.allFinite() || !targets.allFinite() || !weights.allFinite()) {
    refuse("inputs, targets and weights must be finite");
  }
  if (!(wfactor >= 0.0)) {
    refuse("wfactor must be at least 0, found " + std::to_string(wfactor));
  }
  patterns_.resize(shape.inputs + 1, num_patterns);
  patterns_.topRows(shape.inputs) = inputs.transpose().template cast<Scalar>();
  patterns_.row(shape.inputs).setOnes();
  targets_ = targets.transpose().template cast<Scalar>();
  if (weights.size() != 0) {
    weights_ = (weights / weights.mean()).template cast<Scalar>();
  }
  const Index block = std::min(kBlock, num_patterns);
  hidden_.resize(shape.hidden, block);
  hidden_delta_.resize(shape.hidden, block);
  outputs_.resize(shape.outputs, block);
  output_delta_.resize(shape.outputs, block);
}

template <typename Scalar>
Scalar BasicNetObjective<Scalar>::Evaluate(const Vector& w,
                                           Vector* gradient) const {
  using ConstMap = Eigen::Map<const Matrix>;
  using MutableMap = Eigen::Map<Matrix>;
  const Index num_inputs = shape_.inputs;
  const Index num_hidden = shape_.hidden;
  const Index num_outputs = shape_.outputs;
  const Index split = shape_.num_weights1();
  const ConstMap w1(w.data(), num_hidden, num_inputs + 1);
  const ConstMap w2(w.data() + split, num_outputs, num_hidden + 1);
  if (gradient != nullptr) gradient->setZero(w.size());

  Scalar sum_of_squares = 0;
  const Index num_patterns = patterns_.cols();
  for (Index begin = 0; begin < num_patterns; begin += kBlock) {
    const Index size = std::min(kBlock, num_patterns - begin);
    const auto patterns = patterns_.middleCols(begin, size);
    auto hidden = hidden_.leftCols(size);
    auto outputs = outputs_.leftCols(size);
    auto delta2 = output_delta_.leftCols(size);

    hidden.noalias() = w1 * patterns;
    ApplySigmoid(hidden);
    outputs.noalias() = w2.leftCols(num_hidden) * hidden;
    outputs.colwise() += w2.col(num_hidden);
    if (shape_.output == OutputFunction::kSigmoid) ApplySigmoid(outputs);

    // dE/dz times P J: minus the residual, weighted.
    delta2 = outputs - targets_.middleCols(begin, size);
    if (weights_.size() == 0) {
      sum_of_squares += delta2.squaredNorm();
    } else {
      const auto weights = weights_.segment(begin, size);
      sum_of_squares += delta2.colwise().squaredNorm().dot(weights);
      delta2 = delta2 * weights.asDiagonal();
    }
    if (gradient == nullptr) continue;

    if (shape_.output == OutputFunction::kSigmoid) {
      delta2.array() *= outputs.array() * (Scalar(1) - outputs.array());
    }
    MutableMap g1(gradient->data(), num_hidden, num_inputs + 1);
    MutableMap g2(gradient->data() + split, num_outputs, num_hidden + 1);
    g2.leftCols(num_hidden).noalias() += delta2 * hidden.transpose();
    g2.col(num_hidden) += delta2.rowwise().sum();
    auto delta1 = hidden_delta_.leftCols(size);
    delta1.noalias() = w2.leftCols(num_hidden).transpose() * delta2;
    delta1.array() *= hidden.array() * (Scalar(1) - hidden.array());
    g1.noalias() += delta1 * patterns.transpose();
  }
  const Scalar count = static_cast<Scalar>(num_patterns * num_outputs);
  const Scalar decay = wfactor_ / static_cast<Scalar>(w.size());
  if (gradient != nullptr) *gradient = *gradient / count + decay * w;
  return sum_of_squares / (2 * count) + decay * w.squaredNorm() / 2;
}

template class BasicNetObjective<double>;
template class BasicNetObjective<float>;

}  // namespace errmap::models
