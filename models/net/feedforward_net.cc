#include "models/net/feedforward_net.h"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "models/row_scratch.h"
#include "stats/indices.h"
#include "stats/random.h"

namespace errmap::models {
namespace {

double Sigmoid(double s) { return 1.0 / (1.0 + std::exp(-s)); }

}  // namespace

FeedforwardNet::FeedforwardNet(NetForm form) : form_(std::move(form)) {
  const auto refuse = [](const std::string& why) {
    throw std::invalid_argument("FeedforwardNet: " + why);
  };
  const Index num_inputs = form_.input_offset.size();
  const Index num_hidden = form_.w1.rows();
  if (num_inputs < 1 || num_hidden < 1 ||
      form_.input_scale.size() != num_inputs ||
      form_.w1.cols() != num_inputs + 1 || form_.w2.cols() != num_hidden + 1) {
    refuse("inputs, scales and weights do not agree in size");
  }
  if (form_.w2.rows() != 1 || form_.target_slope.size() != 1 ||
      form_.target_offset.size() != 1) {
    refuse("an error map has one output, found " +
           std::to_string(form_.w2.rows()));
  }
  if (!form_.input_offset.allFinite() || !form_.input_scale.allFinite() ||
      !form_.w1.allFinite() || !form_.w2.allFinite() ||
      !form_.target_slope.allFinite() || !form_.target_offset.allFinite()) {
    refuse("weights and scales must be finite");
  }
  if (form_.target_slope[0] == 0.0) refuse("target_slope must not be 0");
}

// Sums over inputs in order: the hidden nodes are the inner loop, so that the
// compiler may use vectors without changing a single sum.
double FeedforwardNet::DoPredictRow(const double* inputs) const {
  const Index num_inputs = form_.w1.cols() - 1;
  const Index num_hidden = form_.w1.rows();
  RowScratch scratch(static_cast<std::size_t>(num_hidden));
  double* activation = scratch.data();
  for (Index h = 0; h < num_hidden; ++h) {
    activation[h] = form_.w1(h, num_inputs);
  }
  for (Index i = 0; i < num_inputs; ++i) {
    const double scaled =
        (inputs[i] - form_.input_offset[i]) * form_.input_scale[i];
    for (Index h = 0; h < num_hidden; ++h) {
      activation[h] += form_.w1(h, i) * scaled;
    }
  }
  double output = form_.w2(0, num_hidden);
  for (Index h = 0; h < num_hidden; ++h) {
    output += form_.w2(0, h) * Sigmoid(activation[h]);
  }
  if (form_.output == OutputFunction::kSigmoid) output = Sigmoid(output);
  return (output - form_.target_offset[0]) / form_.target_slope[0];
}

VectorXd InitialWeights(const NetShape& shape, std::uint64_t seed) {
  stats::Random random(seed);
  VectorXd w(shape.num_weights());
  const auto draw = [&](Index offset, Index nodes, Index inputs) {
    for (Index to = 0; to < nodes; ++to) {
      for (Index from = 0; from < inputs; ++from) {
        w[offset + from * nodes + to] = random.Uniform() - 0.5;
      }
    }
  };
  draw(0, shape.hidden, shape.inputs + 1);
  draw(shape.num_weights1(), shape.outputs, shape.hidden + 1);
  return w;
}

MatrixXd FirstLayer(const NetShape& shape, const VectorXd& w) {
  return Eigen::Map<const MatrixXd>(w.data(), shape.hidden, shape.inputs + 1);
}

MatrixXd SecondLayer(const NetShape& shape, const VectorXd& w) {
  return Eigen::Map<const MatrixXd>(
      w.data() + shape.num_weights1(), shape.outputs, shape.hidden + 1);
}

NetForm FormOfWeights(const NetShape& shape,
                      const VectorXd& w,
                      const ColumnScaling& inputs,
                      const TargetScaling& target) {
  // A slope c multiplies every sum that a sigmoid sees: so may the weights.
  return {.output = shape.output,
          .input_offset = inputs.offset,
          .input_scale = inputs.scale,
          .target_slope = VectorXd::Constant(1, target.slope),
          .target_offset = VectorXd::Constant(1, target.offset),
          .w1 = shape.slope * FirstLayer(shape, w),
          .w2 = OutputSlope(shape) * SecondLayer(shape, w)};
}

FittedModel MapOfWeights(const NetShape& shape,
                         const VectorXd& w,
                         const ColumnScaling& inputs,
                         const TargetScaling& target,
                         const data::Dataset& training,
                         const std::string& name) {
  if (w.size() != shape.num_weights() ||
      shape.inputs != training.num_inputs()) {
    throw std::invalid_argument(
        "MapOfWeights: a net of " + std::to_string(shape.inputs) +
        " inputs has " + std::to_string(shape.num_weights()) +
        " weights, found " + std::to_string(w.size()) + " and " +
        std::to_string(training.num_inputs()) + " inputs");
  }
  const std::vector<Index> columns = stats::AllIndices(training.num_inputs());
  FittedModel map = NewMap(name, ModelKind::kNet, training);
  map.inputs = DescribeInputs(training, columns);
  map.model =
      std::make_shared<FeedforwardNet>(FormOfWeights(shape, w, inputs, target));
  map.guards = MakeClampLimits(map.inputs, training.target_values());
  return map;
}

PredictionCost CostOf(const NetForm& form) {
  return {form.w1.size() + form.w2.size(), form.w1.rows() + form.w2.rows()};
}

}  // namespace errmap::models
