#include "models/recipe_catalog.h"

#include <algorithm>

#include <fmt/format.h>

#include "data/text.h"
#include "models/blend/blend_recipe.h"
#include "models/file_recipe.h"
#include "models/net/net_recipe.h"
#include "models/option_list.h"
#include "models/polynomial/polynomial_options.h"

namespace errmap::models {

namespace {

// Every type of every family, in the order that they are presented.
const std::vector<ModelType>& AllTypes() {
  static const std::vector<ModelType> types = [] {
    std::vector<ModelType> all;
    for (const std::vector<ModelType>& family :
         {TypesOf<ConstantOptions>(),
          TypesOf<PositionTemperatureOptions>(),
          TypesOf<FullOptions>(),
          TypesOf<StepwiseOptions>(),
          TypesOf<BestSubsetOptions>(),
          TypesOf<PenalizedOptions>(),
          TypesOf<NetOptions>(),
          TypesOf<BlendOptions>(),
          TypesOf<FormulaOptions>()}) {
      all.insert(all.end(), family.begin(), family.end());
    }
    return all;
  }();
  return types;
}

// Of a formula, which has no name of its own: "poly:formula=...".
constexpr std::string_view kFormula = "poly";

const ModelType* FindType(const ModelSpec& spec) {
  if (spec.type == kFormula &&
      (spec.options.empty() || spec.options.front().first != "formula")) {
    return nullptr;
  }
  const auto found = std::ranges::find(AllTypes(), spec.type, &ModelType::name);
  return found == AllTypes().end() ? nullptr : &*found;
}

const ModelType& TypeOf(const ModelSpec& spec) {
  if (const ModelType* type = FindType(spec)) return *type;
  std::string nearest = data::NearestName(spec.type, ModelTypes());
  for (const std::string& type : ModelTypes()) {
    if (nearest.empty() && type.ends_with(":" + spec.type)) nearest = type;
  }
  RefuseSpec(
      spec.text,
      fmt::format("unknown; {}there are {}, poly:formula=..., file:model.json",
                  nearest.empty() ? "" : "did you mean '" + nearest + "'? ",
                  data::JoinWords(ModelTypes(), ", ")));
}

// Types that cannot be fitted because one thing is missing.
struct LackingTypes {
  std::string what;
  std::vector<std::string> types;
};

}  // namespace

const std::vector<std::string>& ModelTypes() {
  static const std::vector<std::string> types = [] {
    std::vector<std::string> names;
    for (const ModelType& type : AllTypes()) {
      if (type.name != kFormula) names.push_back(type.name);
    }
    return names;
  }();
  return types;
}

std::string_view AboutModel(std::string_view type) {
  const auto found = std::ranges::find(AllTypes(), type, &ModelType::name);
  if (found == AllTypes().end()) return "";
  return found->about;
}

std::unique_ptr<ModelRecipe> MakeRecipe(std::string_view spec_text) {
  if (auto recipe = MakeFileRecipe(spec_text)) return recipe;
  const ModelSpec spec = ParseModelSpec(spec_text);
  return TypeOf(spec).make(spec);
}

std::string RewrittenSpec(std::string_view spec_text) {
  const ModelSpec spec = ParseModelSpec(spec_text);
  return TypeOf(spec).rewrite(spec);
}

std::vector<ModelOption> OptionsOfModel(std::string_view type) {
  const ModelSpec spec = ParseModelSpec(type);
  std::vector<ModelOption> options;
  const ModelType& model = TypeOf(spec);
  const std::vector<EffectiveOption> in_effect = model.make(spec)->options();
  for (const OptionInfo& info : model.options()) {
    options.push_back({info.name, info.about, info.values, ""});
    for (const EffectiveOption& effective : in_effect) {
      if (effective.key == info.name) {
        options.back().fallback = TextOf(effective.value);
      }
    }
  }
  return options;
}

DefaultRecipes MakeDefaultRecipes(const data::Dataset& dataset,
                                  Index fewest_training_rows) {
  constexpr int kHighestFullDegree = 6;
  constexpr Index kRowsPerCoefficient = 5;
  constexpr double kMostProducts = 5e10;  // some seconds
  DefaultRecipes defaults;
  std::vector<LackingTypes> lacking;
  for (const ModelType& listed : AllTypes()) {
    if (!listed.is_compared) continue;
    const std::string& type = listed.name;
    // The report's net, and one that is tuned for what it will not have seen.
    if (type == "blend" && dataset.num_inputs() > 0) {
      defaults.recipes.push_back(MakeRecipe(NetInViews()));
    }
    if (type == "poly:full") {
      // Without a position the equations of the report are not there to stand
      // for a linear map.
      const int lowest = FindPosition(dataset, "") < 0 ? 1 : 2;
      for (int degree = lowest; degree <= kHighestFullDegree; ++degree) {
        auto recipe = MakeRecipe(FullOptions{.degree = degree});
        const Index coefficients = *recipe->NumCoefficients(dataset);
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
    const auto penalized = [&](fitting::Penalty family) {
      return MakeRecipe(
          PenalizedOptions{.family = family, .basis = {.view = ViewOptions()}});
    };
    auto recipe = type == "poly:ridge"   ? penalized(fitting::Penalty::kRidge)
                  : type == "poly:lasso" ? penalized(fitting::Penalty::kLasso)
                                         : MakeRecipe(type);
    if (const auto missing = recipe->WhatIsMissing(dataset)) {
      const auto known =
          std::ranges::find(lacking, *missing, &LackingTypes::what);
      if (known == lacking.end()) {
        lacking.push_back({*missing, {type}});
      } else {
        known->types.push_back(type);
      }
    } else {
      defaults.recipes.push_back(std::move(recipe));
    }
  }
  for (const auto& [what, types] : lacking) {
    defaults.left_out.push_back(fmt::format("{} {} left out: the data lack {}",
                                            data::JoinWords(types, ", "),
                                            types.size() == 1 ? "is" : "are",
                                            what));
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
