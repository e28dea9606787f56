#pragma once

#include <cstdint>
#include <vector>

#include "cli/turning_centre/machine.h"
#include "cli/turning_centre/thermal_network.h"

namespace errmap::turning_centre {

/// One warm-up cycle: a pause, then exercise, then the four measuring sweeps
/// of kStopsPerSweep stops: X forward, X reverse, Z forward, Z reverse.
struct CyclePlan {
  int pause_s = 0;            // machine on, nothing moves; of kStepSeconds
  double spindle_rpm = 0.0;   // of the exercise; the spindle rests in sweeps
  double feed_duty = 0.0;     // of the exercise, both slides, 0 to 1
  bool coolant = false;       // of the exercise
  double cutting_load = 0.0;  // of the exercise, share of the motor's power
};

inline constexpr int kSecondsPerHour = 3600;
inline constexpr int kStopsPerSweep = 17;
inline constexpr int kSecondsPerStop = 5;
inline constexpr int kExerciseSeconds = 440;
/// Step of integration: the fastest body has a time constant of 270 s.
inline constexpr int kStepSeconds = 5;

/// Air of the shop through one day, degC against hours from midnight.
struct Climate {
  double mean = 0.0;             // degC
  double daily_amplitude = 0.0;  // K; warmest at 15:30
  double trend = 0.0;            // K/h from the weather, zero at noon
  double gust_amplitude = 0.0;   // K; doors and heating
  double gust_period = 1.5;      // h
  double gust_phase = 0.0;       // turns

  double AirAt(double hours) const;
};

/// A day of the machine: it rests from kRestHours before midnight, is switched
/// on at start_s and then runs its cycles.
struct DayProgramme {
  Climate climate;
  int start_s = 0;  // seconds from midnight, a multiple of kStepSeconds
  std::vector<CyclePlan> cycles = {};
};

/// All bodies are at air temperature when the rest begins.
inline constexpr int kRestHours = 5;

/// Intensity of the machine's work.
struct Workload {
  double duty = 1.0;   // multiplies every feed duty (the product at most 1)
  double speed = 1.0;  // multiplies every spindle speed
};

/// Returns the first `num_cycles` cycles of the day to which the X displacement
/// is calibrated (model.md). From the 36th on they equal the 35th.
DayProgramme ReportDay(const Workload& workload, int num_cycles);

/// Returns a day drawn from (seed, day_number): season, weather and start, and
/// in blocks of cycles speed, duty, breaks and coolant.
DayProgramme DrawDay(const Workload& workload,
                     std::uint64_t seed,
                     int day_number,
                     int num_cycles);

}  // namespace errmap::turning_centre
