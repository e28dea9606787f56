#pragma once

#include "data/csv.h"
#include "data/measurements/reading/clock.h"
#include "data/measurements/reading/nights.h"
#include "data/measurements/reading/read_table.h"

namespace errmap::data {

/// Fills read->reading, and read->position, from what was found in the table
/// that was `given`: target, axis, time, sessions, cycles, rows left out,
/// files.
void DescribeReading(const CsvTable& given,
                     const DatasetSelection& selection,
                     const Clock& clock,
                     const Nights& nights,
                     ReadTable* read);

}  // namespace errmap::data
