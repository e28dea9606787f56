#pragma once

#include <vector>

#include "cli/report/figures/figures.h"
#include "models/study/record/machine_record.h"

namespace errmap::report {

/// The error at the tool over the working plane, before and after compensation
/// by the recommended maps: mean errors as arrows, on one scale and after
/// compensation also on a larger one, and the RMS in colours, on one scale.
/// Nothing where the record has no plane.
std::vector<Figure> MachineFigures(const models::MachineRecord& machine);

}  // namespace errmap::report
