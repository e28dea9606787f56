#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "models/error_model.h"

namespace errmap::models {

/// The recipe of a SPEC such as "poly:full:degree=3" or "file:model.json".
/// Throws std::invalid_argument naming what is wrong and what there is, and
/// data::InputError where a model file cannot be read.
std::unique_ptr<ModelRecipe> MakeRecipe(std::string_view spec);

/// Types of model that MakeRecipe knows without options, in the order they are
/// presented (poly:formula=... is one more).
const std::vector<std::string>& ModelTypes();

/// What a type of model is, in a line; "" for a type that there is not.
std::string_view AboutModel(std::string_view type);

/// An option of a type of model, for people.
struct ModelOption {
  std::string name;
  std::string about;     // what it is, in a few words
  std::string values;    // "a whole number from 1 to 10000"
  std::string fallback;  // what it is unless given; "" where that depends
};

/// The options that a type takes. Throws std::invalid_argument for a type that
/// there is not.
std::vector<ModelOption> OptionsOfModel(std::string_view type);

/// A SPEC as its options write it: in their order, without those that are the
/// default. Throws as MakeRecipe; not for file:model.json.
std::string RewrittenSpec(std::string_view spec);

struct DefaultRecipes {
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  std::vector<std::string> left_out;  // a line for all that lack one thing
};

/// The models compared when none are named: every type that is compared
/// (ListedModel::is_compared) and that the data allow, ridge and lasso in the
/// views that they choose, and with the blend a net in views beside net:scg.
/// A full polynomial takes part while it has at most a fifth as many
/// coefficients as `fewest_training_rows`, the smallest training side of the
/// study's folds, and its fits take some seconds at most.
DefaultRecipes MakeDefaultRecipes(const data::Dataset& dataset,
                                  Eigen::Index fewest_training_rows);

/// Types of model that any other must beat to be worth its sensors: "zero" (no
/// compensation), "mean", "poly:position" and "poly:temperature" (one of them).
const std::vector<std::string>& BaselineTypes();

/// Whether a SPEC is one of BaselineTypes, whatever its options.
bool IsBaseline(std::string_view spec);

/// The baselines that the data allow and `recipes` do not hold yet.
std::vector<std::unique_ptr<ModelRecipe>> MissingBaselines(
    const data::Dataset& dataset,
    const std::vector<std::unique_ptr<ModelRecipe>>& recipes);

}  // namespace errmap::models
