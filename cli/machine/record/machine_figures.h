#pragma once

#include <vector>

#include "cli/machine/record/machine_record.h"
#include "cli/report/figures/figures.h"

namespace errmap::machine {

/// The error at the tool over the working plane, before and after compensation
/// by the recommended maps. Arrows show mean errors on one scale, and after
/// compensation also on a larger one. Colours show the RMS on one scale.
/// Returns nothing if the record has no plane.
std::vector<report::Figure> MachineFigures(const MachineRecord& machine);

}  // namespace errmap::machine
