#pragma once

#include <vector>

#include "data/measurements/column_faults.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {

struct CellFaults {
  std::vector<ColumnFault> faults;  // rows from 0
  /// Temperature inputs that other columns can be compared with, without their
  /// faults.
  std::vector<Thermometer> thermometers;
};

/// Finds values that stand out by themselves (kImpossible, kOutlying). Then,
/// for thermometers, those that stand out from their neighbours (kJump).
CellFaults FindCellFaults(const MeasuredColumns& measured);

}  // namespace errmap::data
