#pragma once

#include <memory>

#include "models/error_model.h"
#include "models/model_spec.h"

namespace errmap::models {

/// The net that comparisons offer beside the report's, which is trained past
/// what unseen groups bear. A net with a view has defaults of its own: 10
/// hidden nodes, wfactor chosen on inner hold-outs along WfactorPath, 750
/// iterations on that path, three starts averaged.
inline constexpr const char* kTunedNet = "net:scg:view=auto";

/// What a net's recipe can do besides fitting.
class NetRecipe : public ModelRecipe {
 public:
  /// This recipe with every choice of `fitted`, one of its fits, made fixed:
  /// its hidden nodes, its wfactor, and one start, whose seed the caller gives.
  virtual std::unique_ptr<NetRecipe> WithChoicesOf(
      const FittedModel& fitted) const = 0;
  /// Of `fitted`, one of its fits to `training`: net_effective_parameters.h.
  virtual double EffectiveParametersOf(const FittedModel& fitted,
                                       const data::Dataset& training) const = 0;
};

/// The recipe of a net (net_trainer.h), or null where `spec.type` is another
/// model. Throws std::invalid_argument on options that are unknown or out of
/// range.
std::unique_ptr<ModelRecipe> MakeNetRecipe(const ModelSpec& spec);

}  // namespace errmap::models
