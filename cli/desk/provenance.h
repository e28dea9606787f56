#pragma once

#include <string>
#include <vector>

#include "models/model_file.h"
#include "models/study/record/study_record.h"

namespace errmap::desk {

/// A file that a run read, by its name as given.
using InputFile = models::InputFileRecord;

/// Reads `file` for its hash; throws data::InputError where it cannot.
InputFile HashInput(const std::string& file);

/// `first`, then the files that `given` names (data::FindFiles).
std::vector<InputFile> HashInputs(const std::vector<std::string>& given,
                                  const std::vector<std::string>& first = {});

/// The names of files as results have them (data::ShownPath).
std::string ShownNames(const std::vector<std::string>& files);

/// models::MakeProvenance of a run, paths as they are shown.
models::ProvenanceRecord MakeProvenance(const std::string& command_line,
                                        const std::vector<InputFile>& inputs);

/// The same for a model file, whose provenance is plain texts: "command_line",
/// "data", "data_sha256", "rows", "seed", "compiler", "libraries", "platform".
/// What was learnt from further files is named after the first: "data_2",
/// "data_2_sha256", ...
models::Provenance ModelProvenance(const std::string& command_line,
                                   const std::vector<InputFile>& data,
                                   long long rows,
                                   unsigned long long seed);

/// The files that ModelProvenance named, in their order.
std::vector<InputFile> DataOf(const models::Provenance& provenance);

}  // namespace errmap::desk
