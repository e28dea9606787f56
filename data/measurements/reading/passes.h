#pragma once

#include "data/measurements/reading/table_in_reading.h"

namespace errmap::data {

/// Finds the directions along the axis, from a column or the positions, and
/// keeps the rows of the one that the selection requests. Throws InputError if
/// no row has that direction.
void FindWays(TableInReading* in);

/// Finds the columns that count passes, directions, rows or days.
void FindColumnsThatCount(TableInReading* in);

/// Finds the cycles: in a column, else by numbering the passes in a new one.
void FindCycles(TableInReading* in);

/// If labels of cycles also name their session, the sessions become a new
/// column.
void FindBlocksInLabels(TableInReading* in);

}  // namespace errmap::data
