#pragma once

#include "data/measurements/reading/table_in_reading.h"

namespace errmap::data {

/// Finds the ways along the axis, by a column or by the positions, and keeps
/// the rows of the one that the selection asks for. Throws InputError where no
/// row goes that way.
void FindWays(TableInReading* in);

/// Finds the columns that count passes, ways, rows or days.
void FindColumnsThatCount(TableInReading* in);

/// Finds the cycles: by a column, else by numbering the passes in one more.
void FindCycles(TableInReading* in);

/// Labels of cycles that name their session, too, become one more column.
void FindBlocksInLabels(TableInReading* in);

}  // namespace errmap::data
