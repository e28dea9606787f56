#include "models/net_recipe.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "models/feedforward_net.h"
#include "models/net_trainer.h"
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

// Budgets and stops under the report's names.
fitting::StoppingRules TakeStoppingRules(const std::string& type,
                                         SpecOptions* options) {
  constexpr std::int64_t kMostSteps = 1'000'000'000;
  constexpr double kMost = 1e12;
  constexpr double kLeastSeconds = 1e-3;
  fitting::StoppingRules rules = DefaultStoppingRules(type);
  rules.iterations =
      options->TakeInteger("iterations", rules.iterations, 1, kMostSteps);
  rules.evaluations =
      options->TakeInteger("evaluations",
                           rules.evaluations,
                           1,
                           std::numeric_limits<std::int64_t>::max());
  rules.seconds =
      options->TakeNumber("seconds", rules.seconds, kLeastSeconds, kMost);
  rules.cost_goal = options->TakeNumber("egoal", rules.cost_goal, 0.0, kMost);
  rules.gradient_goal =
      options->TakeNumber("gwgoal", rules.gradient_goal, 0.0, kMost);
  rules.slow_ratio =
      options->TakeNumber("errdel", rules.slow_ratio, 1e-6, kMost);
  rules.progress_interval =
      options->TakeInteger("nfreq", rules.progress_interval, 1, kMostSteps);
  return rules;
}

// A one-hidden-layer net; how it is trained is its trainer's business.
class NetRecipe final : public ModelRecipe {
 public:
  explicit NetRecipe(const ModelSpec& spec) : name_(spec.text) {
    constexpr double kLeastSlope = 1e-3;
    constexpr double kMostSlope = 1e3;
    SpecOptions options(spec);
    hidden_ = options.TakeInteger("hidden", 20, 1, 10'000);
    wfactor_ = options.TakeNumber("wfactor", 1e-5, 0.0, 1e6);
    stopping_ = TakeStoppingRules(spec.type, &options);
    scaling_ = static_cast<InputScaling>(
        options.TakeChoice("scale", 0, InputScalingNames()));
    output_ = static_cast<OutputFunction>(
        options.TakeChoice("output", 0, {"sigmoid", "linear"}));
    slope_ = options.TakeNumber("slope", 1.0, kLeastSlope, kMostSlope);
    trainer_ = MakeNetTrainer(spec.type, stopping_, &options);
    options.RefuseOthers();
  }

  std::string name() const override { return name_; }
  ModelKind kind() const override { return ModelKind::kNet; }

  std::vector<EffectiveOption> options() const override {
    std::vector<EffectiveOption> all = {
        {"hidden", hidden_},
        {"wfactor", wfactor_},
        {"iterations", stopping_.iterations},
        {"egoal", stopping_.cost_goal},
        {"gwgoal", stopping_.gradient_goal},
        {"scale", InputScalingNames()[static_cast<std::size_t>(scaling_)]},
        {"output", std::string(ToString(output_))},
        {"slope", slope_}};
    const fitting::StoppingRules unlimited;
    if (stopping_.evaluations != unlimited.evaluations) {
      all.push_back({"evaluations", stopping_.evaluations});
    }
    if (stopping_.slow_ratio != unlimited.slow_ratio) {
      all.push_back({"errdel", stopping_.slow_ratio});
      all.push_back({"nfreq", stopping_.progress_interval});
    }
    if (stopping_.seconds != unlimited.seconds) {
      all.push_back({"seconds", stopping_.seconds});
    }
    std::ranges::move(trainer_->options(), std::back_inserter(all));
    return all;
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
    const NetShape shape = ShapeFor(training);
    fitting::Minimum minimum = trainer_->Train(
        {.shape = shape,
         .inputs = scaling.Apply(training.input_values()),
         .targets =
             (training.target_values() * target.slope).array() + target.offset,
         .row_weights = training.weights(),
         .wfactor = wfactor_,
         .initial_weights = InitialWeights(shape, context.seed)},
        {.stop = context.stop, .keep_trace = context.keep_trace});

    std::vector<Index> columns(static_cast<std::size_t>(shape.inputs));
    std::iota(columns.begin(), columns.end(), Index{0});
    // A slope c multiplies every sum that a sigmoid sees: so may the weights.
    NetForm form{.input_offset = scaling.offset,
                 .input_scale = scaling.scale,
                 .w1 = shape.slope * FirstLayer(shape, minimum.x),
                 .w2 = OutputSlope(shape) * SecondLayer(shape, minimum.x),
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
    return {dataset.num_inputs(), hidden_, 1, output_, slope_};
  }

  std::string name_;
  std::int64_t hidden_;
  double wfactor_;
  InputScaling scaling_;
  OutputFunction output_;
  double slope_;
  fitting::StoppingRules stopping_;
  std::unique_ptr<NetTrainer> trainer_;
};

}  // namespace

std::unique_ptr<ModelRecipe> MakeNetRecipe(const ModelSpec& spec) {
  const std::vector<std::string>& types = NetTypes();
  if (std::ranges::find(types, spec.type) == types.end()) return nullptr;
  return std::make_unique<NetRecipe>(spec);
}

}  // namespace errmap::models
