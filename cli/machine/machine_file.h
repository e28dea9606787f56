#pragma once

#include <string>
#include <vector>

#include "models/kinematics/machine.h"

namespace errmap::machine {

/// A machine.toml with its maps, and what is odd about it, one line each.
struct MachineFile {
  models::Machine machine;
  std::vector<std::string> warnings;
};

/// Reads a machine and the model files that it names, beside it. Throws
/// data::InputError with file, line and names: what is no TOML, an unknown key,
/// branch or joint, a link that stands twice, an error that is none of its
/// link's, a model file that is not there, or a map of another quantity.
MachineFile ReadMachineFile(const std::string& path);

/// The same without the maps, which need not be there yet: a source has the
/// file's name as machine.toml has it, and no map.
MachineFile ReadMachineOutline(const std::string& path);

}  // namespace errmap::machine
