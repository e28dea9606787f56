#include "models/recipe_catalog.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "data/text.h"
#include "models/blend/blend_recipe.h"
#include "models/file_recipe.h"
#include "models/model_spec.h"
#include "models/net/net_recipe.h"
#include "models/polynomial/polynomial_recipe.h"

namespace errmap::models {

namespace {

struct ModelType {
  std::string_view name;
  std::string_view about;
};

constexpr std::array kModelTypes = {
    ModelType{"zero", "no compensation: what the machine does by itself"},
    ModelType{"mean", "one offset for all"},
    ModelType{"poly:position", "a parabola over the position, no sensor"},
    ModelType{"poly:temperature", "a straight line over one temperature"},
    ModelType{"poly:eq7", "Eq. 7 of 1995: quadratic in position and in T"},
    ModelType{"poly:eq8", "Eq. 8 of 1995: quadratic in position, T, product"},
    ModelType{"poly:eq9", "Eq. 9 of 1995: quadratic in position, linear in T"},
    ModelType{"poly:full", "every product of the inputs up to a degree"},
    ModelType{"poly:stepwise", "terms that come and go by a criterion"},
    ModelType{"poly:best", "the best subset of the terms"},
    ModelType{"poly:ridge", "all terms, large coefficients penalised"},
    ModelType{"poly:lasso", "few terms, by a penalty that drops them"},
    ModelType{"net:scg", "a neural net, scaled conjugate gradients (1995)"},
    ModelType{"net:lm", "a neural net, Levenberg-Marquardt"},
    ModelType{"net:cg", "a neural net, conjugate gradients"},
    ModelType{"net:backprop", "a neural net, gradient descent"},
    ModelType{"net:ceres", "a neural net, a solver of Ceres"},
    ModelType{"net:nlopt", "a neural net, a solver of NLopt"},
    ModelType{"blend", "an average of maps that see the inputs differently"}};

}  // namespace

const std::vector<std::string>& ModelTypes() {
  static const std::vector<std::string> types = [] {
    std::vector<std::string> names;
    for (const ModelType& type : kModelTypes) names.emplace_back(type.name);
    return names;
  }();
  return types;
}

std::string_view AboutModel(std::string_view type) {
  const auto* const found =
      std::ranges::find(kModelTypes, type, &ModelType::name);
  return found == kModelTypes.end() ? "" : found->about;
}

std::unique_ptr<ModelRecipe> MakeRecipe(std::string_view spec_text) {
  if (auto recipe = MakeFileRecipe(spec_text)) return recipe;
  const ModelSpec spec = ParseModelSpec(spec_text);
  if (auto recipe = MakePolynomialRecipe(spec)) return recipe;
  if (auto recipe = MakeNetRecipe(spec)) return recipe;
  if (auto recipe = MakeBlendRecipe(spec)) return recipe;
  const std::string nearest = data::NearestName(spec.type, ModelTypes());
  throw std::invalid_argument(fmt::format(
      "model '{}': unknown; {}there are {}, poly:formula=..., file:model.json",
      spec_text,
      nearest.empty() ? "" : "did you mean '" + nearest + "'? ",
      fmt::join(ModelTypes(), ", ")));
}

std::vector<std::string> OptionNames(std::string_view type) {
  // Each recipe knows its own options alone: asked for one that none has, it
  // names those.
  try {
    MakeRecipe(fmt::format("{}:?=1", type));
  } catch (const UnknownOption& error) {
    return error.known();
  }
  return {};
}

DefaultRecipes MakeDefaultRecipes(const data::Dataset& dataset,
                                  Eigen::Index fewest_training_rows) {
  constexpr int kHighestFullDegree = 6;
  constexpr Eigen::Index kRowsPerCoefficient = 5;
  constexpr double kMostProducts = 5e10;  // some seconds
  constexpr std::array<std::string_view, 6> kWhenNamed = {"poly:best",
                                                          "net:lm",
                                                          "net:cg",
                                                          "net:backprop",
                                                          "net:ceres",
                                                          "net:nlopt"};
  DefaultRecipes defaults;
  for (const std::string& type : ModelTypes()) {
    if (std::ranges::find(kWhenNamed, type) != kWhenNamed.end()) continue;
    // The report's net, and one that is tuned for what it will not have seen.
    if (type == "blend" && dataset.num_inputs() > 0) {
      defaults.recipes.push_back(MakeRecipe(kTunedNet));
    }
    if (type == "poly:full") {
      // Without a position the equations of the report are not there to stand
      // for a linear map.
      const int lowest = FindPosition(dataset, "") < 0 ? 1 : 2;
      for (int degree = lowest; degree <= kHighestFullDegree; ++degree) {
        auto recipe = MakeRecipe(fmt::format("poly:full:degree={}", degree));
        const Eigen::Index coefficients = *recipe->NumCoefficients(dataset);
        const auto wide = static_cast<double>(coefficients);
        const auto tall = static_cast<double>(fewest_training_rows);
        if (dataset.num_inputs() > 0 &&
            coefficients <= fewest_training_rows / kRowsPerCoefficient &&
            tall * wide * wide <= kMostProducts) {
          defaults.recipes.push_back(std::move(recipe));
        }
      }
      continue;
    }
    auto recipe = MakeRecipe(type == "poly:ridge" || type == "poly:lasso"
                                 ? type + ":view=auto"
                                 : type);
    if (const auto missing = recipe->WhatIsMissing(dataset)) {
      defaults.left_out.push_back(
          fmt::format("{} is left out: the data lack {}", type, *missing));
    } else {
      defaults.recipes.push_back(std::move(recipe));
    }
  }
  return defaults;
}

const std::vector<std::string>& BaselineTypes() {
  static const std::vector<std::string> types = {
      "zero", "mean", "poly:position", "poly:temperature"};
  return types;
}

bool IsBaseline(std::string_view spec) {
  return std::ranges::any_of(BaselineTypes(), [&](const std::string& type) {
    return spec == type || spec.starts_with(type + ":");
  });
}

std::vector<std::unique_ptr<ModelRecipe>> MissingBaselines(
    const data::Dataset& dataset,
    const std::vector<std::unique_ptr<ModelRecipe>>& recipes) {
  std::vector<std::unique_ptr<ModelRecipe>> missing;
  for (const std::string& type : BaselineTypes()) {
    const bool present = std::ranges::any_of(recipes, [&](const auto& recipe) {
      return recipe->name() == type || recipe->name().starts_with(type + ":");
    });
    if (present) continue;
    auto recipe = MakeRecipe(type);
    if (!recipe->WhatIsMissing(dataset)) missing.push_back(std::move(recipe));
  }
  return missing;
}

}  // namespace errmap::models
