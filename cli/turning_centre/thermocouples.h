#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "cli/turning_centre/machine.h"
#include "cli/turning_centre/random_stream.h"

namespace errmap::turning_centre {

inline constexpr std::size_t kNumThermocouples = 40;

/// A line of NISTIR 5367, Table 1, with the bodies whose temperature the sensor
/// reads here.
struct ThermocoupleSite {
  std::string_view location;  // as the table has it
  std::string_view axis;      // "x", "z", "spindle", "bed" or "none"
  std::size_t first;          // body, or kAir
  std::size_t second;         // body, or kAir
  double share_of_first;      // the rest is that of the second
};

/// Means the air in place of a body in a ThermocoupleSite.
inline constexpr std::size_t kAir = kNumBodies;

const std::array<ThermocoupleSite, kNumThermocouples>& ThermocoupleSites();

/// Fault of a sensor.
enum class SensorFault {
  kNone,
  kDead,      // reads 0
  kStuck,     // keeps its reading from a random moment of the first day
  kDrifting,  // gains kDriftPerHour while the machine is on
  kNoisy,     // kNoisyFactor times the noise
};

inline constexpr double kDriftPerHour = 0.04;  // K/h
inline constexpr double kNoisyFactor = 25.0;

/// The 40 thermocouples and their logger: each follows its site with a time
/// constant and reads with a gain, an offset, noise and a resolution of
/// 0.01 K.
class Thermocouples {
 public:
  using Readings = std::array<double, kNumThermocouples>;

  /// Time constants, gains and offsets are drawn from `seed`; noise_sd in
  /// degC, >= 0; `first_day_cycles` >= 1 bounds when stuck ones stop.
  Thermocouples(std::uint64_t seed,
                double noise_sd,
                const std::array<SensorFault, kNumThermocouples>& faults,
                int first_day_cycles);

  /// No faults until BeginFaults.
  void PostponeFaults() { has_faults_ = false; }
  /// Begins the faults now: `hours_on` as for Read, after `cycles` cycles.
  void BeginFaults(double hours_on, int cycles);

  /// Starts a day: every sensor has the temperature of its site.
  void StartDay(int day, const std::vector<double>& temperatures, double air);

  /// Advances the sensors by one step of kStepSeconds.
  void Step(const std::vector<double>& temperatures, double air);

  /// Returns readings in degC at `hours_on` (h since first switched on), in a
  /// cycle counted from 1 through all days.
  Readings Read(double hours_on, int cycle);

  /// Returns the logger's readings between measurements; `hours_on` as for
  /// Read. They have separate noise, so that a log does not change the results
  /// of Read. Sensors stop only at a Read.
  Readings Log(double hours_on);

 private:
  struct Sensor {
    SensorFault fault = SensorFault::kNone;
    double lag = 0.0;  // h / (2 tau) of the trapezoidal rule
    double gain = 1.0;
    double offset = 0.0;
    int stuck_from_cycle = 0;
    bool is_stuck = false;
    double stuck_reading = 0.0;
    double site = 0.0;  // temperature at the last step
    double own = 0.0;   // the sensor's own temperature
  };

  // Returns a reading at the logger's resolution; `deviate` is standard normal.
  double Reading(const Sensor& sensor, double hours_on, double deviate) const;
  bool Has(const Sensor& sensor, SensorFault fault) const {
    return has_faults_ && sensor.fault == fault;
  }

  std::uint64_t seed_;
  double noise_sd_;
  std::array<Sensor, kNumThermocouples> sensors_;
  bool has_faults_ = true;
  double fault_hours_ = 0.0;  // hours_on when the faults began
  RandomStream noise_;
  RandomStream log_noise_;
};

}  // namespace errmap::turning_centre
