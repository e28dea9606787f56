#include "models/net/net_trainer.h"

#include <functional>
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
  ScgTrainer(const ScgTraining& method, const fitting::StoppingRules& stopping)
      : scg_{.stopping = stopping, .variant = method.variant},
        is_single_(method.is_single) {}

  fitting::Minimum Train(const NetTraining& training,
                         const fitting::RunControl& run) const override {
    return is_single_ ? TrainIn<float>(training, run)
                      : TrainIn<double>(training, run);
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

  explicit OptimizerTrainer(Make make) : make_(std::move(make)) {}

  fitting::Minimum Train(const NetTraining& training,
                         const fitting::RunControl& run) const override {
    return make_(training.seed)
        ->Minimize(MakeObjective<double>(training, NetArithmetic::kFast),
                   training.initial_weights,
                   run);
  }

 private:
  Make make_;
};

// The trainer of an `Optimizer` that needs its options only.
template <typename Optimizer, typename Options>
std::unique_ptr<NetTrainer> TrainerOf(const Options& options) {
  return std::make_unique<OptimizerTrainer>([options](std::uint64_t) {
    return std::make_unique<Optimizer>(options);
  });
}

struct TrainerMaker {
  const fitting::StoppingRules& stopping;

  std::unique_ptr<NetTrainer> operator()(const ScgTraining& method) const {
    return std::make_unique<ScgTrainer>(method, stopping);
  }
  std::unique_ptr<NetTrainer> operator()(const LmTraining& /*method*/) const {
    return TrainerOf<fitting::LevenbergMarquardt>(
        fitting::LevenbergMarquardtOptions{.stopping = stopping});
  }
  std::unique_ptr<NetTrainer> operator()(const CgTraining& /*method*/) const {
    return TrainerOf<fitting::ConjugateGradient>(
        fitting::ConjugateGradientOptions{.stopping = stopping});
  }
  std::unique_ptr<NetTrainer> operator()(const BackpropTraining& method) const {
    return TrainerOf<fitting::GradientDescent>(
        fitting::GradientDescentOptions{.stopping = stopping,
                                        .learning_rate = method.learning_rate,
                                        .momentum = method.momentum});
  }
  std::unique_ptr<NetTrainer> operator()(const CeresTraining& method) const {
    return TrainerOf<fitting::CeresOptimizer>(
        fitting::CeresOptions{.stopping = stopping,
                              .method = method.method,
                              .memory = method.memory});
  }
  std::unique_ptr<NetTrainer> operator()(const NloptTraining& method) const {
    return std::make_unique<OptimizerTrainer>(
        [options =
             fitting::NloptOptions{.stopping = stopping,
                                   .method = method.method,
                                   .memory = method.memory,
                                   .box = method.box}](std::uint64_t seed) {
          fitting::NloptOptions seeded = options;
          seeded.seed = seed;
          return std::make_unique<fitting::NloptOptimizer>(seeded);
        });
  }
};

}  // namespace

std::unique_ptr<NetTrainer> MakeNetTrainer(
    const NetMethod& method, const fitting::StoppingRules& stopping) {
  return std::visit(TrainerMaker{stopping}, method);
}

}  // namespace errmap::models
