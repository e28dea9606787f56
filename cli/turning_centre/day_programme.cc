#include "cli/turning_centre/day_programme.h"

#include <algorithm>
#include <array>

#include "cli/turning_centre/portable_math.h"
#include "cli/turning_centre/random_stream.h"

namespace errmap::turning_centre {
namespace {

double Duty(double duty, const Workload& workload) {
  return std::min(1.0, workload.duty * duty);
}

}  // namespace

double Climate::AirAt(double hours) const {
  constexpr double kHoursPerDay = 24.0;
  constexpr double kNoon = 12.0;
  constexpr double kRising = 9.5;  // hour of the steepest rise
  return mean + daily_amplitude * SinOfTurns((hours - kRising) / kHoursPerDay) +
         trend * (hours - kNoon) +
         gust_amplitude * SinOfTurns(hours / gust_period + gust_phase);
}

DayProgramme ReportDay(const Workload& workload, int num_cycles) {
  struct Block {
    int first_cycle;
    int pause_s;
    double rpm;
    double duty;
  };
  // The measured surface moves in these steps (cycles 1-2, 3, 4-5, 6-10 ...);
  // what was done between them the report does not say. Speeds, duties and
  // pauses were searched for on a coarse grid (model.md, Calibration).
  static constexpr std::array kBlocks = std::to_array<Block>({
      {1, 0, 2000.0, 0.10},
      {3, 2400, 1000.0, 0.25},
      {4, 2400, 500.0, 0.20},
      {6, 0, 2000.0, 0.25},
      {11, 0, 2500.0, 0.35},
      {16, 0, 1750.0, 0.30},
      {21, 0, 2500.0, 0.35},
      {26, 600, 2250.0, 0.30},
  });
  DayProgramme day{.climate = {.mean = 22.8, .daily_amplitude = 0.2},
                   .start_s = 8 * kSecondsPerHour};
  for (int cycle = 1; cycle <= num_cycles; ++cycle) {
    const Block* block = kBlocks.data();
    for (const Block& candidate : kBlocks) {
      if (candidate.first_cycle <= cycle) block = &candidate;
    }
    const bool is_first = block->first_cycle == cycle;
    day.cycles.push_back({.pause_s = is_first ? block->pause_s : 0,
                          .spindle_rpm = workload.speed * block->rpm,
                          .feed_duty = Duty(block->duty, workload),
                          .coolant = false});
  }
  return day;
}

DayProgramme DrawDay(const Workload& workload,
                     std::uint64_t seed,
                     int day_number,
                     int num_cycles) {
  RandomStream random(
      seed, Purpose::kProgramme, static_cast<std::uint64_t>(day_number));
  // Each draw has a line of its own: the order of evaluation inside one
  // expression is not fixed.
  DayProgramme day;
  const double season = random.Uniform();  // turns of the year
  day.climate.mean = 22.0 + 2.0 * SinOfTurns(season);
  day.climate.mean += 0.8 * random.Normal();
  day.climate.daily_amplitude = random.Uniform(0.3, 1.2);
  day.climate.trend = 0.08 * random.Normal();
  day.climate.gust_amplitude = random.Uniform(0.0, 0.25);
  day.climate.gust_period = random.Uniform(1.0, 3.0);
  day.climate.gust_phase = random.Uniform();
  constexpr int kSecondsPerQuarter = kSecondsPerHour / 4;
  day.start_s = 6 * kSecondsPerHour + kSecondsPerQuarter * random.Below(13);

  while (static_cast<int>(day.cycles.size()) < num_cycles) {
    // A block of cycles that are worked alike; between blocks half the time a
    // break of 10 to 60 minutes, as for a change of set-up or lunch.
    const int length = 3 + random.Below(6);
    const double rpm = 500.0 + 250.0 * random.Below(11);
    const double duty = 0.1 + 0.05 * random.Below(11);
    const bool coolant = random.Below(3) == 0;
    const bool has_break = random.Below(2) == 0;
    const int break_s = 600 * (1 + random.Below(6));
    // Coolant flows where something is cut.
    const double drawn_load = 0.1 + 0.05 * random.Below(11);
    const double cutting_load = coolant ? drawn_load : 0.0;
    for (int i = 0; i < length; ++i) {
      if (static_cast<int>(day.cycles.size()) == num_cycles) break;
      const bool after_break = i == 0 && has_break && !day.cycles.empty();
      day.cycles.push_back({.pause_s = after_break ? break_s : 0,
                            .spindle_rpm = workload.speed * rpm,
                            .feed_duty = Duty(duty, workload),
                            .coolant = coolant,
                            .cutting_load = cutting_load});
    }
  }
  return day;
}

}  // namespace errmap::turning_centre
