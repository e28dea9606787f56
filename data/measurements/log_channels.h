#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"

namespace errmap::data {

/// Readings of a log that were taken together.
struct LogPart {
  std::vector<Eigen::Index> rows;
  struct Column {
    std::size_t column = 0;  // index into the log
    std::string name;        // for whoever joins it
  };
  std::vector<Column> columns;
};

/// What a log has besides its times: one part with all rows; of a log with a
/// row for each channel and moment (time, channel, value) a part for each
/// channel, named by it and by the unit of the values. Times, dates and running
/// numbers are no readings. `time` (rows of the log), `known`: false where it
/// is missing, `clock`: the columns that it was read from.
std::vector<LogPart> PartsOfLog(const CsvTable& log,
                                const Eigen::VectorXd& time,
                                const std::vector<bool>& known,
                                const std::vector<std::ptrdiff_t>& clock);

}  // namespace errmap::data
