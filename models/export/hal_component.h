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

/// Names in HAL end here, the component's and the dot included.
inline constexpr std::size_t kLongestHalName = 47;

/// A pin and the reading that belongs there.
struct HalPin {
  std::string pin;   // as HAL shows it, without the component's name
  std::string name;  // column
};

struct HalExport {
  std::string component;  // as halcompile and loadrt know it
  std::vector<HalPin> pins;
  std::vector<ExportedFile> files;
};

/// A component for LinuxCNC, COMPONENT.comp (the C of the map within), with
/// COMPONENT.hal, which wires it by the stock offset component between the
/// motor position of a joint and its feedback, COMPONENT_eoffset.hal, which
/// wires it as an external offset of the joint's axis, and COMPONENT_state.py,
/// which keeps its state in a file over a restart. The offset is -error in the
/// machine's unit. Throws std::invalid_argument where the error is no length.
HalExport HalComponent(const MapExport& map, const HalOptions& options);

}  // namespace errmap::models
