#pragma once

#include <cstdint>
#include <vector>

#include "cli/turning_centre/component_errors.h"
#include "cli/turning_centre/day_programme.h"
#include "cli/turning_centre/thermocouples.h"

namespace errmap::turning_centre {

/// Options of a simulation.
struct SimulationOptions {
  std::uint64_t seed = 1;
  int days = 2;     // 1 to 366; day 1 is ReportDay, the others are drawn
  int cycles = 35;  // warm-up cycles of each day, 1 to 1000
  Workload workload = {};
  /// From the second day on, the machine works this long without being
  /// measured. It then rests for kWarmBreakSeconds before the first cycle, so
  /// that the session starts warm. Hours, 0 to 24.
  double warm_hours = 0.0;
  double air_factor = 1.0;  // on conductances to the air, > 0, <= 100
  /// Standard deviation of a reading of a displacement, um: a laser
  /// interferometer in a shop.
  double noise_um = 0.15;
  /// The same for an angle, urad: 0.1 arcsec, an autocollimator.
  double noise_urad = 0.5;
  double sensor_noise = 0.02;  // of a thermocouple's reading, degC
  /// Thermocouples by number, 0 to 39; each in at most one list.
  std::vector<int> dead = {};
  std::vector<int> stuck = {};
  std::vector<int> drifting = {};
  std::vector<int> noisy = {};
  /// Day on which the sensors' faults and the shift begin, 1 to days.
  int from_day = 1;
  /// Added to both slides' displacements from then on, um, as if a scale
  /// slipped in a collision. -1000 to 1000.
  double shift_um = 0.0;
  int points_per_day = 100;  // of tool_tip.csv, 0 to 100000

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

inline constexpr int kWarmBreakSeconds = 1200;

/// The four measuring sweeps of a cycle, in order.
enum class Sweep { kXForward, kXReverse, kZForward, kZReverse };
inline constexpr int kNumSweeps = 4;

/// The machine at one stop of a sweep.
struct Stop {
  int day = 0;         // from 1
  double shift = 0.0;  // of the slides' displacements, mm
  int cycle = 0;       // from 1, through all days
  Sweep sweep = Sweep::kXForward;
  int index = 0;       // place in the sweep, 0 to kStopsPerSweep - 1
  double hours = 0.0;  // from midnight
  /// Seconds from midnight before the first day, including breaks and nights.
  std::int64_t time_s() const;
  TemperatureRise rise = {};
  Thermocouples::Readings readings = {};

  Slide slide() const;
  Direction direction() const;
  /// Nominal position of the moving slide, mm.
  double position() const;
};

/// A row of the logger. It records all channels every kLogSeconds while the
/// machine is on.
struct LogEntry {
  int day = 0;              // from 1
  std::int64_t time_s = 0;  // as that of a Stop
  Thermocouples::Readings readings = {};
};
inline constexpr int kLogSeconds = 60;

/// One random pose of the tool at the machine state of some stop.
struct ToolTipPoint {
  std::size_t stop = 0;  // index into Simulation::stops
  double x = 0.0;        // mm
  double z = 0.0;
  Direction x_direction = Direction::kForward;
  Direction z_direction = Direction::kForward;
};

struct Simulation {
  SimulationOptions options;
  std::vector<DayProgramme> programmes = {};  // (days)
  std::vector<Stop> stops = {};               // in order of time
  std::vector<ToolTipPoint> points = {};      // by day, then by time
  std::vector<LogEntry> log = {};             // by day, then by time
};

/// Runs the machine. Throws std::invalid_argument if options.Validate()
/// does.
Simulation Simulate(const SimulationOptions& options);

}  // namespace errmap::turning_centre
