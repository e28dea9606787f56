#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"

namespace errmap::data {

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
