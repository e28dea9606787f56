#pragma once

#include <vector>

#include "cli/machine/record/machine_record.h"
#include "cli/report/table.h"

namespace errmap::machine {

/// Returns these tables, some possibly empty: the error at the tool on days
/// that no fit used, one row per choice of maps; the same by day; the stated
/// intervals; ISO 230-2 and, along diagonals, ISO 230-6; the contribution of
/// each component; the maps.
std::vector<report::Table> MachineTables(const MachineRecord& machine);

/// Returns the tables that fit a terminal.
std::vector<report::Table> ScreenTables(const MachineRecord& machine);

}  // namespace errmap::machine
