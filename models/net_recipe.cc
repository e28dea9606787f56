#include "models/net_recipe.h"

#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "fitting/scaled_conjugate_gradient.h"
#include "models/feedforward_net.h"
#include "models/net_objective.h"
#include "models/scaling.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;

enum class InputScaling { kStandard, kRange, kNone };

const std::vector<std::string>& InputScalingNames() {
  static const std::vector<std::string> names = {"standard", "range", "none"};
  return names;
}

ColumnScaling ScalingOf(InputScaling kind, const Eigen::MatrixXd& inputs) {
  switch (kind) {
    case InputScaling::kStandard:
      return StandardScaling(inputs);
    case InputScaling::kRange:
      return UnitRangeScaling(inputs);
    case InputScaling::kNone:
      break;
  }
  return IdentityScaling(inputs.cols());
}

// A net trained by scaled conjugate gradients.
class ScgNetRecipe final : public ModelRecipe {
 public:
  explicit ScgNetRecipe(const ModelSpec& spec) : name_(spec.text) {
    SpecOptions options(spec);
    hidden_ = options.TakeInteger("hidden", 20, 1, 10'000);
    wfactor_ = options.TakeNumber("wfactor", 1e-5, 0.0, 1e6);
    scg_.stopping.iterations =
        options.TakeInteger("iterations", 1500, 1, 1'000'000'000);
    scaling_ = static_cast<InputScaling>(
        options.TakeChoice("scale", 0, InputScalingNames()));
    options.TakeChoice("variant", 0, {"netcg"});
    options.RefuseOthers();
  }

  std::string name() const override { return name_; }
  ModelKind kind() const override { return ModelKind::kNet; }

  std::vector<EffectiveOption> options() const override {
    return {{"hidden", hidden_},
            {"wfactor", wfactor_},
            {"iterations", scg_.stopping.iterations},
            {"scale", InputScalingNames()[static_cast<std::size_t>(scaling_)]},
            {"variant", std::string("netcg")}};
  }

  std::optional<std::string> WhatIsMissing(
      const Dataset& dataset) const override {
    if (dataset.num_inputs() > 0) return std::nullopt;
    return "inputs: a net needs at least one";
  }

  std::optional<Index> NumCoefficients(const Dataset& dataset) const override {
    return ShapeFor(dataset).num_weights();
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (const auto missing = WhatIsMissing(training)) {
      throw std::invalid_argument("the data lack " + *missing);
    }
    const ColumnScaling scaling = ScalingOf(scaling_, training.input_values());
    const TargetScaling target = SigmoidTargetScaling(training.target_values());
    const Eigen::VectorXd scaled_target =
        (training.target_values() * target.slope).array() + target.offset;
    const NetShape shape = ShapeFor(training);
    const NetObjective objective(shape,
                                 scaling.Apply(training.input_values()),
                                 scaled_target,
                                 wfactor_,
                                 training.weights());
    const fitting::ScaledConjugateGradient optimizer(scg_);
    fitting::Minimum minimum = optimizer.Minimize(
        objective, InitialWeights(shape, context.seed), {.stop = context.stop});

    std::vector<Index> columns(static_cast<std::size_t>(shape.inputs));
    std::iota(columns.begin(), columns.end(), Index{0});
    NetForm form{.input_offset = scaling.offset,
                 .input_scale = scaling.scale,
                 .w1 = FirstLayer(shape, minimum.x),
                 .w2 = SecondLayer(shape, minimum.x),
                 .output = shape.output,
                 .target_slope = Eigen::VectorXd::Constant(1, target.slope),
                 .target_offset = Eigen::VectorXd::Constant(1, target.offset)};
    FittedModel fitted;
    fitted.name = name_;
    fitted.kind = ModelKind::kNet;
    fitted.target = training.target();
    fitted.inputs = DescribeInputs(training, columns);
    fitted.summary = std::move(minimum.summary);
    fitted.model = std::make_shared<FeedforwardNet>(std::move(form));
    return fitted;
  }

 private:
  NetShape ShapeFor(const Dataset& dataset) const {
    return {dataset.num_inputs(), hidden_, 1, OutputFunction::kSigmoid};
  }

  std::string name_;
  std::int64_t hidden_;
  double wfactor_;
  InputScaling scaling_;
  fitting::ScaledConjugateGradientOptions scg_;
};

}  // namespace

std::unique_ptr<ModelRecipe> MakeNetRecipe(const ModelSpec& spec) {
  if (spec.type == "net:scg") return std::make_unique<ScgNetRecipe>(spec);
  return nullptr;
}

}  // namespace errmap::models
