#pragma once

#include <fstream>
#include <memory>
#include <string>
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
