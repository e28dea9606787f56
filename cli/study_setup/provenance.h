#pragma once

#include <string>
#include <vector>

#include "cli/study_setup/study_config.h"
#include "models/model_file.h"
#include "models/study/record/study_record.h"

namespace errmap::study_setup {

/// A file that a run read, with its name as given.
using InputFile = models::InputFileRecord;

/// Reads `file` for its hash. Throws data::InputError if it cannot be read.
InputFile HashInput(const std::string& file);

/// Hashes the files `first`, then those that `given` names (data::FindFiles).
std::vector<InputFile> HashInputs(const std::vector<std::string>& given,
                                  const std::vector<std::string>& first = {});

/// Returns the names of files as results show them (data::ShownPath).
std::string ShownNames(const std::vector<std::string>& files);

/// Calls models::MakeProvenance for a run, with paths as results show them.
models::ProvenanceRecord MakeProvenance(const std::string& command_line,
                                        const std::vector<InputFile>& inputs);

/// Makes the provenance of a model file, as plain texts: "command_line",
/// "data", "data_sha256", "rows", "seed", "compiler", "libraries", "platform".
/// Further data files are "data_2", "data_2_sha256", ...
models::Provenance ModelProvenance(const std::string& command_line,
                                   const std::vector<InputFile>& data,
                                   long long rows,
                                   unsigned long long seed);

/// Returns the files that ModelProvenance named, in their order.
std::vector<InputFile> DataOf(const models::Provenance& provenance);

/// Returns a study's configuration by the keys of a study file, for provenance:
/// {"seed","goal","indifference","holdouts","models",
/// "component":[{"name","data","where","target",...}]}. Paths are as results
/// show them. Defaults that were not resolved are left out, so a study file
/// made from it may be incomplete.
models::ConfigurationRecord EffectiveConfiguration(const StudyConfig& config);

}  // namespace errmap::study_setup
