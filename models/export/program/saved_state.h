#pragma once

#include "models/export/program/map_program.h"

namespace errmap::models {

/// A number that tells the programs of maps apart, small enough to be the same
/// in single precision: a saved state goes with one of them.
double Fingerprint(const MapProgram& program);

/// How old a saved state may be (s) for a map to go on from it: an hour, or as
/// long as its filters remember.
double LongestAge(const MapProgram& program);

}  // namespace errmap::models
