#include "models/net/net_trainer.h"

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <utility>

#include "fitting/minimisers/ceres_optimizer.h"
#include "fitting/minimisers/conjugate_gradient.h"
#include "fitting/minimisers/gradient_descent.h"
#include "fitting/minimisers/levenberg_marquardt.h"
#include "fitting/minimisers/nlopt_optimizer.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "models/net/net_objective.h"

namespace errmap::models {
namespace {

template <typename Scalar>
BasicNetObjective<Scalar> MakeObjective(const NetTraining& training,
                                        NetArithmetic arithmetic) {
  return {training.shape,
          training.inputs,
          training.targets,
          training.wfactor,
          training.row_weights,
          arithmetic};
}

// Scaled conjugate gradients, in either precision and variant.
class ScgTrainer final : public NetTrainer {
 public:
  ScgTrainer(const fitting::StoppingRules& stopping, SpecOptions* options) {
    scg_.stopping = stopping;
    scg_.variant = static_cast<fitting::ScgVariant>(
        options->TakeChoice("variant", 0, {"moller", "netcg"}));
    is_single_ = options->TakeChoice("precision", 0, {"double", "single"}) == 1;
  }

  fitting::Minimum Train(const NetTraining& training,
                         const fitting::RunControl& run) const override {
    return is_single_ ? TrainIn<float>(training, run)
                      : TrainIn<double>(training, run);
  }

  std::vector<EffectiveOption> options() const override {
    return {{"variant", std::string(ToString(scg_.variant))},
            {"precision", std::string(is_single_ ? "single" : "double")}};
  }

 private:
  template <typename Scalar>
  fitting::Minimum TrainIn(const NetTraining& training,
                           const fitting::RunControl& run) const {
    // The 1995 variant retraces the report's program to its last digits.
    const auto objective = MakeObjective<Scalar>(
        training,
        scg_.variant == fitting::ScgVariant::kNetcg ? NetArithmetic::kPlain
                                                    : NetArithmetic::kFast);
    return fitting::BasicScaledConjugateGradient<Scalar>(scg_).Minimize(
        objective, training.initial_weights.template cast<Scalar>(), run);
  }

  fitting::ScaledConjugateGradientOptions scg_;
  bool is_single_;
};

// Any optimizer, made for each fit since some of them draw from its seed.
class OptimizerTrainer final : public NetTrainer {
 public:
  using Make =
      std::function<std::unique_ptr<fitting::Optimizer>(std::uint64_t seed)>;

  OptimizerTrainer(Make make, std::vector<EffectiveOption> options)
      : make_(std::move(make)), options_(std::move(options)) {}

  fitting::Minimum Train(const NetTraining& training,
                         const fitting::RunControl& run) const override {
    return make_(training.seed)
        ->Minimize(MakeObjective<double>(training, NetArithmetic::kFast),
                   training.initial_weights,
                   run);
  }

  std::vector<EffectiveOption> options() const override { return options_; }

 private:
  Make make_;
  std::vector<EffectiveOption> options_;
};

// The trainer of an `Optimizer` that needs its options only.
template <typename Optimizer, typename Options>
std::unique_ptr<NetTrainer> TrainerOf(
    const Options& options, std::vector<EffectiveOption> effective = {}) {
  return std::make_unique<OptimizerTrainer>(
      [options](std::uint64_t) { return std::make_unique<Optimizer>(options); },
      std::move(effective));
}

std::unique_ptr<NetTrainer> MakeBackpropTrainer(
    const fitting::StoppingRules& stopping, SpecOptions* spec) {
  constexpr double kLeastRate = 1e-12;
  constexpr double kMostRate = 1e12;
  constexpr double kMostMomentum = 0.999999;
  fitting::GradientDescentOptions options{.stopping = stopping};
  options.learning_rate = spec->TakeNumber(
      "learning_rate", options.learning_rate, kLeastRate, kMostRate);
  options.momentum =
      spec->TakeNumber("momentum", options.momentum, 0.0, kMostMomentum);
  return TrainerOf<fitting::GradientDescent>(
      options,
      {{"learning_rate", options.learning_rate},
       {"momentum", options.momentum}});
}

// Pairs of vectors that a quasi-Newton method may be asked to keep.
constexpr std::int64_t kMostMemory = 1000;

std::unique_ptr<NetTrainer> MakeCeresTrainer(
    const fitting::StoppingRules& stopping, SpecOptions* spec) {
  fitting::CeresOptions options{.stopping = stopping};
  options.method = static_cast<fitting::CeresMethod>(
      spec->TakeChoice("method", 0, fitting::CeresMethodNames()));
  options.memory = static_cast<int>(
      spec->TakeInteger("memory", options.memory, 1, kMostMemory));
  return TrainerOf<fitting::CeresOptimizer>(
      options,
      {{"method", std::string(ToString(options.method))},
       {"memory", std::int64_t{options.memory}}});
}

std::unique_ptr<NetTrainer> MakeNloptTrainer(
    const fitting::StoppingRules& stopping, SpecOptions* spec) {
  constexpr double kLeastBox = 1e-6;
  constexpr double kMostBox = 1e6;
  fitting::NloptOptions options{.stopping = stopping};
  options.method = static_cast<fitting::NloptMethod>(
      spec->TakeChoice("method", 0, fitting::NloptMethodNames()));
  options.memory = static_cast<int>(
      spec->TakeInteger("memory", options.memory, 1, kMostMemory));
  options.box = spec->TakeNumber("box", options.box, kLeastBox, kMostBox);
  std::vector<EffectiveOption> effective = {
      {"method", std::string(ToString(options.method))},
      {"memory", std::int64_t{options.memory}}};
  if (options.method == fitting::NloptMethod::kCrs2Lm) {
    effective.push_back({"box", options.box});
  }
  return std::make_unique<OptimizerTrainer>(
      [options](std::uint64_t seed) {
        fitting::NloptOptions seeded = options;
        seeded.seed = seed;
        return std::make_unique<fitting::NloptOptimizer>(seeded);
      },
      std::move(effective));
}

}  // namespace

const std::vector<std::string>& NetTypes() {
  static const std::vector<std::string> types = {
      "net:scg", "net:lm", "net:cg", "net:backprop", "net:ceres", "net:nlopt"};
  return types;
}

fitting::StoppingRules DefaultStoppingRules(const std::string& type) {
  return type == "net:lm" ? fitting::LevenbergMarquardtOptions().stopping
                          : fitting::StoppingRules();
}

std::unique_ptr<NetTrainer> MakeNetTrainer(
    const std::string& type,
    const fitting::StoppingRules& stopping,
    SpecOptions* options) {
  if (type == "net:scg") return std::make_unique<ScgTrainer>(stopping, options);
  if (type == "net:lm") {
    return TrainerOf<fitting::LevenbergMarquardt>(
        fitting::LevenbergMarquardtOptions{.stopping = stopping});
  }
  if (type == "net:cg") {
    return TrainerOf<fitting::ConjugateGradient>(
        fitting::ConjugateGradientOptions{.stopping = stopping});
  }
  if (type == "net:backprop") return MakeBackpropTrainer(stopping, options);
  if (type == "net:ceres") return MakeCeresTrainer(stopping, options);
  if (type == "net:nlopt") return MakeNloptTrainer(stopping, options);
  throw std::invalid_argument("model '" + type + "': not a net");
}

}  // namespace errmap::models
