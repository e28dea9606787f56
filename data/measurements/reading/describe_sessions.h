#pragma once

#include "data/csv.h"
#include "data/measurements/reading/clock.h"
#include "data/measurements/reading/nights.h"
#include "data/measurements/reading/read_table.h"

namespace errmap::data {

/// Fills the sessions of read->reading, and the number of its cycles, from the
/// sessions that were found.
void DescribeSessions(const CsvTable& table,
                      const Clock& clock,
                      const Nights& nights,
                      ReadTable* read);

}  // namespace errmap::data
