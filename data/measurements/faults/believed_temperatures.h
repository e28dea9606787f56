#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/column_faults.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {

/// Temperatures expected in a shop; thermometers outside this range are
/// examined.
inline constexpr double kColdest = -50.0;  // degC
inline constexpr double kHottest = 200.0;  // degC

/// True if temperatures outside the limits of a shop (`wrong`, rows from 0, not
/// empty) are plausible. The column must change slowly, without a gap between
/// these and its other values. No other unit may bring it closer to its
/// neighbours, or to a shop if it has none. If all its neighbours are within
/// the limits, it must also change, since an open input is noise about one
/// value.
bool AreBelieved(const MeasuredColumns& measured,
                 Eigen::Index input,
                 const std::vector<Eigen::Index>& wrong);

}  // namespace errmap::data
