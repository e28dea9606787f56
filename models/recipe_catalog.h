#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "models/error_model.h"

namespace errmap::models {

/// Returns the recipe of a SPEC such as "poly:full:degree=3" or
/// "file:model.json". Throws std::invalid_argument naming the fault and the
/// choices, and data::InputError if a model file cannot be read.
std::unique_ptr<ModelRecipe> MakeRecipe(std::string_view spec);

/// Returns the model types that MakeRecipe accepts without options, in their
/// order in help. poly:formula=... needs its formula.
const std::vector<std::string>& ModelTypes();

/// Describes a model type in one line; "" if there is no such type.
std::string_view AboutModel(std::string_view type);

/// An option of a model type, for display.
struct ModelOption {
  std::string name;
  std::string about;     // its meaning, in a few words
  std::string values;    // "a whole number from 1 to 10000"
  std::string fallback;  // its default; "" if that depends
};

/// Returns the options of a model type. Throws std::invalid_argument if there
/// is no such type.
std::vector<ModelOption> OptionsOfModel(std::string_view type);

/// Returns a SPEC in its canonical form: options in fixed order, without
/// defaults. Throws as MakeRecipe; not for file:model.json.
std::string RewrittenSpec(std::string_view spec);

struct DefaultRecipes {
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  std::vector<std::string> left_out;  // one line for all that lack one thing
};

/// Returns the models compared by default: every compared type
/// (ListedModel::is_compared) that the data allow. Ridge and lasso choose their
/// views; with the blend, a net in views is added to net:scg. A full polynomial
/// has at most a fifth as many coefficients as `fewest_training_rows`, the
/// smallest training set of the study's folds. It must also fit within a few
/// seconds.
DefaultRecipes MakeDefaultRecipes(const data::Dataset& dataset,
                                  Index fewest_training_rows);

/// Returns the model types that other maps must beat to be worth their sensors:
/// "zero" (no compensation), "mean", "poly:position" and "poly:temperature".
const std::vector<std::string>& BaselineTypes();

/// True if a SPEC is of one of BaselineTypes, whatever its options.
bool IsBaseline(std::string_view spec);

/// Returns the baselines that the data allow and that `recipes` lacks.
std::vector<std::unique_ptr<ModelRecipe>> MissingBaselines(
    const data::Dataset& dataset,
    const std::vector<std::unique_ptr<ModelRecipe>>& recipes);

}  // namespace errmap::models
