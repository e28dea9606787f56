#pragma once

#include <string_view>

#include "models/export/program/map_program.h"
#include "models/export/program/run_program.h"

namespace errmap::models {

/// Returns a number that identifies the program of a map; a saved state belongs
/// to one of them. It is small enough to be exact in single precision.
double Fingerprint(const MapProgram& program);

/// The same for an export: all that its files contain, its `name`, the version
/// that wrote it and their `precision`.
double ExportId(const MapProgram& program,
                std::string_view name,
                Precision precision);

/// Returns the largest age (s) of a saved state from which a map may continue:
/// an hour, or the memory of its filters if longer.
double LongestAge(const MapProgram& program);

}  // namespace errmap::models
