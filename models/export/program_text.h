#pragma once

#include <string>
#include <vector>

#include "data/units.h"
#include "models/export/export_map.h"
#include "models/export/language.h"
#include "models/export/program/map_program.h"
#include "models/export/program/self_test.h"
#include "models/export/text_block.h"

namespace errmap::models {

/// NAME.h and NAME.c in C99: no allocation, and no library function but exp and
/// fabs (sin and cos if the map reads angles). Every symbol begins with NAME_.
/// With NAME_SELF_TEST defined, NAME.c has a main that checks `rows`, each
/// within `tolerance` (target's unit).
std::vector<ExportedFile> CCode(const MapProgram& program,
                                const std::string& name,
                                Precision precision,
                                const std::vector<SelfTestRow>& rows,
                                double tolerance);

/// The same declarations and functions in double precision, for code that
/// includes math.h: no guard, no include, no self-test.
std::string CFragment(const MapProgram& program, const std::string& name);

/// NAME.py: plain Python 3 that imports only math. Its class Map has begin,
/// step (read and move), zero, get_state and set_state. Run as a program, it
/// checks `rows`, each within `tolerance` (target's unit).
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

struct HalOptions {
  data::Unit unit;  // of the machine: [TRAJ] LINEAR_UNITS
  int joint = 0;    // 0 to 8; its axis is one of XYZABCUVW
};

/// Longest HAL name, including the component's name and the dot.
inline constexpr std::size_t kLongestHalName = 47;

/// A pin and the reading connected to it.
struct HalPin {
  std::string pin;   // as HAL shows it, without the component's name
  std::string name;  // column
};

struct HalExport {
  std::string component;  // the name for halcompile and loadrt
  std::vector<HalPin> pins;
  std::vector<ExportedFile> files;
};

/// A component for LinuxCNC: COMPONENT.comp contains the map's C code.
/// COMPONENT.hal puts the stock offset component between a joint's motor
/// position and its feedback. COMPONENT_eoffset.hal wires it as an external
/// offset of the joint's axis. COMPONENT_state.py saves its state to a file
/// across restarts. The offset is -error in the machine's unit. Throws
/// std::invalid_argument if the error is not a length.
HalExport HalComponent(const MapExport& map, const HalOptions& options);

}  // namespace errmap::models
