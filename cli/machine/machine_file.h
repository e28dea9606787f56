#pragma once

#include <string>
#include <vector>

#include "models/kinematics/machine.h"

namespace errmap::machine {

/// A machine.toml with its maps, and warnings about it, one line each.
struct MachineFile {
  models::Machine machine;
  std::vector<std::string> warnings;
};

/// Reads a machine and the model files that it names, beside it. Throws
/// data::InputError with file, line and names. Causes: not TOML; an unknown
/// key, branch or joint; a link given twice; an error that its link does not
/// have. Also a missing model file, or a map of another quantity.
MachineFile ReadMachineFile(const std::string& path);

/// Reads a machine without its maps, whose files need not exist yet. A source
/// has the file's name as in machine.toml, and no map.
MachineFile ReadMachineOutline(const std::string& path);

}  // namespace errmap::machine
