#pragma once

#include <memory>

#include "models/error_model.h"
#include "models/net/net_options.h"

namespace errmap::models {

/// The net that comparisons add to the report's, which overfits for unseen
/// groups: "net:scg:view=auto".
inline NetOptions NetInViews() { return {.view = ViewOptions()}; }

/// Further operations of a net's recipe.
class NetRecipe : public ModelRecipe {
 public:
  /// Returns this recipe with the choices of `fitted`, one of its fits, fixed:
  /// hidden nodes, wfactor, and one start, with the seed given by the caller.
  virtual std::unique_ptr<NetRecipe> WithChoicesOf(
      const FittedModel& fitted) const = 0;
  /// Effective parameters of such a fit: see net_effective_parameters.h.
  virtual double EffectiveParametersOf(const FittedModel& fitted,
                                       const data::Dataset& training) const = 0;
};

}  // namespace errmap::models
