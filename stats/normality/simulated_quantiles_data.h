#pragma once

#include <array>
#include <cstddef>

namespace errmap::stats::simulated {

inline constexpr std::size_t kNumSizes = 25;
inline constexpr std::size_t kNumLevels = 21;
inline constexpr std::size_t kNumStatistics = 4;

inline constexpr std::array<int, kNumSizes> kSizes = {
    4,  5,  6,  7,   8,   9,   10,  12,  14,  17,   20,   25,  30,
    40, 50, 70, 100, 150, 200, 300, 400, 600, 1000, 2000, 5000};

/// Probabilities of reaching the tabulated values, in descending order.
inline constexpr std::array<double, kNumLevels> kLevels = {
    0.999, 0.99, 0.975, 0.95, 0.9,   0.8,  0.7,   0.6,  0.5,   0.4,  0.3,
    0.25,  0.2,  0.15,  0.1,  0.075, 0.05, 0.025, 0.01, 0.005, 0.001};

using Quantiles = std::array<double, kNumLevels>;

/// Indexed by SimulatedStatistic, then size; written by
/// tests/stats/normality/simulate_null_tables.cc.
extern const std::array<std::array<Quantiles, kNumSizes>, kNumStatistics>
    kTables;

}  // namespace errmap::stats::simulated
