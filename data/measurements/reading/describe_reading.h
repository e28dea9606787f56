#pragma once

#include "data/measurements/reading/table_in_reading.h"

namespace errmap::data {

/// Fills `reading` and `position` of in->read from the results: target, axis,
/// time, sessions, cycles, rows left out, files.
void DescribeReading(TableInReading* in);

}  // namespace errmap::data
