#pragma once

#include <string>
#include <vector>

#include "models/study/record/provenance_record.h"

namespace errmap::models {

/// Where a result comes from: this version, its compiler, platform and the
/// libraries that the figures pass through, by name (OpenBLAS with its options
/// and the processor it took, Ceres as compiled against). The configuration is
/// left to the caller.
ProvenanceRecord MakeProvenance(std::string command_line,
                                std::vector<InputFileRecord> inputs);

/// A library of the program's own to be named among them; called before all
/// else.
void NameLibrary(const std::string& name, const std::string& version);

}  // namespace errmap::models
