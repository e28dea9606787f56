#include "cli/desk/configuration_record.h"

#include "data/shown_path.h"

namespace errmap::desk {
namespace {

models::LeftOut<std::string> Text(const std::string& text) {
  if (text.empty()) return {};
  return text;
}

models::LeftOut<std::vector<std::string>> List(
    const std::vector<std::string>& list) {
  if (list.empty()) return {};
  return list;
}

// In the target's unit; one that has a unit of its own is among those of the
// components in theirs.
models::LeftOut<double> Number(const GivenError& given) {
  if (!given.is_given() || given.has_unit()) return {};
  return given.value;
}

models::ComponentConfigurationRecord ComponentOf(
    const ComponentConfig& component) {
  models::ComponentConfigurationRecord record;
  record.name = Text(component.name);
  record.data = Text(data::ShownPath(component.data));
  if (!component.selection.where.empty()) {
    auto& where = record.where.emplace();
    for (const data::ColumnFilter& filter : component.selection.where) {
      std::visit(
          [&](const auto& value) { where.emplace_back(filter.column, value); },
          filter.value);
    }
  }
  record.target = Text(component.selection.target);
  record.inputs = List(component.selection.inputs);
  record.exclude = List(component.selection.exclude);
  record.group = Text(component.selection.group);
  record.time = Text(component.selection.time);
  record.session = Text(component.selection.session);
  if (component.selection.align != data::Alignment::kNone) {
    record.align = component.selection.align;
  }
  record.weight = Text(component.selection.weight);
  record.missing = component.selection.missing;
  record.faults = component.selection.faults;
  record.keep_dead = component.selection.keep_dead;
  record.goal = Number(component.goal);
  record.indifference = Number(component.indifference);
  if (!component.options.empty()) record.options = component.options;
  return record;
}

}  // namespace

models::ConfigurationRecord EffectiveConfiguration(const StudyConfig& config) {
  models::ConfigurationRecord record;
  record.seed = config.seed;
  record.goal = Number(config.goal);
  record.indifference = Number(config.indifference);
  if (config.choose != models::Choose::kAuto) {
    record.choose = std::string(ToString(config.choose));
  }
  if (config.prefer != models::Prefer::kLeastError) {
    record.prefer = std::string(ToString(config.prefer));
  }
  record.holdouts = List(config.holdouts);
  record.models = List(config.models);
  record.rezero = Text(config.rezero);
  for (const ComponentConfig& component : config.components) {
    record.component.push_back(ComponentOf(component));
  }
  return record;
}

}  // namespace errmap::desk
