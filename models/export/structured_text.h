#pragma once

#include <string>

#include "models/export/program/map_program.h"
#include "models/export/text_block.h"

namespace errmap::models {

/// A FUNCTION_BLOCK NAME_map with one input for each reading. It uses
/// assignments, IF, FOR, EXP and ABS (SIN and COS if the map reads angles). It
/// has no constant arrays, since controllers differ in them. In single
/// precision everything is REAL, for controllers without LREAL.
ExportedFile StructuredText(const MapProgram& program,
                            const std::string& name,
                            Precision precision,
                            TextForm form);

}  // namespace errmap::models
