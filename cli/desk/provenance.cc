#include "cli/desk/provenance.h"

#include <map>

#include <fmt/format.h>

#include "data/files/shown_path.h"
#include "data/files_in_memory.h"
#include "data/measurements/measured_files.h"
#include "data/text.h"
#include "models/study/record/making/make_provenance.h"

namespace errmap::desk {
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
  std::string libraries;
  for (const auto& [name, version] : made.libraries) {
    libraries +=
        fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
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
                     {"libraries", libraries},
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

}  // namespace errmap::desk
