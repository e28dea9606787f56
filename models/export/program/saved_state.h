#pragma once

#include <string_view>

#include "models/export/program/map_program.h"
#include "models/export/program/run_program.h"

namespace errmap::models {

/// A number that tells the programs of maps apart, small enough to be the same
/// in single precision: a saved state goes with one of them.
double Fingerprint(const MapProgram& program);

/// The same of an export: of all that its files hold, its `name`, the version
/// that wrote it and their `precision`.
double ExportId(const MapProgram& program,
                std::string_view name,
                Precision precision);

/// How old a saved state may be (s) for a map to go on from it: an hour, or as
/// long as its filters remember.
double LongestAge(const MapProgram& program);

}  // namespace errmap::models
