#pragma once

#include <string>
#include <vector>

#include "data/units.h"
#include "models/export/export_map.h"
#include "models/export/language.h"

namespace errmap::models {

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
