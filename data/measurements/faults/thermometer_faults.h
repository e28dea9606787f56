#pragma once

#include <vector>

#include "data/measurements/column_faults.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {

/// Compares thermometers with the others. Finds those that step while no other
/// moves (kStep), those that stay constant while the others change (kStuck),
/// and noisy ones. Rows count from 0.
std::vector<ColumnFault> FindThermometerFaults(
    const MeasuredColumns& measured,
    const std::vector<Thermometer>& thermometers);

}  // namespace errmap::data
