#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models/recipe_catalog.h"
#include "models/study.h"

namespace errmap::testing {

using Recipes = std::vector<std::unique_ptr<models::ModelRecipe>>;

inline Recipes RecipesOf(const std::vector<std::string>& specs) {
  Recipes recipes;
  for (const std::string& spec : specs) {
    recipes.push_back(models::MakeRecipe(spec));
  }
  return recipes;
}

inline std::vector<models::Holdout> HoldoutsOf(
    const data::Dataset& dataset, const std::vector<std::string>& specs) {
  std::vector<models::Holdout> holdouts;
  for (const std::string& spec : specs) {
    holdouts.push_back(
        models::MakeHoldout(stats::ParseHoldout(spec), dataset, 1));
  }
  return holdouts;
}

}  // namespace errmap::testing
