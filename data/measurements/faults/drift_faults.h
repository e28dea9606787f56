#pragma once

#include <optional>
#include <vector>

#include "data/measurements/column_faults.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {

/// Finds thermometers that depart further from the others in each session
/// (kDrifting), the worst first. Skips columns that are faulty as a whole
/// according to `known`.
std::vector<ColumnFault> FindDrift(const MeasuredColumns& measured,
                                   const std::vector<Thermometer>& thermometers,
                                   const std::vector<ColumnFault>& known);

/// Finds the thermometer that departs further from the mean of the others at
/// the start (rows from 0) of each session. It finds those too different for
/// FindDrift, and needs four sessions or more.
std::optional<ColumnFault> FindColdDrift(
    const MeasuredColumns& measured,
    const std::vector<Eigen::Index>& session_starts,
    const std::vector<ColumnFault>& known);

}  // namespace errmap::data
