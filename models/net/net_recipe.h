#pragma once

#include <memory>

#include "models/error_model.h"
#include "models/net/net_options.h"

namespace errmap::models {

/// The net that comparisons offer beside the report's, which is trained past
/// what unseen groups bear: "net:scg:view=auto".
inline NetOptions NetInViews() { return {.view = ViewOptions()}; }

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

}  // namespace errmap::models
