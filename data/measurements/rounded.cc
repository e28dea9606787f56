#include "data/measurements/rounded.h"

#include <cmath>

#include <fmt/format.h>

namespace errmap::data {

std::string Rounded(double value) {
  const double size = std::abs(value);
  return size >= 100.0 && size < 1e6 ? fmt::format("{:.0f}", value)
                                     : fmt::format("{:.3g}", value);
}

}  // namespace errmap::data
