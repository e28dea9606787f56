#pragma once

#include <cstddef>

namespace errmap::models {

/// Where a program stores a value.
enum class Space {
  kReading,   // an input as the sensor gives it
  kTime,      // seconds since the step before
  kState,     // kept from step to step: filters and zeros
  kGain,      // of the filters of one time constant, in this step: two each
  kDerived,   // computed from readings and state
  kForm,      // an input of the form, clipped
  kScaled,    // the same, scaled for a member
  kHidden,    // hidden nodes of a net
  kTerm,      // partial sums of a polynomial, output of a net
  kError,     // the predicted error
  kStanding,  // sensors minus their trained means
  kScore,     // coordinates of their joint thermal state
  kDoubt,     // how far each reading is from what the others suggest
};
inline constexpr std::size_t kNumSpaces = 13;

/// Time, gains, states and values derived from them stay double even in a
/// single-precision program: in single precision a slow filter stops moving.
/// The checks stay double too, since they must not depend on the precision.
constexpr bool IsAlwaysDouble(Space space) {
  return space == Space::kTime || space == Space::kState ||
         space == Space::kGain || space == Space::kDerived ||
         space == Space::kStanding || space == Space::kScore ||
         space == Space::kDoubt;
}

struct Operand {
  Space space = Space::kError;
  int index = 0;

  bool operator==(const Operand&) const = default;
};

}  // namespace errmap::models
