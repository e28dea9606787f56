#pragma once

#include <vector>

#include "cli/machine/record/machine_record.h"
#include "cli/report/table.h"

namespace errmap::machine {

/// The error at the tool on days that no fit saw, each way of choosing maps a
/// row; the same by day; the stated intervals; ISO 230-2 and, along diagonals,
/// ISO 230-6; what each component leaves at the tool; the maps. Some may have
/// no rows.
std::vector<report::Table> MachineTables(const MachineRecord& machine);

/// Those of them that a terminal has room for.
std::vector<report::Table> ScreenTables(const MachineRecord& machine);

}  // namespace errmap::machine
