#pragma once

#include <string>
#include <vector>

#include "models/export/language.h"
#include "models/export/program/self_test.h"

namespace errmap::models {

/// NAME.py: plain Python 3 that imports only math. It has functions check and
/// error, or for a map with a memory init, step and zero, as in C. Run as a
/// program, it checks `rows`, each within `tolerance` (target's unit).
std::vector<ExportedFile> PythonCode(const MapProgram& program,
                                     const std::string& name,
                                     const std::vector<SelfTestRow>& rows,
                                     double tolerance);

}  // namespace errmap::models
