#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/column_faults.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {

/// Degrees in a shop; beyond these a thermometer is looked at.
inline constexpr double kColdest = -50.0;  // degC
inline constexpr double kHottest = 200.0;  // degC

/// Whether it really was that cold or hot: a column of temperatures, some or
/// all of which (`wrong`, rows from 0, not empty) are beyond the bounds of a
/// shop, changes slowly and has no gap between these and the others; and no
/// other unit would put it among its like (of a shop, where it has none). One
/// that stands alone among others within the bounds has to change, too: an open
/// input is noise about one value.
bool AreBelieved(const MeasuredColumns& measured,
                 Eigen::Index input,
                 const std::vector<Eigen::Index>& wrong);

}  // namespace errmap::data
