#pragma once

#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "models/recipe_catalog.h"
#include "models/study/study.h"
#include "stats/holdout.h"

namespace errmap::testing {

using Recipes = std::vector<std::unique_ptr<models::ModelRecipe>>;

inline Recipes MakeRecipes(const std::vector<std::string>& specs) {
  Recipes recipes;
  for (const std::string& spec : specs) {
    recipes.push_back(models::MakeRecipe(spec));
  }
  return recipes;
}

inline std::vector<models::Holdout> MakeHoldouts(
    const data::Dataset& dataset, const std::vector<std::string>& specs) {
  std::vector<models::Holdout> holdouts;
  for (const std::string& spec : specs) {
    holdouts.push_back(
        models::MakeHoldout(stats::ParseHoldout(spec), dataset, 1));
  }
  return holdouts;
}

/// A recipe that calls `after_fit` after each of its fits.
class CountingRecipe final : public models::ModelRecipe {
 public:
  CountingRecipe(const std::string& spec, std::function<void()> after_fit)
      : recipe_(models::MakeRecipe(spec)), after_fit_(std::move(after_fit)) {}
  std::string name() const override { return recipe_->name(); }
  models::ModelKind kind() const override { return recipe_->kind(); }
  std::vector<models::EffectiveOption> options() const override {
    return recipe_->options();
  }
  std::optional<std::string> WhatIsMissing(
      const data::Dataset& dataset) const override {
    return recipe_->WhatIsMissing(dataset);
  }
  std::optional<Eigen::Index> NumCoefficients(
      const data::Dataset& dataset) const override {
    return recipe_->NumCoefficients(dataset);
  }
  models::FittedModel Fit(const data::Dataset& training,
                          const models::FitContext& context) const override {
    models::FittedModel fitted = recipe_->Fit(training, context);
    after_fit_();
    return fitted;
  }

 private:
  std::unique_ptr<models::ModelRecipe> recipe_;
  std::function<void()> after_fit_;
};

/// A file of this content in the test's own folder; its path.
inline std::string WriteTestFile(const std::string& name,
                                 const std::string& content) {
  const ::testing::TestInfo* test =
      ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string path = ::testing::TempDir() + test->test_suite_name() +
                           "_" + test->name() + "_" + name;
  std::ofstream(path) << content;
  return path;
}

/// The message of the exception of type E that `call` throws, else "".
template <typename E, typename Call>
std::string MessageOf(Call&& call) {
  try {
    call();
  } catch (const E& error) {
    return error.what();
  }
  return "";
}

}  // namespace errmap::testing
