#include "cli/study_setup/provenance.h"

#include <map>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

#include "cli/study_setup/study_options.h"
#include "data/files/shown_path.h"
#include "data/files_in_memory.h"
#include "data/measurements/measured_files.h"
#include "data/text.h"
#include "models/study/record/provenance_record.h"

namespace errmap::study_setup {
namespace {

constexpr const char* kHash = "_sha256";

// "data", "data_2", ...
std::string DataKey(std::size_t index) {
  return index == 0 ? "data" : fmt::format("data_{}", index + 1);
}

}  // namespace

InputFile HashInput(const std::string& file) {
  return {file, data::Sha256OfFile(file)};
}

std::vector<InputFile> HashInputs(const std::vector<std::string>& given,
                                  const std::vector<std::string>& first) {
  std::vector<InputFile> inputs;
  for (const std::string& file : first) inputs.push_back(HashInput(file));
  for (const std::string& file : data::FindFiles(given).paths) {
    inputs.push_back(HashInput(file));
  }
  return inputs;
}

std::string ShownNames(const std::vector<std::string>& files) {
  std::vector<std::string> shown;
  for (const std::string& file : files) shown.push_back(data::ShownPath(file));
  return data::JoinWords(shown, ", ");
}

models::ProvenanceRecord MakeProvenance(const std::string& command_line,
                                        const std::vector<InputFile>& inputs) {
  std::vector<models::InputFileRecord> shown;
  for (const InputFile& input : inputs) {
    shown.push_back(
        {.file = data::ShownPath(input.file), .sha256 = input.sha256});
  }
  return models::MakeProvenance(command_line, std::move(shown));
}

models::Provenance ModelProvenance(const std::string& command_line,
                                   const std::vector<InputFile>& data,
                                   long long rows,
                                   unsigned long long seed) {
  const models::ProvenanceRecord made = MakeProvenance(command_line, {});
  std::vector<std::string> libraries;
  for (const auto& [name, version] : made.libraries) {
    libraries.push_back(fmt::format("{} {}", name, version));
  }
  models::Provenance provenance = {{"command_line", command_line}};
  for (std::size_t i = 0; i < data.size(); ++i) {
    provenance.emplace_back(DataKey(i), data::ShownPath(data[i].file));
    provenance.emplace_back(DataKey(i) + kHash, data[i].sha256);
  }
  provenance.insert(provenance.end(),
                    {{"rows", std::to_string(rows)},
                     {"seed", std::to_string(seed)},
                     {"compiler", made.compiler},
                     {"libraries", data::JoinWords(libraries, ", ")},
                     {"platform", made.platform}});
  return provenance;
}

std::vector<InputFile> DataOf(const models::Provenance& provenance) {
  const std::map<std::string, std::string> texts(provenance.begin(),
                                                 provenance.end());
  std::vector<InputFile> data;
  for (auto file = texts.find(DataKey(0)); file != texts.end();
       file = texts.find(DataKey(data.size()))) {
    const auto hash = texts.find(file->first + kHash);
    data.push_back({file->second, hash == texts.end() ? "" : hash->second});
  }
  return data;
}

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

}  // namespace errmap::study_setup
