#include "models/study_file/provenance.h"

#include <fmt/format.h>

#include "data/atomic_file.h"
#include "data/sha256.h"
#include "data/shown_path.h"
#include "models/study/record/make_provenance.h"

namespace errmap::study_file {

InputFile HashInput(const std::string& file) {
  return {file, data::Sha256(data::ReadFile(file))};
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
          {"data", data::ShownPath(data.file)},
          {"data_sha256", data.sha256},
          {"rows", std::to_string(rows)},
          {"seed", std::to_string(seed)},
          {"compiler", made.compiler},
          {"libraries", libraries},
          {"platform", made.platform}};
}

}  // namespace errmap::study_file
