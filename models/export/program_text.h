#pragma once

#include <string>
#include <vector>

#include "models/export/language.h"
#include "models/export/program/map_program.h"
#include "models/export/program/self_test.h"
#include "models/export/text_block.h"

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

/// NAME.py: plain Python 3 that imports only math. It has functions check and
/// error, or for a map with a memory init, step and zero, as in C. Run as a
/// program, it checks `rows`, each within `tolerance` (target's unit).
std::vector<ExportedFile> PythonCode(const MapProgram& program,
                                     const std::string& name,
                                     const std::vector<SelfTestRow>& rows,
                                     double tolerance);

/// A FUNCTION_BLOCK NAME_map with one input for each reading. It uses
/// assignments, IF, FOR, EXP and ABS (SIN and COS if the map reads angles). It
/// has no constant arrays, since controllers differ in them. In single
/// precision everything is REAL, for controllers without LREAL.
ExportedFile StructuredText(const MapProgram& program,
                            const std::string& name,
                            Precision precision,
                            TextForm form);

}  // namespace errmap::models
