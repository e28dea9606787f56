#include "cli/turning_centre/thermocouples.h"

#include <cmath>

#include "cli/turning_centre/day_programme.h"

namespace errmap::turning_centre {
namespace {

// Readings per degC that the logger tells apart: a resolution of 0.01 degC.
constexpr double kReadingsPerKelvin = 100.0;

double SiteTemperature(const ThermocoupleSite& site,
                       const std::vector<double>& temperatures,
                       double air) {
  const auto of = [&](std::size_t source) {
    return source == kAir ? air : temperatures[source];
  };
  return site.share_of_first * of(site.first) +
         (1.0 - site.share_of_first) * of(site.second);
}

}  // namespace

const std::array<ThermocoupleSite, kNumThermocouples>& ThermocoupleSites() {
  // The surface of a lump also sees its neighbour or the air, hence shares.
  static constexpr std::array<ThermocoupleSite, kNumThermocouples> kSites = {{
      // clang-format off
      {"Bottom of X-(Glass) Scale", "x", kXWayBottom, kAir, 0.6},
      {"Top of X-Scale", "x", kXWayTop, kXBearing, 0.7},
      {"Coolant Tank", "none", kCoolantTank, kAir, 0.98},
      {"Ambient", "none", kAir, kAir, 1.0},
      {"Not Used", "none", kAir, kAir, 1.0},
      {"Not Used", "none", kAir, kAir, 1.0},
      {"Top Right of Bed", "bed", kBedRightTop, kAir, 0.95},
      {"Right of Z-Scale", "z", kBedRightTop, kZWayRight, 0.7},
      {"Right Center of Z-Scale", "z", kZWayRight, kBedRightTop, 0.6},
      {"Left Center of Z-Scale", "z", kZWayLeft, kZWayRight, 0.6},
      {"Left of Z-Scale", "z", kBedLeftTop, kZWayLeft, 0.7},
      {"Top of X-Way", "x", kXWayTop, kAir, 0.95},
      {"Bottom of X-Way", "x", kXWayBottom, kAir, 0.95},
      {"Bottom of X-Head", "x", kXColumnBottom, kXColumnLeft, 0.8},
      {"Top of X-Head", "x", kXColumnTop, kXColumnLeft, 0.8},
      {"Bottom of Z-Slide", "z", kZSlideLeft, kZSlideRight, 0.5},
      {"Top Left of Z-Slide", "z", kZSlideLeft, kAir, 0.95},
      {"Bottom Right of Z-Slide", "z", kZSlideRight, kZWayRight, 0.85},
      {"Top Right of Z-Slide", "z", kZSlideRight, kXColumnLeft, 0.8},
      {"Hydraulic Tank", "none", kHydraulicTank, kAir, 0.97},
      {"Left End of Lower Z-Way", "z", kZWayLeft, kBedLeftBottom, 0.8},
      {"Left End of Upper Z-Way", "z", kZWayLeft, kBedLeftTop, 0.8},
      {"Right End of Lower Z-Way", "z", kZWayRight, kBedRightBottom, 0.8},
      {"Right End of Upper Z-Way", "z", kZWayRight, kBedRightTop, 0.8},
      {"Lower Front of Spindle Head", "spindle", kHeadFrontLower, kBearingFront, 0.9},
      {"Lower Rear of Spindle Head", "spindle", kHeadRearLower, kBearingRear, 0.9},
      {"Upper Front of Spindle Head", "spindle", kHeadFrontUpper, kBearingFront, 0.9},
      {"Upper Rear of Spindle Head", "spindle", kHeadRearUpper, kBearingRear, 0.9},
      {"Left of Top of Spindle Head", "spindle", kHeadRearUpper, kAir, 0.93},
      {"Middle of Top of Spindle Head", "spindle", kHeadFrontUpper, kHeadRearUpper, 0.5},
      {"Right of Top of Spindle Head", "spindle", kHeadFrontUpper, kAir, 0.93},
      {"Bottom Left of Bed", "bed", kBedLeftBottom, kAir, 0.95},
      {"Top Left of Bed", "bed", kBedLeftTop, kAir, 0.95},
      {"Bottom Right of Bed", "bed", kBedRightBottom, kAir, 0.95},
      {"Not Used", "none", kAir, kAir, 1.0},
      {"Near X-Drive Motor Shaft Bearing", "x", kXBearing, kXMotor, 0.9},
      {"Left Z-Ballscrew Bearing", "z", kZBearingLeft, kAir, 0.97},
      {"Right Z-Ballscrew Bearing", "z", kZBearingRight, kAir, 0.97},
      {"X-Ballscrew Housing", "x", kXNut, kXSlide, 0.8},
      {"Z-Ballscrew Nut", "z", kZNut, kZSlideRight, 0.9},
      // clang-format on
  }};
  return kSites;
}

Thermocouples::Thermocouples(
    std::uint64_t seed,
    double noise_sd,
    const std::array<SensorFault, kNumThermocouples>& faults,
    int first_day_cycles)
    : seed_(seed),
      noise_sd_(noise_sd),
      noise_(seed, Purpose::kSensorNoise, 0),
      log_noise_(seed, Purpose::kLogNoise, 0) {
  RandomStream random(seed, Purpose::kSensorErrors, 0);
  for (std::size_t i = 0; i < kNumThermocouples; ++i) {
    Sensor& sensor = sensors_[i];
    sensor.fault = faults[i];
    // A bead glued to the wall answers within 10 to 60 s; unused channels see
    // the logger's own terminals, which follow the air within 15 minutes.
    constexpr double kTerminalSeconds = 900.0;
    const double drawn_seconds = random.Uniform(10.0, 60.0);
    const bool is_unused = ThermocoupleSites()[i].location == "Not Used";
    const double seconds = is_unused ? kTerminalSeconds : drawn_seconds;
    sensor.lag = kStepSeconds / (2.0 * seconds);
    // Matched wire of one spool: 0.3 % of the reading, 0.2 degC.
    sensor.gain = 1.0 + 0.003 * random.Normal();
    sensor.offset = 0.2 * random.Normal();
    sensor.stuck_from_cycle = 1 + random.Below(first_day_cycles);
  }
}

void Thermocouples::BeginFaults(double hours_on, int cycles) {
  has_faults_ = true;
  fault_hours_ = hours_on;
  for (Sensor& sensor : sensors_) sensor.stuck_from_cycle += cycles;
}

void Thermocouples::StartDay(int day,
                             const std::vector<double>& temperatures,
                             double air) {
  noise_ = RandomStream(
      seed_, Purpose::kSensorNoise, static_cast<std::uint64_t>(day));
  log_noise_ =
      RandomStream(seed_, Purpose::kLogNoise, static_cast<std::uint64_t>(day));
  for (std::size_t i = 0; i < kNumThermocouples; ++i) {
    sensors_[i].site =
        SiteTemperature(ThermocoupleSites()[i], temperatures, air);
    sensors_[i].own = sensors_[i].site;
  }
}

void Thermocouples::Step(const std::vector<double>& temperatures, double air) {
  for (std::size_t i = 0; i < kNumThermocouples; ++i) {
    Sensor& sensor = sensors_[i];
    const double site =
        SiteTemperature(ThermocoupleSites()[i], temperatures, air);
    // tau dT/dt = site - T by the trapezoidal rule.
    sensor.own =
        (sensor.own * (1.0 - sensor.lag) + sensor.lag * (sensor.site + site)) /
        (1.0 + sensor.lag);
    sensor.site = site;
  }
}

Thermocouples::Readings Thermocouples::Read(double hours_on, int cycle) {
  Readings readings{};
  for (std::size_t i = 0; i < kNumThermocouples; ++i) {
    Sensor& sensor = sensors_[i];
    // Drawn whatever the fault, so that one fault leaves the other sensors'
    // noise as it was.
    const double deviate = noise_.Normal();
    readings[i] = Reading(sensor, hours_on, deviate);
    if (Has(sensor, SensorFault::kStuck) && cycle >= sensor.stuck_from_cycle) {
      if (!sensor.is_stuck) sensor.stuck_reading = readings[i];
      sensor.is_stuck = true;
      readings[i] = sensor.stuck_reading;
    }
  }
  return readings;
}

Thermocouples::Readings Thermocouples::Log(double hours_on) {
  Readings readings{};
  for (std::size_t i = 0; i < kNumThermocouples; ++i) {
    const double deviate = log_noise_.Normal();
    readings[i] = sensors_[i].is_stuck
                      ? sensors_[i].stuck_reading
                      : Reading(sensors_[i], hours_on, deviate);
  }
  return readings;
}

double Thermocouples::Reading(const Sensor& sensor,
                              double hours_on,
                              double deviate) const {
  if (Has(sensor, SensorFault::kDead)) return 0.0;
  double noise = noise_sd_ * deviate;
  if (Has(sensor, SensorFault::kNoisy)) noise *= kNoisyFactor;
  double reading = sensor.gain * sensor.own + sensor.offset + noise;
  if (Has(sensor, SensorFault::kDrifting)) {
    reading += kDriftPerHour * (hours_on - fault_hours_);
  }
  return std::floor(reading * kReadingsPerKelvin + 0.5) / kReadingsPerKelvin;
}

}  // namespace errmap::turning_centre
