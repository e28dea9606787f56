#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace errmap::stats {

/// Random numbers that are the same with every standard library: the engine is
/// the standard's mt19937_64, the mappings are ours.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1): the upper 53 bits.
  double Uniform() {
    constexpr double kUnit = 0x1.0p-53;
    return static_cast<double>(engine_() >> 11) * kUnit;
  }

  /// Uniform in 0 .. bound-1 without bias (rejection); bound > 0.
  std::uint64_t Below(std::uint64_t bound) {
    // The largest multiple of bound that fits: draws above it are unfair.
    const std::uint64_t unfair = (0 - bound) % bound;
    std::uint64_t draw = engine_();
    while (draw < unfair) draw = engine_();
    return draw % bound;
  }

  /// Fisher-Yates.
  template <typename T>
  void Shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) {
      std::swap(items[i - 1], items[static_cast<std::size_t>(Below(i))]);
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace errmap::stats
