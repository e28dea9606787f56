#include "models/uncertainty/held_out_errors.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "models/recipe_catalog.h"
#include "models/uncertainty/add_uncertainty.h"
#include "tests/models/history/history_data.h"

namespace errmap::models {
namespace {

HeldOutErrors ErrorsOf(const std::string& recipe, const data::Dataset& days) {
  FittedModel fitted = MakeRecipe(recipe)->Fit(days, {});
  AddUncertainty(days, MakeRecipe(recipe), {}, &fitted);
  return *fitted.held_out;
}

// In use a temperature that the map does not read may not be measured.
TEST(HeldOutErrors, KnowNoTemperatureThatTheMapDoesNotRead) {
  const data::Dataset days = errmap::testing::WanderingDays();
  EXPECT_EQ(ErrorsOf("poly:formula=t1_degC", days).temperature, "t1_degC");
  EXPECT_EQ(ErrorsOf("poly:formula=t2_degC", days).temperature, "t2_degC");
  EXPECT_EQ(ErrorsOf("mean", days).temperature, "");
}

}  // namespace
}  // namespace errmap::models
