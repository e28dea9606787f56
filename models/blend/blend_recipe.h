#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "models/error_model.h"
#include "models/model_options.h"
#include "models/polynomial/polynomial_options.h"

namespace errmap::models {

/// blend: the weighted average of candidates (family x view x terms, each at
/// its best penalty, and a net where one is asked for), with weights from the
/// inner hold-outs of the training rows alone: error^-p, averaged with the same
/// of the straight lines alone, where p is the number of groups held out, at
/// most 8, as their likelihood would have it were each one error, or of
/// sessions less one (3 to 7). One choice among near-equals is a gamble;
/// averages of maps that see the inputs differently are not.
struct BlendOptions {
  /// With NetInViews in its views, but where an input only grows. Its figures
  /// differ from one processor to another.
  bool net = false;
  /// Views are what averaging lives on: without a `view` it is auto.
  BasisOptions bases = {.view = ViewOptions()};

  std::string_view type() const { return "blend"; }
  /// Throws std::invalid_argument naming option, value and range.
  void Validate() const;
  bool operator==(const BlendOptions&) const = default;
};

/// Throws as Validate. The recipe's name is `name` or, where that is empty,
/// SpecOf(options).
std::unique_ptr<ModelRecipe> MakeRecipe(const BlendOptions& options,
                                        std::string name = "");

}  // namespace errmap::models
