#include "cli/turning_centre/simulation.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "cli/turning_centre/machine.h"
#include "cli/turning_centre/thermal_network.h"

namespace errmap::turning_centre {
namespace {

/// Share of rapid traverse while the slide goes from stop to stop.
constexpr double kMeasuringDuty = 0.1;

[[noreturn]] void ThrowInvalid(const std::string& what) {
  throw std::invalid_argument(what);
}

void CheckCount(const char* name, int value, int low, int high) {
  if (value >= low && value <= high) return;
  ThrowInvalid(fmt::format(
      "{} {}: give a whole number from {} to {}", name, value, low, high));
}

void CheckFactor(const char* name, double value, double high) {
  if (std::isfinite(value) && value >= 0.0 && value <= high) return;
  ThrowInvalid(
      fmt::format("{} {}: give a number from 0 to {}", name, value, high));
}

// From midnight before the first day.
std::int64_t TimeOf(int day, double seconds) {
  constexpr std::int64_t kSecondsPerDay = 24 * kSecondsPerHour;
  return (day - 1) * kSecondsPerDay + std::llround(seconds);
}

// The clock, the bodies and the sensors of one day as it goes on.
class Day {
 public:
  // `hours_before`: that the machine was on, on earlier days.
  Day(const ThermalNetwork& network,
      const DayProgramme& programme,
      int number,
      double hours_before,
      Thermocouples* thermocouples,
      std::vector<LogEntry>* log)
      : programme_(programme),
        number_(number),
        hours_before_(hours_before),
        integrator_(network),
        thermocouples_(*thermocouples),
        log_(*log),
        seconds_(-kRestHours * kSecondsPerHour),
        temperatures_(kNumBodies, Air(seconds_)) {}

  // From the rest of the night to the machine's first moment.
  void Begin() {
    Run(kRestHours * kSecondsPerHour + programme_.start_s, {});
    thermocouples_.StartDay(number_, temperatures_, Air(seconds_));
    WriteLog();
  }

  void Run(int seconds, const DriveState& state) {
    const ThermalLoad load = LoadOf(state);
    for (int done = 0; done < seconds; done += kStepSeconds) {
      constexpr double kHalf = 0.5 * kStepSeconds;
      const AirOfStep air = {.start = Air(seconds_),
                             .middle = Air(seconds_ + kHalf),
                             .end = Air(seconds_ + kStepSeconds)};
      integrator_.Step(kStepSeconds, air, load, &temperatures_);
      seconds_ += kStepSeconds;
      if (!state.is_on) continue;
      thermocouples_.Step(temperatures_, air.end);
      if (std::llround(seconds_ - programme_.start_s) % kLogSeconds == 0) {
        WriteLog();
      }
    }
  }

  double hours() const { return seconds_ / kSecondsPerHour; }
  // Of all days so far.
  double hours_on() const {
    return hours_before_ + (seconds_ - programme_.start_s) / kSecondsPerHour;
  }
  const std::vector<double>& temperatures() const { return temperatures_; }

 private:
  double Air(double seconds) const {
    return programme_.climate.AirAt(seconds / kSecondsPerHour);
  }

  void WriteLog() {
    log_.push_back({.day = number_,
                    .time_s = TimeOf(number_, seconds_),
                    .readings = thermocouples_.Log(hours_on())});
  }

  const DayProgramme& programme_;
  const int number_;
  const double hours_before_;
  ThermalIntegrator integrator_;
  Thermocouples& thermocouples_;
  std::vector<LogEntry>& log_;
  double seconds_;  // from midnight; whole
  std::vector<double> temperatures_;
};

void AddPoints(int day,
               std::size_t first_stop,
               std::size_t end_stop,
               Simulation* simulation) {
  RandomStream random(simulation->options.seed,
                      Purpose::kToolTipPoints,
                      static_cast<std::uint64_t>(day));
  std::vector<ToolTipPoint> points;
  const auto num_stops = static_cast<int>(end_stop - first_stop);
  for (int i = 0; i < simulation->options.points_per_day; ++i) {
    ToolTipPoint& point = points.emplace_back();
    point.stop = first_stop + static_cast<std::size_t>(random.Below(num_stops));
    // To a tenth of a millimetre, as a programme would have it.
    const auto drawn = [&](double step) {
      const double position = random.Uniform(-step * kStopsPerSweep, -step);
      return std::floor(10.0 * position + 0.5) / 10.0;
    };
    point.x = drawn(kXStep);
    point.z = drawn(kZStep);
    const auto direction = [&] {
      return random.Below(2) == 0 ? Direction::kForward : Direction::kReverse;
    };
    point.x_direction = direction();
    point.z_direction = direction();
  }
  std::stable_sort(
      points.begin(), points.end(), [](const auto& a, const auto& b) {
        return a.stop < b.stop;
      });
  simulation->points.insert(
      simulation->points.end(), points.begin(), points.end());
}

std::array<SensorFault, kNumThermocouples> FaultsOf(
    const SimulationOptions& options) {
  std::array<SensorFault, kNumThermocouples> faults{};
  const auto mark = [&](const std::vector<int>& numbers, SensorFault fault) {
    for (const int number : numbers) {
      faults[static_cast<std::size_t>(number)] = fault;
    }
  };
  mark(options.dead, SensorFault::kDead);
  mark(options.stuck, SensorFault::kStuck);
  mark(options.drifting, SensorFault::kDrifting);
  mark(options.noisy, SensorFault::kNoisy);
  return faults;
}

}  // namespace

void SimulationOptions::Validate() const {
  constexpr int kMostDays = 366;
  constexpr int kMostCycles = 1000;
  constexpr int kMostPoints = 100000;
  constexpr double kMostFactor = 100.0;
  constexpr double kMostNoise = 1000.0;
  CheckCount("days", days, 1, kMostDays);
  CheckCount("cycles", cycles, 1, kMostCycles);
  // Each cycle keeps 68 stops of some 600 bytes.
  constexpr int kMostCyclesInAll = 10000;
  if (days * cycles > kMostCyclesInAll) {
    ThrowInvalid(
        fmt::format("days {} of {} cycles: give at most {} cycles in all",
                    days,
                    cycles,
                    kMostCyclesInAll));
  }
  CheckCount("points", points_per_day, 0, kMostPoints);
  CheckFactor("duty", workload.duty, kMostFactor);
  CheckFactor("speed", workload.speed, 4.0);
  constexpr double kHoursPerDay = 24.0;
  CheckFactor("warm", warm_hours, kHoursPerDay);
  if (!std::isfinite(air_factor) || air_factor <= 0.0 ||
      air_factor > kMostFactor) {
    ThrowInvalid(
        fmt::format("air {}: conductances to the air need a factor above 0, at "
                    "most {}",
                    air_factor,
                    kMostFactor));
  }
  CheckFactor("noise", noise_um, kMostNoise);
  CheckFactor("angle-noise", noise_urad, kMostNoise);
  CheckFactor("sensor-noise", sensor_noise, kMostNoise);
  CheckCount("from-day", from_day, 1, days);
  if (!std::isfinite(shift_um) || std::abs(shift_um) > kMostNoise) {
    ThrowInvalid(
        fmt::format("shift-um {}: give a number from -1000 to 1000", shift_um));
  }
  std::set<int> taken;
  for (const std::vector<int>* list : {&dead, &stuck, &drifting, &noisy}) {
    for (const int number : *list) {
      if (number < 0 || number >= static_cast<int>(kNumThermocouples)) {
        ThrowInvalid(
            fmt::format("no thermocouple {}: they are numbered 0 to {}",
                        number,
                        kNumThermocouples - 1));
      }
      if (!taken.insert(number).second) {
        ThrowInvalid(fmt::format(
            "thermocouple {} is named twice: give each at most one fault",
            number));
      }
    }
  }
}

std::int64_t Stop::time_s() const {
  return TimeOf(day, hours * kSecondsPerHour);
}

Slide Stop::slide() const {
  return sweep == Sweep::kXForward || sweep == Sweep::kXReverse ? Slide::kX
                                                                : Slide::kZ;
}

Direction Stop::direction() const {
  return sweep == Sweep::kXForward || sweep == Sweep::kZForward
             ? Direction::kForward
             : Direction::kReverse;
}

double Stop::position() const {
  const double step = slide() == Slide::kX ? kXStep : kZStep;
  const int place =
      direction() == Direction::kForward ? index + 1 : kStopsPerSweep - index;
  return -step * place;
}

Simulation Simulate(const SimulationOptions& options) {
  options.Validate();
  const ThermalNetwork network = MakeTurningCentreNetwork(options.air_factor);
  Thermocouples thermocouples(
      options.seed, options.sensor_noise, FaultsOf(options), options.cycles);
  if (options.from_day > 1) thermocouples.PostponeFaults();
  Simulation simulation{.options = options};
  // Days keep references to their programmes.
  simulation.programmes.reserve(static_cast<std::size_t>(options.days));
  double hours_before = 0.0;
  int cycle = 0;
  for (int day_number = 1; day_number <= options.days; ++day_number) {
    const DayProgramme& programme = simulation.programmes.emplace_back(
        day_number == 1
            ? ReportDay(options.workload, options.cycles)
            : DrawDay(
                  options.workload, options.seed, day_number, options.cycles));
    if (day_number == options.from_day && day_number > 1) {
      thermocouples.BeginFaults(hours_before, cycle);
    }
    constexpr double kMmPerUm = 1e-3;
    const double shift =
        day_number < options.from_day ? 0.0 : kMmPerUm * options.shift_um;
    const std::size_t first_stop = simulation.stops.size();
    Day day(network,
            programme,
            day_number,
            hours_before,
            &thermocouples,
            &simulation.log);
    day.Begin();
    if (options.warm_hours > 0.0 && day_number > 1) {
      // As on a usual day; in whole steps.
      constexpr DriveState kAtWork = {
          .is_on = true, .spindle_rpm = 2000.0, .x_duty = 0.3, .z_duty = 0.3};
      day.Run(kStepSeconds * static_cast<int>(options.warm_hours *
                                              kSecondsPerHour / kStepSeconds),
              kAtWork);
      day.Run(kWarmBreakSeconds, {.is_on = true});
    }
    for (const CyclePlan& plan : programme.cycles) {
      ++cycle;
      day.Run(plan.pause_s, {.is_on = true});
      day.Run(kExerciseSeconds,
              {.is_on = true,
               .spindle_rpm = plan.spindle_rpm,
               .x_duty = plan.feed_duty,
               .z_duty = plan.feed_duty,
               .coolant = plan.coolant,
               .cutting_load = plan.cutting_load});
      for (int s = 0; s < kNumSweeps; ++s) {
        Stop stop{.day = day_number,
                  .shift = shift,
                  .cycle = cycle,
                  .sweep = static_cast<Sweep>(s)};
        const bool is_x = stop.slide() == Slide::kX;
        for (int i = 0; i < kStopsPerSweep; ++i) {
          day.Run(kSecondsPerStop,
                  {.is_on = true,
                   .x_duty = is_x ? kMeasuringDuty : 0.0,
                   .z_duty = is_x ? 0.0 : kMeasuringDuty});
          stop.index = i;
          stop.hours = day.hours();
          stop.rise = RiseOf(day.temperatures());
          stop.readings = thermocouples.Read(day.hours_on(), cycle);
          simulation.stops.push_back(stop);
        }
      }
    }
    hours_before = day.hours_on();
    AddPoints(day_number, first_stop, simulation.stops.size(), &simulation);
  }
  return simulation;
}

}  // namespace errmap::turning_centre
