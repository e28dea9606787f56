#pragma once

#include <vector>

#include "data/measurements/column_faults.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {

struct CellFaults {
  std::vector<ColumnFault> faults;  // rows from 0
  /// Temperature inputs that can be gone by, what is wrong in them apart.
  std::vector<Thermometer> thermometers;
};

/// Values that stand out by themselves (kImpossible, kOutlying), then, of
/// thermometers, by their neighbours (kJump).
CellFaults FindCellFaults(const MeasuredColumns& measured);

}  // namespace errmap::data
