#pragma once

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Adds the columns of a log that was kept beside the measurements, each row
/// with the reading nearest in time, with a remark. The last reading before a
/// row is taken where it is no older than a step of the log, else the next one,
/// as near; a row without either has an empty cell. `selection.clock_offset` is
/// what the log's clock is ahead, as ParseInterval reads it with a sign
/// ("-3s"). Time zones that both write down are taken account of. Columns that
/// the table has, too, stay its own. The rows of both may be in any order.
/// Dates and running numbers of the log are not joined; a row for each channel
/// and moment becomes a column for each channel (PartsOfLog).
///
/// Throws InputError where the table or the log has no times, one has dates and
/// the other none, no row has a reading, or the log no column that is new;
/// OpenQuestion where one of them alone writes down a time zone.
void MergeLog(const CsvTable& log,
              const DatasetSelection& selection,
              CsvTable* table);

}  // namespace errmap::data
