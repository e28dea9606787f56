#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "stats/eigen.h"

namespace errmap::stats {

/// Random numbers that are the same with every standard library: the engine is
/// the standard mt19937_64, the mappings are our own.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Returns a uniform value in [0, 1), from the upper 53 bits.
  double Uniform() {
    constexpr double kUnit = 0x1.0p-53;
    return static_cast<double>(engine_() >> 11) * kUnit;
  }

  /// Returns a uniform value in (0, 1): the middle of the step in which
  /// Uniform() lies, so that its quantiles are finite.
  double OpenUniform() {
    constexpr double kHalfStep = 0x1.0p-54;
    // The middle of the last step rounds to 1.
    constexpr double kLast = 1.0 - 0x1.0p-53;
    return std::min(Uniform() + kHalfStep, kLast);
  }

  /// Returns a standard normal value: the quantile of OpenUniform().
  double Normal();

  /// Returns a uniform integer below `bound` > 0, without bias (rejection).
  std::uint64_t Below(std::uint64_t bound) {
    // The largest multiple of bound that fits: draws above it are unfair.
    const std::uint64_t unfair = (0 - bound) % bound;
    std::uint64_t draw = engine_();
    while (draw < unfair) draw = engine_();
    return draw % bound;
  }

  /// Shuffles `items` (Fisher-Yates).
  template <typename T>
  void Shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) {
      std::swap(items[i - 1], items[static_cast<std::size_t>(Below(i))]);
    }
  }

 private:
  std::mt19937_64 engine_;
};

/// Returns n independent standard normal values.
VectorXd NormalSample(Index n, Random* random);

/// Returns n values of mean 0 and variance 1 of a stationary first-order
/// autoregression with coefficient `memory`, between -1 and 1.
VectorXd AutoregressionSample(Index n, double memory, Random* random);

}  // namespace errmap::stats
