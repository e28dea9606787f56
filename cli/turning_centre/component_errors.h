#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "cli/turning_centre/machine.h"

namespace errmap::turning_centre {

/// The error components of NISTIR 5367, section 3.3 and Fig. 1. Axes: the
/// origin lies on the spindle axis at the nose; X points up, away from the
/// spindle axis, Z along it away from the spindle head, Y completes the
/// right-handed frame. Every error is actual - nominal in this frame, which
/// is fixed to the bed below the nose; angles are positive by the right-hand
/// rule.
enum class Component {
  kXDisplacement,   // EXX: X slide along X
  kXStraightness,   // EZX: X slide along Z, from the line through its ends
  kXYaw,            // EBX: X slide about Y, against its home
  kZDisplacement,   // EZZ: Z slide along Z
  kZStraightness,   // EXZ: Z slide along X, from the line through its ends
  kZYaw,            // EBZ: Z slide about Y, against its home
  kParallelism,     // EB0Z: line of Z against the cold spindle axis, about Y
  kOrthogonality,   // EB0X: line of X against its square to that, about Y
  kSpindleAxial,    // EZ0C: spindle nose along Z
  kSpindleRadialX,  // EX0C: spindle nose along X
  kSpindleRadialY,  // EY0C: spindle nose along Y
  kSpindleTiltXz,   // EB0C: spindle axis about Y, a tilt in the XZ plane
  kSpindleTiltYz,   // EA0C: spindle axis about X, a tilt in the YZ plane
};

/// All of them, in order.
inline constexpr auto kComponents = [] {
  std::array<Component, 13> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = Component(i);
  return all;
}();

/// The slide on whose position a component depends.
enum class Slide { kNone, kX, kZ };

/// Forward is away from home, towards the work: X downwards, Z to the left.
enum class Direction { kForward, kReverse };

/// Fixed properties of a component.
struct ComponentTraits {
  std::string_view stem;     // of file names: "x_displacement"
  std::string_view letters;  // of ISO 230-1, as machine.toml names it: "EXX"
  Slide slide;
  bool is_angle;             // urad, else mm
  bool has_direction;        // forward and reverse differ
  std::string_view meaning;  // what a positive error means
};

const ComponentTraits& TraitsOf(Component component);

/// Geometry of the slides, mm. Positions are 0 at home and negative towards
/// the work.
inline constexpr double kXStep = 12.7;  // NISTIR 5367, section 9.1
inline constexpr double kZStep = 25.4;
inline constexpr double kXHomeHeight = 386.0;    // above the axis; ibid.
inline constexpr double kZHomeDistance = 600.0;  // from the nose
/// Tool tip from the measuring point of the X slide, along Z.
inline constexpr double kToolTipZ = -120.0;

/// Expansion coefficient of steel and of the bed's cast iron, 1/K.
inline constexpr double kExpansion = 11.5e-6;

/// Temperatures of the bodies above 20 degC, the reference of ISO 1, in K.
using TemperatureRise = std::array<double, kNumBodies>;
TemperatureRise RiseOf(const std::vector<double>& temperatures);

// Each returns mm, or urad for an angle; `position` (mm) is that of the
// component's slide and is ignored if it has none.

/// The error due to temperatures; 0 if all rises are 0.
double ThermalError(Component component,
                    double position,
                    const TemperatureRise& rise);

/// The sum of the error at 20 degC throughout, that due to temperatures, and
/// that due to motion in reverse.
double TrueError(Component component,
                 double position,
                 Direction direction,
                 const TemperatureRise& rise);

/// Position of the tool tip relative to the work; error vector in mm.
struct ToolTipError {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

/// Returns the sum of the components along the chain bed - parallelism - Z
/// slide - orthogonality - X slide - tool, less bed - spindle, to first order
/// in the errors (NISTIR 5367, Eq. 5 and 6); the second order is some 1e-6 mm.
ToolTipError ToolTipErrorAt(double x,
                            Direction x_direction,
                            double z,
                            Direction z_direction,
                            const TemperatureRise& rise);

}  // namespace errmap::turning_centre
