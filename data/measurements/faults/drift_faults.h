#pragma once

#include <optional>
#include <vector>

#include "data/measurements/column_faults.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {

/// Thermometers that leave the others more from session to session
/// (kDrifting), the worst first. Those that `known` distrusts as a whole are
/// left out.
std::vector<ColumnFault> FindDrift(const MeasuredColumns& measured,
                                   const std::vector<Thermometer>& thermometers,
                                   const std::vector<ColumnFault>& known);

/// The thermometer that, where sessions begin (rows from 0), leaves the mean of
/// the others by more from session to session: told of those too unlike for
/// FindDrift, from four sessions on.
std::optional<ColumnFault> FindColdDrift(
    const MeasuredColumns& measured,
    const std::vector<Eigen::Index>& session_starts,
    const std::vector<ColumnFault>& known);

}  // namespace errmap::data
