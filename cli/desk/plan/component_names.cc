#include "cli/desk/plan/component_names.h"

#include <filesystem>
#include <set>
#include <string>

#include <fmt/format.h>

#include "data/input_error.h"
#include "data/text.h"

namespace errmap::desk {
namespace {

std::string DefaultName(const ComponentConfig& component) {
  std::string name = std::filesystem::path(component.data).stem().string();
  for (const data::ColumnFilter& filter : component.selection.where) {
    name += ", " + ValueText(filter);
  }
  return name;
}

}  // namespace

void NameComponents(StudyConfig* config) {
  std::set<std::string> taken;
  for (ComponentConfig& component : config->components) {
    if (component.name.empty()) component.name = DefaultName(component);
    if (taken.insert(component.name).second) continue;
    throw data::InputError(
        fmt::format("two components are named {}; give each a name of its own",
                    data::QuotedName(component.name)));
  }
}

}  // namespace errmap::desk
