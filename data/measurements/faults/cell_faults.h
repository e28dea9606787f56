#pragma once

#include <vector>

#include "data/measurements/column_faults.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {

struct CellFaults {
  std::vector<ColumnFault> faults;  // rows from 0
  /// Temperature inputs for comparison with other columns, without their
  /// faults.
  std::vector<Thermometer> thermometers;
};

/// Finds single values that stand out (kImpossible, kOutlying). Then, for
/// thermometers, finds values that differ from their neighbours (kJump).
CellFaults FindCellFaults(const MeasuredColumns& measured);

}  // namespace errmap::data
