#include "cli/shell/model_defaults.h"

#include <variant>

#include <fmt/format.h>

#include "models/error_model.h"
#include "models/recipe_catalog.h"

namespace errmap::cli {

std::map<std::string, std::string> ModelDefaults(const std::string& type) {
  std::map<std::string, std::string> defaults;
  for (const auto& option : models::MakeRecipe(type)->options()) {
    std::visit(
        [&](const auto& value) {
          defaults[option.key] = fmt::format("{}", value);
        },
        option.value);
  }
  return defaults;
}

}  // namespace errmap::cli
