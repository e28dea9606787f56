#include "models/net/net_trainer.h"

#include <variant>

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

template <typename Scalar>
fitting::Minimum TrainByScg(const fitting::ScaledConjugateGradientOptions& scg,
                            const NetTraining& training,
                            const fitting::RunControl& run) {
  // The 1995 variant retraces the report's program to its last digits.
  const auto objective = MakeObjective<Scalar>(
      training,
      scg.variant == fitting::ScgVariant::kNetcg ? NetArithmetic::kPlain
                                                 : NetArithmetic::kFast);
  return fitting::BasicScaledConjugateGradient<Scalar>(scg).Minimize(
      objective, training.initial_weights.template cast<Scalar>(), run);
}

// Any optimizer, made for each fit since some of them draw from its seed.
template <typename Optimizer, typename Options>
NetTrainer TrainerOf(const Options& options) {
  return
      [options](const NetTraining& training, const fitting::RunControl& run) {
        Options seeded = options;
        if constexpr (requires { seeded.seed; }) seeded.seed = training.seed;
        return Optimizer(seeded).Minimize(
            MakeObjective<double>(training, NetArithmetic::kFast),
            training.initial_weights,
            run);
      };
}

struct TrainerMaker {
  const fitting::StoppingRules& stopping;

  NetTrainer operator()(const ScgTraining& method) const {
    return [scg =
                fitting::ScaledConjugateGradientOptions{
                    .stopping = stopping, .variant = method.variant},
            is_single = method.is_single](const NetTraining& training,
                                          const fitting::RunControl& run) {
      return is_single ? TrainByScg<float>(scg, training, run)
                       : TrainByScg<double>(scg, training, run);
    };
  }
  NetTrainer operator()(const LmTraining& /*method*/) const {
    return TrainerOf<fitting::LevenbergMarquardt>(
        fitting::LevenbergMarquardtOptions{.stopping = stopping});
  }
  NetTrainer operator()(const CgTraining& /*method*/) const {
    return TrainerOf<fitting::ConjugateGradient>(
        fitting::ConjugateGradientOptions{.stopping = stopping});
  }
  NetTrainer operator()(const BackpropTraining& method) const {
    return TrainerOf<fitting::GradientDescent>(
        fitting::GradientDescentOptions{.stopping = stopping,
                                        .learning_rate = method.learning_rate,
                                        .momentum = method.momentum});
  }
  NetTrainer operator()(const CeresTraining& method) const {
    return TrainerOf<fitting::CeresOptimizer>(
        fitting::CeresOptions{.stopping = stopping,
                              .method = method.method,
                              .memory = method.memory});
  }
  NetTrainer operator()(const NloptTraining& method) const {
    return TrainerOf<fitting::NloptOptimizer>(
        fitting::NloptOptions{.stopping = stopping,
                              .method = method.method,
                              .memory = method.memory,
                              .box = method.box});
  }
};

}  // namespace

NetTrainer MakeNetTrainer(const NetMethod& method,
                          const fitting::StoppingRules& stopping) {
  return std::visit(TrainerMaker{stopping}, method);
}

}  // namespace errmap::models
