#include "cli/turning_centre/component_errors.h"

#include <algorithm>
#include <cassert>

#include "cli/turning_centre/day_programme.h"
#include "cli/turning_centre/portable_math.h"

namespace errmap::turning_centre {
namespace {

constexpr double kUradPerRad = 1e6;

// First and last stop of a sweep, mm.
constexpr double kXFirst = -kXStep;
constexpr double kXLast = -kXStep * kStopsPerSweep;
constexpr double kZFirst = -kZStep;
constexpr double kZLast = -kZStep * kStopsPerSweep;

// Heights and lengths of the structure in mm; model.md gives the reasons.
constexpr double kThrustBearing = 80.0;  // of both screws, beyond home
constexpr double kZSlideHeight = 450.0;
constexpr double kXColumnHeight = 590.0;
// The spindle axis above the bed. Together the three lift the X screw's
// thrust bearing to 386 + 80 mm above the spindle axis.
constexpr double kAxisHeight =
    kZSlideHeight + kXColumnHeight - (kXHomeHeight + kThrustBearing);
constexpr double kXColumnDepth = 150.0;  // left to right wall
constexpr double kXAbbeArm = 450.0;      // from the X screw left to the turret
constexpr double kBedHeight = 450.0;
constexpr double kBedLength = 1200.0;
constexpr double kZSlideLength = 400.0;
constexpr double kBearingSpan = 400.0;   // of the spindle
constexpr double kNoseOverhang = 120.0;  // beyond the front bearing
constexpr double kHeadFoot = 30.0;       // front bearing beyond the foot
constexpr double kHeadHalfWidth = 160.0;

double Mean(double a, double b) { return 0.5 * (a + b); }

// Mean rise of the bed below the head, which carries the frame of reference.
double BedAtNose(const TemperatureRise& rise) { return rise[kBedLeftTop]; }

// Integral of a screw's temperature rise from `position` up to the thrust
// bearing, K mm; segments of equal temperature end at these positions.
double ScrewRise(double position,
                 const std::array<double, 3>& segment_rise,
                 const std::array<double, 3>& segment_end) {
  double sum = 0.0;
  double upper = kThrustBearing;
  for (std::size_t i = 0; i < segment_rise.size(); ++i) {
    const double lower = std::max(segment_end[i], position);
    if (upper > lower) sum += (upper - lower) * segment_rise[i];
    upper = std::min(upper, segment_end[i]);
  }
  return sum;
}

// Curvatures in 1/mm, the difference in expansion over the depth.

double XColumnCurvature(const TemperatureRise& rise) {
  const double right = Mean(Mean(rise[kXWayBottom], rise[kXWayTop]),
                            Mean(rise[kXColumnBottom], rise[kXColumnTop]));
  return kExpansion * (right - rise[kXColumnLeft]) / kXColumnDepth;
}

double BedCurvature(const TemperatureRise& rise) {
  const double top = 0.25 * (rise[kBedLeftTop] + rise[kBedRightTop] +
                             rise[kZWayLeft] + rise[kZWayRight]);
  const double bottom = Mean(rise[kBedLeftBottom], rise[kBedRightBottom]);
  return kExpansion * (top - bottom) / kBedHeight;
}

double XDisplacement(double x, const TemperatureRise& rise) {
  // The nut hangs on the screw below its thrust bearing, which the Z slide
  // and the X column lift; the spindle axis itself is carried by the bed.
  const double screw =
      ScrewRise(x,
                {rise[kXScrewTop], rise[kXScrewMiddle], rise[kXScrewBottom]},
                {-40.0, -160.0, -400.0});
  const double lift =
      kZSlideHeight * Mean(rise[kZSlideLeft], rise[kZSlideRight]) +
      kXColumnHeight * Mean(rise[kXColumnBottom], rise[kXColumnTop]) -
      kAxisHeight * BedAtNose(rise);
  // The column bends about Y as its right warms; the turret, on the cold side,
  // is an Abbe arm away from the screw: its travel shrinks.
  const double abbe = -kXAbbeArm * XColumnCurvature(rise) * x;
  return kExpansion * (lift - screw) + abbe;
}

double ZDisplacement(double z, const TemperatureRise& rise) {
  // The thrust bearing sits on the right of the bed, which grows away from
  // the nose.
  const double screw =
      ScrewRise(z,
                {rise[kZScrewRight], rise[kZScrewMiddle], rise[kZScrewLeft]},
                {-120.0, -300.0, -800.0});
  const double bed = (kZHomeDistance + kThrustBearing) *
                     Mean(rise[kBedLeftTop], rise[kBedRightTop]);
  return kExpansion * (bed - screw);
}

// Parabola of a bent way, measured from the line through the ends.
double Sagitta(double curvature, double position, double first, double last) {
  return 0.5 * curvature * (position - first) * (position - last);
}

double Orthogonality(const TemperatureRise& rise) {
  // The column leans to the left as the right of the Z slide grows; the end
  // points of its bent ways add the slope at mid-travel.
  const double lean = kExpansion * kZSlideHeight *
                      (rise[kZSlideRight] - rise[kZSlideLeft]) / kZSlideLength;
  return lean + XColumnCurvature(rise) * Mean(kXFirst, kXLast);
}

double Parallelism(const TemperatureRise& rise) {
  // The right end of the bed rises above the left; likewise the slope of the
  // bent ways at mid-travel.
  const double left = Mean(rise[kBedLeftTop], rise[kBedLeftBottom]);
  const double right = Mean(rise[kBedRightTop], rise[kBedRightBottom]);
  return kExpansion * kBedHeight * (right - left) / kBedLength -
         BedCurvature(rise) * Mean(kZFirst, kZLast);
}

// The spindle head carries the axis on its lower half and a part of the
// upper one.
double HeadRise(double lower, double upper) {
  constexpr double kShareOfLower = 0.7;
  return kShareOfLower * lower + (1.0 - kShareOfLower) * upper;
}

double HeadFrontRise(const TemperatureRise& rise) {
  return HeadRise(rise[kHeadFrontLower], rise[kHeadFrontUpper]);
}

double HeadRearRise(const TemperatureRise& rise) {
  return HeadRise(rise[kHeadRearLower], rise[kHeadRearUpper]);
}

// The motor warms its side of the head: a part of the motor's own rise.
double HeadSideGradient(double head_rise, const TemperatureRise& rise) {
  constexpr double kShareOfMotor = 0.05;
  return kShareOfMotor * (rise[kSpindleMotor] - head_rise);
}

// The machine at 20 degC throughout, moving forward: lead error, ways.
double GeometricError(Component component, double position) {
  // Lengths in units of 100 mm keep the coefficients readable (um, urad).
  constexpr double kMmPerUm = 1e-3;
  const double u = position / 100.0;
  switch (component) {
    case Component::kXDisplacement:
      // Fitted to the report's surface: model.md, Calibration.
      return kMmPerUm * (-11.601 + u * (15.567 + u * (2.893 - 0.127 * u)));
    case Component::kXStraightness:
      return kMmPerUm * 0.8 * SinOfTurns(position / 260.0);
    case Component::kXYaw:
      return u * (-3.0 + 1.2 * u);
    case Component::kZDisplacement:
      return kMmPerUm * (2.0 + u * (-4.5 + u * (-0.9 - 0.15 * u)));
    case Component::kZStraightness:
      return kMmPerUm * (1.4 * SinOfTurns(position / 500.0) +
                         0.5 * SinOfTurns(position / 170.0));
    case Component::kZYaw:
      return u * (2.2 + u * (0.9 + 0.1 * u));
    case Component::kParallelism:
      return 8.0;
    case Component::kOrthogonality:
      return -15.0;
    case Component::kSpindleAxial:
    case Component::kSpindleRadialX:
    case Component::kSpindleRadialY:
    case Component::kSpindleTiltXz:
    case Component::kSpindleTiltYz:
      // The cold spindle defines the frame.
      return 0.0;
  }
  assert(false);
  return 0.0;
}

// What motion in `direction` adds: 0 forward; in reverse the backlash and the
// wind-up of the screw between its thrust bearing and the nut.
double ReversalError(Component component,
                     double position,
                     Direction direction) {
  if (direction == Direction::kForward) return 0.0;
  // The slide lags behind: coming up (or from the left) it stops below (left
  // of) where it stops coming down. Backlash of nut and bearing in mm, and
  // torsion of the screw under friction in mm per mm of its free length.
  double backlash = 0.0;
  double wind_up = 0.0;
  if (component == Component::kXDisplacement) {
    backlash = 0.0028;
    wind_up = 4.0e-6;
  } else if (component == Component::kZDisplacement) {
    backlash = 0.0035;
    wind_up = 3.0e-6;
  } else {
    return 0.0;
  }
  return -(backlash + wind_up * (kThrustBearing - position));
}

}  // namespace

const ComponentTraits& TraitsOf(Component component) {
  static constexpr std::array<ComponentTraits, kComponents.size()> kTraits = {{
      // clang-format off
      {"x_displacement",   "EXX",  Slide::kX,    false, true,  "the X slide stands too far up, away from the spindle axis"},
      {"x_straightness",   "EZX",  Slide::kX,    false, false, "the X slide stands too far right, away from the spindle head"},
      {"x_yaw",            "EBX",  Slide::kX,    true,  false, "the X slide is turned about Y from Z towards X"},
      {"z_displacement",   "EZZ",  Slide::kZ,    false, true,  "the Z slide stands too far right, away from the spindle head"},
      {"z_straightness",   "EXZ",  Slide::kZ,    false, false, "the Z slide stands too high, away from the spindle axis"},
      {"z_yaw",            "EBZ",  Slide::kZ,    true,  false, "the Z slide is turned about Y from Z towards X"},
      {"parallelism",      "EB0Z", Slide::kNone, true,  false, "the line of the Z slide rises from the spindle head to the right"},
      {"orthogonality",    "EB0X", Slide::kNone, true,  false, "the line of the X slide leans left with height"},
      {"spindle_axial",    "EZ0C", Slide::kNone, false, false, "the spindle nose has grown out of the head"},
      {"spindle_radial_x", "EX0C", Slide::kNone, false, false, "the spindle nose has risen"},
      {"spindle_radial_y", "EY0C", Slide::kNone, false, false, "the spindle nose has moved along Y, away from the motor"},
      {"spindle_tilt_xz",  "EB0C", Slide::kNone, true,  false, "the spindle axis rises towards the tool"},
      {"spindle_tilt_yz",  "EA0C", Slide::kNone, true,  false, "the spindle axis is turned about X from Y towards Z"},
      // clang-format on
  }};
  return kTraits[static_cast<std::size_t>(component)];
}

TemperatureRise RiseOf(const std::vector<double>& temperatures) {
  constexpr double kReferenceTemperature = 20.0;
  assert(temperatures.size() == kNumBodies);
  TemperatureRise rise{};
  for (std::size_t i = 0; i < kNumBodies; ++i) {
    rise[i] = temperatures[i] - kReferenceTemperature;
  }
  return rise;
}

double ThermalError(Component component,
                    double position,
                    const TemperatureRise& rise) {
  switch (component) {
    case Component::kXDisplacement:
      return XDisplacement(position, rise);
    case Component::kXStraightness:
      return -Sagitta(XColumnCurvature(rise), position, kXFirst, kXLast);
    case Component::kXYaw:
      return kUradPerRad * XColumnCurvature(rise) * position;
    case Component::kZDisplacement:
      return ZDisplacement(position, rise);
    case Component::kZStraightness:
      return -Sagitta(BedCurvature(rise), position, kZFirst, kZLast);
    case Component::kZYaw:
      return -kUradPerRad * BedCurvature(rise) * position;
    case Component::kParallelism:
      return kUradPerRad * Parallelism(rise);
    case Component::kOrthogonality:
      return kUradPerRad * Orthogonality(rise);
    case Component::kSpindleAxial:
      return kExpansion *
             (kNoseOverhang * rise[kSpindle] + kHeadFoot * rise[kBearingFront] -
              (kNoseOverhang + kHeadFoot) * BedAtNose(rise));
    case Component::kSpindleRadialX:
      return kExpansion * kAxisHeight * (HeadFrontRise(rise) - BedAtNose(rise));
    case Component::kSpindleRadialY:
      return kExpansion * kHeadHalfWidth *
             HeadSideGradient(HeadFrontRise(rise), rise);
    case Component::kSpindleTiltXz:
      return kUradPerRad * kExpansion * kAxisHeight *
             (HeadFrontRise(rise) - HeadRearRise(rise)) / kBearingSpan;
    case Component::kSpindleTiltYz:
      // The motor sits at the rear and moves that end along Y.
      return kUradPerRad * kExpansion * kHeadHalfWidth *
             HeadSideGradient(HeadRearRise(rise), rise) / kBearingSpan;
  }
  assert(false);
  return 0.0;
}

double TrueError(Component component,
                 double position,
                 Direction direction,
                 const TemperatureRise& rise) {
  return GeometricError(component, position) +
         ThermalError(component, position, rise) +
         ReversalError(component, position, direction);
}

ToolTipError ToolTipErrorAt(double x,
                            Direction x_direction,
                            double z,
                            Direction z_direction,
                            const TemperatureRise& rise) {
  const auto length = [&](Component component,
                          double position = 0.0,
                          Direction direction = Direction::kForward) {
    return TrueError(component, position, direction, rise);
  };
  const auto angle = [&](Component component, double position = 0.0) {
    return TrueError(component, position, Direction::kForward, rise) /
           kUradPerRad;
  };
  // A turn b about Y moves a point at (rx, rz) from its pivot by (b rz, -b rx).
  const double height = kXHomeHeight + x;  // nominal X of the tool tip
  const double slide_z = kZHomeDistance + z;
  const double tip_z = slide_z + kToolTipZ;
  ToolTipError error;
  // From the bed to the tool. Frames: at the origin, at the Z slide's measuring
  // point (at the height of the spindle axis), and on the X slide.
  const double b0z = angle(Component::kParallelism);
  error.x += b0z * tip_z;
  error.z -= b0z * height;
  error.x += length(Component::kZStraightness, z);
  error.z += length(Component::kZDisplacement, z, z_direction);
  const double from_z_slide =
      angle(Component::kZYaw, z) + angle(Component::kOrthogonality);
  error.x += from_z_slide * kToolTipZ;
  error.z -= from_z_slide * height;
  error.x += length(Component::kXDisplacement, x, x_direction);
  error.z += length(Component::kXStraightness, x);
  error.x += angle(Component::kXYaw, x) * kToolTipZ;
  // Work's branch: the spindle carries the work point there.
  error.x -= length(Component::kSpindleRadialX) +
             angle(Component::kSpindleTiltXz) * tip_z;
  error.y -= length(Component::kSpindleRadialY) -
             angle(Component::kSpindleTiltYz) * tip_z;
  error.z -= length(Component::kSpindleAxial) -
             angle(Component::kSpindleTiltXz) * height;
  return error;
}

}  // namespace errmap::turning_centre
