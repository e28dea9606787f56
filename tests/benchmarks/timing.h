#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

// Times of benchmarks on a machine that is not theirs alone.

namespace errmap::testing {

/// Of many times the lower quartile is that of the work itself.
inline double LowerQuartile(std::vector<double> times) {
  const auto quarter =
      times.begin() + static_cast<std::ptrdiff_t>(times.size() / 4);
  std::ranges::nth_element(times, quarter);
  return *quarter;
}

inline double Median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half]
                                : (values[half - 1] + values[half]) / 2.0;
}

inline double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace errmap::testing
