#pragma once

#include <vector>

#include "cli/machine/record/machine_record.h"
#include "cli/report/figures/figures.h"

namespace errmap::machine {

/// The error at the tool over the working plane, before and after compensation
/// by the recommended maps: mean errors as arrows, on one scale and after
/// compensation also on a larger one, and the RMS in colours, on one scale.
/// Nothing where the record has no plane.
std::vector<report::Figure> MachineFigures(const MachineRecord& machine);

}  // namespace errmap::machine
