#include "cli/report/configuration_json.h"

#include <cmath>

namespace errmap::cli {
namespace {

void AddText(const char* key, const std::string& text, Json* json) {
  if (!text.empty()) (*json)[key] = text;
}

void AddList(const char* key,
             const std::vector<std::string>& list,
             Json* json) {
  if (!list.empty()) (*json)[key] = list;
}

void AddNumber(const char* key, double number, Json* json) {
  if (std::isfinite(number)) (*json)[key] = number;
}

Json WhereJson(const std::vector<data::ColumnFilter>& where) {
  Json json = Json::object();
  for (const data::ColumnFilter& filter : where) {
    std::visit([&](const auto& value) { json[filter.column] = value; },
               filter.value);
  }
  return json;
}

Json ComponentJson(const ComponentConfig& component) {
  Json json = Json::object();
  AddText("name", component.name, &json);
  AddText("data", component.data, &json);
  if (!component.where.empty()) json["where"] = WhereJson(component.where);
  AddText("target", component.target, &json);
  AddList("inputs", component.inputs, &json);
  AddList("exclude", component.exclude, &json);
  AddText("group", component.group, &json);
  AddText("time", component.time, &json);
  AddText("session", component.session, &json);
  if (component.align != data::Alignment::kNone) {
    json["align"] = data::ToString(component.align);
  }
  AddText("weight", component.weight, &json);
  json["missing"] =
      component.missing == data::MissingPolicy::kError ? "error" : "drop-rows";
  json["faults"] =
      component.faults == data::FaultPolicy::kKeep ? "keep" : "drop-rows";
  json["keep_dead"] = component.keep_dead;
  AddNumber("goal", component.goal, &json);
  AddNumber("indifference", component.indifference, &json);
  return json;
}

}  // namespace

Json EffectiveConfiguration(const StudyConfig& config) {
  Json json = {{"seed", config.seed}};
  AddNumber("goal", config.goal, &json);
  AddNumber("indifference", config.indifference, &json);
  AddList("holdouts", config.holdouts, &json);
  AddList("models", config.models, &json);
  Json components = Json::array();
  for (const ComponentConfig& component : config.components) {
    components.push_back(ComponentJson(component));
  }
  json["component"] = std::move(components);
  return json;
}

}  // namespace errmap::cli
