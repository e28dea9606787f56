#pragma once

#include <vector>

#include "data/measurements/column_faults.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {

/// Thermometers held against the others: those that step where no other moves
/// (kStep), that stay while the others change (kStuck), and noisy ones. Rows
/// count from 0.
std::vector<ColumnFault> FindThermometerFaults(
    const MeasuredColumns& measured,
    const std::vector<Thermometer>& thermometers);

}  // namespace errmap::data
