#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/clock/clock.h"

namespace errmap::data {

/// Makes a clock continuous, for rows in the order of measurement, with a
/// remark if it changes a time. It corrects times of day that pass midnight,
/// hours from 1 to 12 after noon, and a dated clock set back by up to an hour
/// (to three steps), as at the end of summer time.
void GoOnOverMidnight(const CsvTable& table,
                      const std::vector<Eigen::Index>& rows,
                      Clock* clock);

}  // namespace errmap::data
