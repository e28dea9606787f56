#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/json_blocks.h"
#include "models/model_file.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {

/// A file that a run read.
struct InputFile {
  std::string file;  // as given
  std::string sha256;

  bool operator==(const InputFile&) const = default;
};

/// Reads `file` for its hash; throws data::InputError where it cannot.
InputFile HashInput(const std::string& file);

/// Libraries that the figures pass through, with the versions in use (OpenBLAS
/// with its options and the processor it took, Ceres as compiled against), by
/// name.
const std::vector<std::pair<std::string, std::string>>& LibraryVersions();

/// Where a result comes from; the configuration is left to the caller.
models::ProvenanceRecord MakeProvenance(const std::string& command_line,
                                        const std::vector<InputFile>& inputs);

/// The block "provenance" of every document: {"version", "command_line",
/// "configuration", "inputs": [{"file","sha256"}], "compiler", "libraries":
/// {name: version}, "platform"}. `configuration` is what took effect, defaults
/// included; null where there is none.
Json ProvenanceJson(const std::string& command_line,
                    const Json& configuration,
                    const std::vector<InputFile>& inputs);

/// The same for a model file, whose provenance is plain texts: "command_line",
/// "data", "data_sha256", "rows", "seed", "compiler", "libraries", "platform".
models::Provenance ModelProvenance(const std::string& command_line,
                                   const InputFile& data,
                                   long long rows,
                                   unsigned long long seed);

}  // namespace errmap::cli
