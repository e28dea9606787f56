#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Adds the columns of a log that was recorded beside the measurements, with a
/// remark. Each row takes the last reading before it if that is no older than a
/// step of the log. Otherwise it takes the next one if that is equally near. A
/// row without either has an empty cell. `selection.clock_offset` is the lead
/// of the log's clock, as ParseInterval reads it with a sign ("-3s"). Time
/// zones are applied if both state them. Columns that the table already has are
/// kept. The rows of both may be in any order. Dates and running numbers of the
/// log are not added. A log with a row for each channel and time gives a column
/// for each channel (PartsOfLog). Throws InputError if the table or the log has
/// no times, only one has dates, no row has a reading, or the log has no new
/// column. Throws OpenQuestion if only one of them states a time zone.
void MergeLog(const CsvTable& log,
              const DatasetSelection& selection,
              CsvTable* table);

/// Columns of a log with common times.
struct LogPart {
  std::vector<Eigen::Index> rows;
  struct Column {
    std::size_t column = 0;  // index into the log
    std::string name;        // for whoever joins it
  };
  std::vector<Column> columns = {};
};

/// Returns the columns of a log other than its times, as one part with all
/// rows. A log with a row for each channel and time (time, channel, value)
/// gives one part per channel. Each has the channel's name and the unit of its
/// values. Times, dates and running numbers are not returned. `time` (rows of
/// the log); `known`: false if it is missing; `clock`: the columns from which
/// it was read.
std::vector<LogPart> PartsOfLog(const CsvTable& log,
                                const Eigen::VectorXd& time,
                                const std::vector<bool>& known,
                                const std::vector<std::ptrdiff_t>& clock);

}  // namespace errmap::data
