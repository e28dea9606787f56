#include "data/measurements/rounded.h"

#include <array>
#include <charconv>
#include <cmath>

namespace errmap::data {

std::string Rounded(double value) {
  constexpr double kWholeFrom = 100.0;
  constexpr double kExponentFrom = 1e6;
  const double size = std::abs(value);
  const bool whole = size >= kWholeFrom && size < kExponentFrom;
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(),
                                 text.data() + text.size(),
                                 value,
                                 whole ? std::chars_format::fixed
                                       : std::chars_format::general,
                                 whole ? 0 : 3)
                       .ptr;
  return {text.data(), end};
}

}  // namespace errmap::data
