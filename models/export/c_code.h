#pragma once

#include <string>
#include <vector>

#include "models/export/language.h"
#include "models/export/program/self_test.h"

namespace errmap::models {

/// NAME.h and NAME.c in C99: no allocation, and no library function but exp
/// (sin and cos if the map reads angles). Every symbol begins with NAME_. With
/// NAME_SELF_TEST defined, NAME.c has a main that checks `rows`, each within
/// `tolerance` (target's unit).
std::vector<ExportedFile> CCode(const MapProgram& program,
                                const std::string& name,
                                Precision precision,
                                const std::vector<SelfTestRow>& rows,
                                double tolerance);

/// The same declarations and functions in double precision, for code that
/// includes math.h: no guard, no include, no self-test.
std::string CFragment(const MapProgram& program, const std::string& name);

}  // namespace errmap::models
