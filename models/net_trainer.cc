#include "models/net_trainer.h"

#include <stdexcept>

#include "fitting/ceres_optimizer.h"
#include "fitting/conjugate_gradient.h"
#include "fitting/gradient_descent.h"
#include "fitting/levenberg_marquardt.h"
#include "fitting/nlopt_optimizer.h"
#include "fitting/scaled_conjugate_gradient.h"
#include "models/net_objective.h"

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

class CgTrainer final : public NetTrainer {
 public:
  explicit CgTrainer(const fitting::StoppingRules& stopping)
      : optimizer_({.stopping = stopping}) {}

  fitting::Minimum Train(const NetTraining& training,
                         const fitting::RunControl& run) const override {
    return optimizer_.Minimize(
        MakeObjective<double>(training, NetArithmetic::kFast),
        training.initial_weights,
        run);
  }

  std::vector<EffectiveOption> options() const override { return {}; }

 private:
  fitting::ConjugateGradient optimizer_;
};

// Levenberg-Marquardt: few, dear steps.
class LmTrainer final : public NetTrainer {
 public:
  explicit LmTrainer(const fitting::StoppingRules& stopping)
      : optimizer_({.stopping = stopping}) {}

  fitting::Minimum Train(const NetTraining& training,
                         const fitting::RunControl& run) const override {
    return optimizer_.Minimize(
        MakeObjective<double>(training, NetArithmetic::kFast),
        training.initial_weights,
        run);
  }

  std::vector<EffectiveOption> options() const override { return {}; }

 private:
  fitting::LevenbergMarquardt optimizer_;
};

class BackpropTrainer final : public NetTrainer {
 public:
  BackpropTrainer(const fitting::StoppingRules& stopping,
                  SpecOptions* options) {
    constexpr double kLeastRate = 1e-12;
    constexpr double kMostRate = 1e12;
    constexpr double kMostMomentum = 0.999999;
    options_.stopping = stopping;
    options_.learning_rate = options->TakeNumber(
        "learning_rate", options_.learning_rate, kLeastRate, kMostRate);
    options_.momentum =
        options->TakeNumber("momentum", options_.momentum, 0.0, kMostMomentum);
  }

  fitting::Minimum Train(const NetTraining& training,
                         const fitting::RunControl& run) const override {
    return fitting::GradientDescent(options_).Minimize(
        MakeObjective<double>(training, NetArithmetic::kFast),
        training.initial_weights,
        run);
  }

  std::vector<EffectiveOption> options() const override {
    return {{"learning_rate", options_.learning_rate},
            {"momentum", options_.momentum}};
  }

 private:
  fitting::GradientDescentOptions options_;
};

// Pairs of vectors that a quasi-Newton method may be asked to keep.
constexpr std::int64_t kMostMemory = 1000;

class CeresTrainer final : public NetTrainer {
 public:
  CeresTrainer(const fitting::StoppingRules& stopping, SpecOptions* options) {
    options_.stopping = stopping;
    options_.method = static_cast<fitting::CeresMethod>(
        options->TakeChoice("method", 0, fitting::CeresMethodNames()));
    options_.memory = static_cast<int>(
        options->TakeInteger("memory", options_.memory, 1, kMostMemory));
  }

  fitting::Minimum Train(const NetTraining& training,
                         const fitting::RunControl& run) const override {
    return fitting::CeresOptimizer(options_).Minimize(
        MakeObjective<double>(training, NetArithmetic::kFast),
        training.initial_weights,
        run);
  }

  std::vector<EffectiveOption> options() const override {
    return {{"method", std::string(ToString(options_.method))},
            {"memory", std::int64_t{options_.memory}}};
  }

 private:
  fitting::CeresOptions options_;
};

class NloptTrainer final : public NetTrainer {
 public:
  NloptTrainer(const fitting::StoppingRules& stopping, SpecOptions* options) {
    constexpr double kLeastBox = 1e-6;
    constexpr double kMostBox = 1e6;
    options_.stopping = stopping;
    options_.method = static_cast<fitting::NloptMethod>(
        options->TakeChoice("method", 0, fitting::NloptMethodNames()));
    options_.memory = static_cast<int>(
        options->TakeInteger("memory", options_.memory, 1, kMostMemory));
    options_.box =
        options->TakeNumber("box", options_.box, kLeastBox, kMostBox);
  }

  fitting::Minimum Train(const NetTraining& training,
                         const fitting::RunControl& run) const override {
    fitting::NloptOptions options = options_;
    options.seed = training.seed;
    return fitting::NloptOptimizer(options).Minimize(
        MakeObjective<double>(training, NetArithmetic::kFast),
        training.initial_weights,
        run);
  }

  std::vector<EffectiveOption> options() const override {
    std::vector<EffectiveOption> all = {
        {"method", std::string(ToString(options_.method))},
        {"memory", std::int64_t{options_.memory}}};
    if (options_.method == fitting::NloptMethod::kCrs2Lm) {
      all.push_back({"box", options_.box});
    }
    return all;
  }

 private:
  fitting::NloptOptions options_;
};

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
  if (type == "net:lm") return std::make_unique<LmTrainer>(stopping);
  if (type == "net:cg") return std::make_unique<CgTrainer>(stopping);
  if (type == "net:backprop") {
    return std::make_unique<BackpropTrainer>(stopping, options);
  }
  if (type == "net:ceres") {
    return std::make_unique<CeresTrainer>(stopping, options);
  }
  if (type == "net:nlopt") {
    return std::make_unique<NloptTrainer>(stopping, options);
  }
  throw std::invalid_argument("model '" + type + "': not a net");
}

}  // namespace errmap::models
