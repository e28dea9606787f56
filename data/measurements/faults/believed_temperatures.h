#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/column_faults.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {

/// Temperatures expected in a shop; a thermometer beyond them is examined.
inline constexpr double kColdest = -50.0;  // degC
inline constexpr double kHottest = 200.0;  // degC

/// True if it really was that cold or hot. A column of temperatures, some or
/// all of which (`wrong`, rows from 0, not empty) are outside the limits of a
/// shop, is believed if it changes slowly without a gap between these and the
/// others. No other unit may bring it closer to its neighbours, or to a shop if
/// it has none. A column whose neighbours are all within the limits must also
/// change: an open input is noise about one value.
bool AreBelieved(const MeasuredColumns& measured,
                 Eigen::Index input,
                 const std::vector<Eigen::Index>& wrong);

}  // namespace errmap::data
