#pragma once

#include <limits>

namespace errmap::stats {

/// A figure that is not known.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace errmap::stats
