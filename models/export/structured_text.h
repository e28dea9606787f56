#pragma once

#include <string>

#include "models/export/program/map_program.h"
#include "models/export/text_block.h"

namespace errmap::models {

/// A FUNCTION_BLOCK NAME_map with an input per reading. Assignments, IF, FOR,
/// EXP and ABS (SIN and COS where the map reads angles), and no constant array,
/// which controllers differ in. In single precision all of it is REAL, for
/// controllers without LREAL.
ExportedFile StructuredText(const MapProgram& program,
                            const std::string& name,
                            Precision precision,
                            TextForm form);

}  // namespace errmap::models
