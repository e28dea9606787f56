#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/reading/clock.h"

namespace errmap::data {

/// Lets a clock go on, in rows in the order of measurement, with a remark where
/// it says another time: times of day that pass midnight; hours from 1 to 12,
/// behind noon; a dated clock that is set back by up to an hour (to three
/// steps), as where summer time ends.
void GoOnOverMidnight(const CsvTable& table,
                      const std::vector<Eigen::Index>& rows,
                      Clock* clock);

}  // namespace errmap::data
