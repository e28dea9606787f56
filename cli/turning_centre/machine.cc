#include "cli/turning_centre/machine.h"

#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace errmap::turning_centre {
namespace {

constexpr double kCastIron = 500.0;  // J/(kg K)
constexpr double kSteel = 460.0;
constexpr double kOil = 1900.0;
constexpr double kWater = 4180.0;

// Heat capacity as mass in kg times specific heat in J/(kg K), and conductance
// to the air in W/K: area times 8 to 12 W/(m2 K), free convection with
// radiation; the last number is what the turning spindle's wind adds at
// 1000 rpm.
std::vector<ThermalBody> Bodies() {
  return {
      {"bed_left_bottom", 350.0 * kCastIron, 9.0},
      {"bed_left_top", 250.0 * kCastIron, 7.0},
      {"bed_right_bottom", 350.0 * kCastIron, 9.0},
      {"bed_right_top", 250.0 * kCastIron, 8.0},
      {"z_way_left", 40.0 * kSteel, 2.0},
      {"z_way_right", 40.0 * kSteel, 2.5},
      {"head_front_lower", 60.0 * kCastIron, 2.5},
      {"head_front_upper", 60.0 * kCastIron, 4.0},
      {"head_rear_lower", 60.0 * kCastIron, 2.5},
      {"head_rear_upper", 60.0 * kCastIron, 4.0},
      {"bearing_front", 10.0 * kSteel, 0.5},
      {"bearing_rear", 8.0 * kSteel, 0.5},
      {"spindle", 45.0 * kSteel, 1.0, 1.5},
      {"spindle_motor", 80.0 * kSteel, 9.0, 3.0},
      {"z_slide_left", 80.0 * kCastIron, 3.0},
      {"z_slide_right", 80.0 * kCastIron, 3.5},
      {"x_column_bottom", 60.0 * kCastIron, 2.5},
      {"x_column_top", 50.0 * kCastIron, 3.0},
      {"x_column_left", 90.0 * kCastIron, 8.0},
      {"x_way_bottom", 12.0 * kSteel, 0.8},
      {"x_way_top", 12.0 * kSteel, 0.8},
      {"x_slide", 95.0 * kCastIron, 7.0},
      {"x_screw_top", 1.8 * kSteel, 0.35},
      {"x_screw_middle", 1.8 * kSteel, 0.35},
      {"x_screw_bottom", 1.8 * kSteel, 0.35},
      {"x_nut", 4.0 * kSteel, 0.3},
      {"x_bearing", 4.5 * kSteel, 0.4},
      {"x_motor", 12.0 * kSteel, 2.5},
      {"z_screw_left", 3.4 * kSteel, 0.6},
      {"z_screw_middle", 3.4 * kSteel, 0.6},
      {"z_screw_right", 3.4 * kSteel, 0.6},
      {"z_nut", 5.0 * kSteel, 0.3},
      {"z_bearing_left", 4.0 * kSteel, 0.3},
      {"z_bearing_right", 5.0 * kSteel, 0.4},
      {"z_motor", 16.0 * kSteel, 3.0},
      {"hydraulic_tank", 55.0 * kOil, 11.0},
      {"coolant_tank", 150.0 * kWater, 16.0},
  };
}

// Conductances in W/K: solid sections k A / L (cast iron 50, steel 45
// W/(m K)), bolted and sliding joints 500 to 2000 W/(m2 K) times their area.
const std::vector<ThermalLink>& Links() {
  static const std::vector<ThermalLink> kLinks = {
      {kBedLeftBottom, kBedLeftTop, 25.0},
      {kBedRightBottom, kBedRightTop, 25.0},
      {kBedLeftBottom, kBedRightBottom, 6.0},
      {kBedLeftTop, kBedRightTop, 6.0},
      {kZWayLeft, kBedLeftTop, 40.0},
      {kZWayRight, kBedRightTop, 40.0},
      {kZWayLeft, kZWayRight, 1.0},
      {kHeadFrontLower, kBedLeftTop, 12.0},
      {kHeadRearLower, kBedLeftTop, 12.0},
      {kHeadFrontLower, kHeadFrontUpper, 22.0},
      {kHeadRearLower, kHeadRearUpper, 22.0},
      {kHeadFrontLower, kHeadRearLower, 8.0},
      {kHeadFrontUpper, kHeadRearUpper, 8.0},
      {kBearingFront, kHeadFrontLower, 14.0},
      {kBearingFront, kHeadFrontUpper, 14.0},
      {kBearingRear, kHeadRearLower, 11.0},
      {kBearingRear, kHeadRearUpper, 11.0},
      {kBearingFront, kSpindle, 6.0},
      {kBearingRear, kSpindle, 5.0},
      {kSpindleMotor, kHeadRearLower, 3.0},
      {kZSlideLeft, kZSlideRight, 15.0},
      {kZSlideLeft, kZWayLeft, 5.0},
      {kZSlideLeft, kZWayRight, 5.0},
      {kZSlideRight, kZWayLeft, 3.0},
      {kZSlideRight, kZWayRight, 7.0},
      {kXColumnBottom, kZSlideLeft, 9.0},
      {kXColumnBottom, kZSlideRight, 9.0},
      {kXColumnBottom, kXColumnTop, 9.0},
      {kXColumnLeft, kXColumnBottom, 2.0},
      {kXColumnLeft, kXColumnTop, 2.0},
      {kXColumnLeft, kZSlideRight, 2.0},
      {kXWayBottom, kXColumnBottom, 4.0},
      {kXWayTop, kXColumnTop, 4.0},
      {kXWayBottom, kXWayTop, 0.5},
      {kXSlide, kXWayBottom, 3.0},
      {kXSlide, kXWayTop, 4.0},
      {kXScrewTop, kXScrewMiddle, 0.3},
      {kXScrewMiddle, kXScrewBottom, 0.3},
      {kXScrewTop, kXBearing, 0.6},
      {kXNut, kXScrewTop, 0.8},
      {kXNut, kXScrewMiddle, 1.2},
      {kXNut, kXScrewBottom, 0.8},
      {kXNut, kXSlide, 9.0},
      {kXBearing, kXColumnTop, 9.0},
      {kXMotor, kXBearing, 1.5},
      {kXMotor, kXColumnTop, 2.5},
      {kZScrewLeft, kZScrewMiddle, 0.3},
      {kZScrewMiddle, kZScrewRight, 0.3},
      {kZScrewLeft, kZBearingLeft, 0.8},
      {kZScrewRight, kZBearingRight, 0.8},
      {kZNut, kZScrewLeft, 1.0},
      {kZNut, kZScrewMiddle, 1.4},
      {kZNut, kZScrewRight, 1.4},
      {kZNut, kZSlideRight, 10.0},
      {kZBearingLeft, kBedLeftTop, 10.0},
      {kZBearingRight, kBedRightTop, 10.0},
      {kZMotor, kZBearingRight, 1.5},
      {kZMotor, kBedRightTop, 3.0},
      {kHydraulicTank, kBedLeftBottom, 3.0},
      {kHydraulicTank, kHeadRearLower, 2.0},
      // Splashed by coolant, or drained over.
      {kCoolantTank, kXSlide, 12.0, true},
      {kCoolantTank, kZSlideLeft, 14.0, true},
      {kCoolantTank, kZWayLeft, 8.0, true},
      {kCoolantTank, kBedLeftTop, 10.0, true},
      {kCoolantTank, kBedRightTop, 5.0, true},
      {kCoolantTank, kHeadFrontLower, 6.0, true},
  };
  return kLinks;
}

}  // namespace

ThermalNetwork MakeTurningCentreNetwork(double air_factor) {
  if (!std::isfinite(air_factor) || air_factor <= 0.0) {
    throw std::invalid_argument(
        "MakeTurningCentreNetwork: air_factor " + std::to_string(air_factor) +
        "; conductances to the air need a positive, finite factor");
  }
  std::vector<ThermalBody> bodies = Bodies();
  assert(bodies.size() == kNumBodies);
  for (ThermalBody& body : bodies) {
    body.air_conductance *= air_factor;
    body.forced_air_conductance *= air_factor;
  }
  return {std::move(bodies), Links()};
}

ThermalLoad LoadOf(const DriveState& state) {
  ThermalLoad load{.heat = std::vector<double>(kNumBodies, 0.0)};
  if (!state.is_on) return load;
  std::vector<double>& heat = load.heat;
  // Spindle bearings: friction torque of preload, constant, and of the
  // lubricant, proportional to speed (the two parts of Palmgren's formula,
  // Harris 2001, the power 2/3 replaced by 1): power a n + b n^2.
  const double n = state.spindle_rpm;
  heat[kBearingFront] += 0.035 * n + 2.0e-5 * n * n;
  heat[kBearingRear] += 0.020 * n + 1.2e-5 * n * n;
  // Losses of the spindle motor: no-load and belt, proportional to speed; in
  // the windings, as the square of the load.
  const double load_share = state.cutting_load;
  heat[kSpindleMotor] += n > 0.0 ? 80.0 + 0.12 * n : 30.0;
  heat[kSpindleMotor] += 600.0 * load_share * load_share;
  // Cutting forces add to the bearings' friction; chips heat what they fall on.
  heat[kBearingFront] += 40.0 * load_share;
  heat[kBearingRear] += 15.0 * load_share;
  heat[kXSlide] += 60.0 * load_share;
  heat[state.coolant ? kCoolantTank : kBedLeftTop] += 300.0 * load_share;
  // Feed drives at full duty; the X motor also holds the slide's weight.
  const double x = state.x_duty;
  heat[kXMotor] += 12.0 + 70.0 * x;
  heat[kXBearing] += 14.0 * x;
  heat[kXNut] += 16.0 * x;
  heat[kXScrewTop] += 1.0 * x;
  heat[kXScrewMiddle] += 2.0 * x;
  heat[kXScrewBottom] += 1.0 * x;
  heat[kXWayTop] += 45.0 * x;
  heat[kXWayBottom] += 35.0 * x;
  heat[kXSlide] += 20.0 * x;
  const double z = state.z_duty;
  heat[kZMotor] += 8.0 + 90.0 * z;
  heat[kZBearingRight] += 18.0 * z;
  heat[kZBearingLeft] += 10.0 * z;
  heat[kZNut] += 34.0 * z;
  heat[kZScrewLeft] += 5.0 * z;
  heat[kZScrewMiddle] += 7.0 * z;
  heat[kZScrewRight] += 6.0 * z;
  heat[kZWayLeft] += 55.0 * z;
  heat[kZWayRight] += 65.0 * z;
  heat[kZSlideLeft] += 25.0 * z;
  heat[kZSlideRight] += 25.0 * z;
  // Pumps: the hydraulic one runs while the machine is on.
  heat[kHydraulicTank] += 180.0;
  if (state.coolant) heat[kCoolantTank] += 250.0;
  load.forced_air = n / 1000.0;
  load.coolant = state.coolant ? 1.0 : 0.0;
  return load;
}

}  // namespace errmap::turning_centre
