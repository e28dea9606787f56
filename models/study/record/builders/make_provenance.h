#pragma once

#include <string>
#include <vector>

#include "models/study/record/provenance_record.h"

namespace errmap::models {

/// Returns the origin of a result: this version, its compiler, platform, and
/// the numerical libraries by name. OpenBLAS has its options and detected
/// processor, Ceres the version compiled against. The caller adds the
/// configuration.
ProvenanceRecord MakeProvenance(std::string command_line,
                                std::vector<InputFileRecord> inputs);

/// Adds one of the program's own libraries to these; call it before any other
/// function.
void NameLibrary(const std::string& name, const std::string& version);

}  // namespace errmap::models
