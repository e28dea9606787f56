#pragma once

#include <vector>

#include "cli/report/table.h"
#include "models/study/record/machine_record.h"

namespace errmap::report {

/// What compensation is worth: the error at the tool on days that no fit saw,
/// each way of choosing maps a row.
Table ToolTipTable(const models::MachineRecord& machine);

/// The same by day.
Table ToolTipDayTable(const models::MachineRecord& machine);

/// How far from the maps the error may be, and how often it was within.
Table ToolTipIntervalTable(const models::MachineRecord& machine);

/// ISO 230-2 figures of each axis before and after compensation.
Table PositioningTable(const models::MachineRecord& machine);

/// The same along the diagonals (ISO 230-6).
Table DiagonalTable(const models::MachineRecord& machine);

/// What each component leaves at the tool.
Table MachinePartTable(const models::MachineRecord& machine);

/// Which map each component has in each choice.
Table MachineMapTable(const models::MachineRecord& machine);

/// All of these that have rows, in this order.
std::vector<Table> MachineTables(const models::MachineRecord& machine);

}  // namespace errmap::report
