#include "cli/desk/configuration_record.h"

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "cli/desk/study_options.h"
#include "data/files/shown_path.h"

namespace errmap::desk {
namespace {

models::LeftOut<std::string> Text(const std::string& text) {
  if (text.empty()) return {};
  return text;
}

// How what is said stands in a record; nothing where it was left to the
// defaults, unless the record always has it.
void Put(const std::string& text, models::LeftOut<std::string>* field) {
  *field = Text(text);
}

void Put(const std::vector<std::string>& list,
         models::LeftOut<std::vector<std::string>>* field) {
  if (!list.empty()) *field = list;
}

// In the target's unit; one that has a unit of its own is among those of the
// components in theirs.
void Put(const GivenError& given, models::LeftOut<double>* field) {
  if (given.is_given() && !given.has_unit()) *field = given.value;
}

template <typename Value>
requires std::is_enum_v<Value>
void Put(Value word, models::LeftOut<Value>* field) {
  if (word != Value{}) *field = word;
}

template <typename Value>
requires std::is_enum_v<Value>
void Put(Value word, models::LeftOut<std::string>* field) {
  if (word != Value{}) *field = std::string(ToString(word));
}

template <typename Value>
void Put(Value value, Value* field) {
  *field = value;
}

// Takes each option to the member of the record that has its key.
template <typename Record>
auto RecordIn(Record* record) {
  return [record](const StudyOption& option,
                  const auto& said,
                  const auto&... /*values*/) {
    models::VisitMembers(*record, [&](std::string_view key, auto& field) {
      if constexpr (requires { Put(said, &field); }) {
        if (key == option.key) Put(said, &field);
      }
    });
  };
}

models::ComponentConfigurationRecord ComponentOf(
    const ComponentConfig& component) {
  models::ComponentConfigurationRecord record;
  record.name = Text(component.name);
  record.data = Text(data::ShownPath(component.data));
  std::vector<std::string> more;
  for (const std::string& file : component.more_data) {
    more.push_back(data::ShownPath(file));
  }
  if (!more.empty()) record.more_data = more;
  if (!component.selection.where.empty()) {
    auto& where = record.where.emplace();
    for (const data::ColumnFilter& filter : component.selection.where) {
      std::visit(
          [&](const auto& value) { where.emplace_back(filter.column, value); },
          filter.value);
    }
  }
  ForComponentOptions(component, RecordIn(&record));
  if (!component.options.empty()) record.options = component.options;
  return record;
}

}  // namespace

models::ConfigurationRecord EffectiveConfiguration(const StudyConfig& config) {
  models::ConfigurationRecord record;
  record.seed = config.seed;
  ForStudyOptions(config, RecordIn(&record));
  Put(config.holdouts, &record.holdouts);
  Put(config.models, &record.models);
  for (const ComponentConfig& component : config.components) {
    record.component.push_back(ComponentOf(component));
  }
  return record;
}

}  // namespace errmap::desk
