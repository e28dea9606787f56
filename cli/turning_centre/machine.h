#pragma once

#include <cstddef>

#include "cli/turning_centre/thermal_network.h"

namespace errmap::turning_centre {

/// The bodies of the turning centre. The spindle is at the left end of the bed,
/// and the Z slide's home at the right. The spindle head has the nose in front
/// and the pulley at the rear. The X column stands on the Z slide. Its right
/// face carries the vertical X ways and the X screw. On its left is the turret,
/// which the X slide carries.
enum Body : std::size_t {
  kBedLeftBottom,
  kBedLeftTop,
  kBedRightBottom,
  kBedRightTop,
  kZWayLeft,
  kZWayRight,
  kHeadFrontLower,
  kHeadFrontUpper,
  kHeadRearLower,
  kHeadRearUpper,
  kBearingFront,  // spindle bearing with its seat
  kBearingRear,
  kSpindle,
  kSpindleMotor,
  kZSlideLeft,
  kZSlideRight,
  kXColumnBottom,
  kXColumnTop,
  kXColumnLeft,  // its wall away from the ways and the drive
  kXWayBottom,
  kXWayTop,
  kXSlide,
  kXScrewTop,  // the X ball screw, in segments from its thrust bearing down
  kXScrewMiddle,
  kXScrewBottom,
  kXNut,
  kXBearing,  // thrust bearing of the X screw, beside the motor
  kXMotor,
  kZScrewLeft,
  kZScrewMiddle,
  kZScrewRight,
  kZNut,
  kZBearingLeft,
  kZBearingRight,  // thrust bearing of the Z screw, beside the motor
  kZMotor,
  kHydraulicTank,
  kCoolantTank,
  kNumBodies,
};

/// Activity of the machine during a phase.
struct DriveState {
  bool is_on = false;        // pumps and drives powered
  double spindle_rpm = 0.0;  // >= 0
  double x_duty = 0.0;       // share of the time in rapid traverse, 0 to 1
  double z_duty = 0.0;
  bool coolant = false;
  double cutting_load = 0.0;  // share of the spindle motor's power, 0 to 1
};

/// Heat capacities and conductances of the turning centre; model.md says where
/// each comes from. `air_factor` multiplies every conductance to the air (1:
/// the machine as described; a draughty shop has more). Throws
/// std::invalid_argument unless it is positive and finite.
ThermalNetwork MakeTurningCentreNetwork(double air_factor);

/// Returns the heat (W) into each body, the forced air and the coolant of a
/// phase.
ThermalLoad LoadOf(const DriveState& state);

}  // namespace errmap::turning_centre
