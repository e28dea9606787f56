#pragma once

#include <string>
#include <vector>

#include "models/export/language.h"
#include "models/export/program/map_program.h"

namespace errmap::models {

/// NAME.st: IEC 61131-3 structured text, a FUNCTION_BLOCK NAME_map with an
/// input per reading. Assignments, IF and EXP only (SIN and COS where the map
/// reads angles): no loop, no constant array, which controllers differ in.
std::vector<ExportedFile> StructuredText(const MapProgram& program,
                                         const std::string& name);

}  // namespace errmap::models
