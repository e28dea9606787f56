#pragma once

#include <cstddef>

namespace errmap::models {

/// Where a number of a program lives.
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
  kStanding,  // sensors less their trained means
  kScore,     // of the thermal state that they tell together
  kDoubt,     // how far each reading is from what others tell
};
inline constexpr std::size_t kNumSpaces = 13;

/// Time, gains, states and what is derived from them stay double where all else
/// is single: in single precision a slow filter stands still. So do the checks,
/// which must not depend on it.
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
