#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "models/error_model.h"
#include "models/polynomial/polynomial_options.h"

namespace errmap::models {

/// blend: the weighted average of candidates (family x view x terms, each at
/// its best penalty, and a net if requested). Weights are error^-p from inner
/// hold-outs of the training rows only. Unless an input only grows, these
/// weights are averaged with those of a blend of straight lines. The power p is
/// the number of groups held out, at most 8: the likelihood, if each were one
/// error. For sessions it is their number minus one (3 to 7). Averaging several
/// near-equal maps is safer than choosing one.
struct BlendOptions {
  /// Adds NetInViews in its views, unless an input only grows. Results then
  /// depend on the processor.
  bool net = false;
  /// Averages gain from different views, so the default is view=auto.
  BasisOptions bases = {.view = ViewOptions()};

  std::string_view type() const { return "blend"; }
  /// Throws std::invalid_argument naming option, value and range.
  void Validate() const;
  bool operator==(const BlendOptions&) const = default;
};

/// Throws like Validate. The recipe's name is `name`; if that is empty,
/// SpecOf(options).
std::unique_ptr<ModelRecipe> MakeRecipe(const BlendOptions& options,
                                        std::string name = "");

}  // namespace errmap::models
