#pragma once

#include <string>
#include <vector>

#include "models/export/language.h"
#include "models/export/program/self_test.h"

namespace errmap::models {

/// NAME.py: plain Python 3, nothing but math. Functions check, and error, or
/// init, step and zero of a map with a memory, as in C. Run as a program it
/// checks `rows`, each within `tolerance` (target's unit).
std::vector<ExportedFile> PythonCode(const MapProgram& program,
                                     const std::string& name,
                                     const std::vector<SelfTestRow>& rows,
                                     double tolerance);

}  // namespace errmap::models
