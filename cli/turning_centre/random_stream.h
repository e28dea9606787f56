#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "cli/turning_centre/portable_math.h"

namespace errmap::turning_centre {

/// Purpose of a stream of random numbers. Each purpose has its own stream. So
/// more sensor noise does not change the day programmes, and an added day does
/// not change earlier days.
enum class Purpose : std::uint64_t {
  kProgramme = 1,
  kSensorErrors = 2,
  kSensorNoise = 3,
  kReadingNoise = 4,
  kToolTipPoints = 5,
  kLogNoise = 6,
};

/// Random numbers that are the same with every standard library and machine.
/// The engine is mt19937_64 of the standard; the mappings are our own.
class RandomStream {
 public:
  /// Stream of (seed, purpose, index); different ones are unrelated.
  RandomStream(std::uint64_t seed, Purpose purpose, std::uint64_t index)
      : engine_(Mixed(Mixed(Mixed(seed) + static_cast<std::uint64_t>(purpose)) +
                      index)) {}

  /// Uniform in [0, 1): the upper 53 bits.
  double Uniform() {
    constexpr double kUnit = 0x1.0p-53;
    return static_cast<double>(engine_() >> 11U) * kUnit;
  }

  double Uniform(double low, double high) {
    return low + (high - low) * Uniform();
  }

  /// Uniform in 0 .. bound-1; bound > 0 and small (bias below bound / 2^53).
  int Below(int bound) { return static_cast<int>(Uniform() * bound); }

  /// Standard normal deviate (Box and Muller 1958, the cosine alone).
  double Normal() {
    const double u = 1.0 - Uniform();  // never 0
    const double turns = Uniform();
    return std::sqrt(-2.0 * PortableLog(u)) * CosOfTurns(turns);
  }

 private:
  // SplitMix64 (Steele, Lea and Flood 2014): spreads neighbouring seeds.
  static std::uint64_t Mixed(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15U;
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
    return x ^ (x >> 31U);
  }

  std::mt19937_64 engine_;
};

}  // namespace errmap::turning_centre
