#pragma once

#include <limits>

namespace errmap::stats {

/// An unknown figure.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace errmap::stats
