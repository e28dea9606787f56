#include "cli/study_file/provenance.h"

#include <algorithm>

#include <CLI/Version.hpp>
#include <fmt/format.h>

#include "cli/shell/shown_path.h"
#include "data/atomic_file.h"
#include "data/sha256.h"
#include "models/study/record/make_provenance.h"
#include "models/study/record/record_json.h"

namespace errmap::cli {

InputFile HashInput(const std::string& file) {
  return {file, data::Sha256(data::ReadFile(file))};
}

models::ProvenanceRecord MakeProvenance(const std::string& command_line,
                                        const std::vector<InputFile>& inputs) {
  std::vector<models::InputFileRecord> shown;
  for (const InputFile& input : inputs) {
    shown.push_back({.file = ShownPath(input.file), .sha256 = input.sha256});
  }
  models::ProvenanceRecord record =
      models::MakeProvenance(command_line, std::move(shown));
  // The program's own library, among the others by name.
  const std::pair<std::string, std::string> ours{"CLI11", CLI11_VERSION};
  record.libraries.insert(std::ranges::upper_bound(record.libraries, ours),
                          ours);
  return record;
}

Json ProvenanceJson(const std::string& command_line,
                    const Json& configuration,
                    const std::vector<InputFile>& inputs) {
  Json json = models::ToJson(MakeProvenance(command_line, inputs));
  json["configuration"] = configuration;
  return json;
}

models::Provenance ModelProvenance(const std::string& command_line,
                                   const InputFile& data,
                                   long long rows,
                                   unsigned long long seed) {
  const models::ProvenanceRecord made = MakeProvenance(command_line, {});
  std::string libraries;
  for (const auto& [name, version] : made.libraries) {
    libraries +=
        fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
  }
  return {{"command_line", command_line},
          {"data", ShownPath(data.file)},
          {"data_sha256", data.sha256},
          {"rows", std::to_string(rows)},
          {"seed", std::to_string(seed)},
          {"compiler", made.compiler},
          {"libraries", libraries},
          {"platform", made.platform}};
}

}  // namespace errmap::cli
