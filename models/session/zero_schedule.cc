#include "models/session/zero_schedule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "models/zero_walk.h"
#include "stats/order_statistic.h"

namespace errmap::models {
namespace {

using ProbedSession = HeldOutErrors::Unit;
using ProbedSessions = std::vector<const ProbedSession*>;

constexpr double kHour = 3600.0;
constexpr std::array<double, 16> kHours = {1.0 / 12,
                                           1.0 / 6,
                                           0.25,
                                           1.0 / 3,
                                           0.5,
                                           0.75,
                                           1.0,
                                           1.5,
                                           2.0,
                                           3.0,
                                           4.0,
                                           6.0,
                                           8.0,
                                           12.0,
                                           24.0,
                                           48.0};

// What one session errs by, row by row.
struct Zeroed {
  Index probes = 0;
  std::vector<double> errors;
};

Zeroed ZeroSession(const ProbedSession& unit, const ZeroTrigger& trigger) {
  Zeroed zeroed;
  const bool has_temperature = unit.temperature.size() > 0;
  const auto is_due = [&](Index i, Index zero) {
    const double change =
        has_temperature ? unit.temperature[i] - unit.temperature[zero] : 0.0;
    return trigger.Spent(unit.elapsed[i] - unit.elapsed[zero], change) >=
           1.0 - kTimeRounding;
  };
  zeroed.probes = std::ssize(
      ForZeros(unit.residuals.size(), is_due, [&](Index i, Index zero) {
        zeroed.errors.push_back(unit.residuals[i] - unit.residuals[zero]);
      }));
  return zeroed;
}

double SumOfSquares(const std::vector<double>& errors) {
  return std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0);
}

// What errors (at least one) come to.
ZeroedErrors Summed(std::vector<double> errors) {
  constexpr double kShare = 0.9;
  ZeroedErrors all;
  const auto count = static_cast<double>(errors.size());
  all.rmse = std::sqrt(SumOfSquares(errors) / count);
  for (double& error : errors) error = std::abs(error);
  const auto rank = static_cast<std::size_t>(std::ceil(kShare * count)) - 1;
  all.within_90 = stats::OrderStatistic(std::move(errors), rank);
  return all;
}

ZeroedErrors ZeroAll(const ProbedSessions& units, const ZeroTrigger& trigger) {
  std::vector<double> errors;
  Index probes = 0;
  for (const ProbedSession* unit : units) {
    const Zeroed zeroed = ZeroSession(*unit, trigger);
    probes += zeroed.probes;
    errors.insert(errors.end(), zeroed.errors.begin(), zeroed.errors.end());
  }
  ZeroedErrors all = Summed(std::move(errors));
  all.trigger = trigger;
  all.probes = static_cast<double>(probes) / static_cast<double>(units.size());
  return all;
}

// Of the same rows, as the map is.
ZeroedErrors WithoutProbes(const ProbedSessions& units) {
  std::vector<double> errors;
  for (const ProbedSession* unit : units) {
    errors.insert(
        errors.end(), unit->residuals.begin() + 1, unit->residuals.end());
  }
  return Summed(std::move(errors));
}

double LongestOf(const ProbedSessions& units) {
  double longest = 0.0;
  for (const ProbedSession* unit : units) {
    longest = std::max(longest, unit->elapsed.maxCoeff());
  }
  return longest;
}

// The usual time from one row to the next that is later: a cycle that measures
// several positions at one time has steps of 0. Infinite if no row is later.
double StepOf(const ProbedSessions& units) {
  std::vector<double> steps;
  for (const ProbedSession* unit : units) {
    for (Index i = 1; i < unit->elapsed.size(); ++i) {
      const double step = unit->elapsed[i] - unit->elapsed[i - 1];
      if (step > 0.0) steps.push_back(step);
    }
  }
  if (steps.empty()) return std::numeric_limits<double>::infinity();
  return stats::UpperMedian(std::move(steps));
}

// Intervals that people keep to: none within two rows, none beyond a session.
std::vector<ZeroTrigger> ClocksFor(const ProbedSessions& units) {
  constexpr double kRowsApart = 2.0;
  const double step = StepOf(units);
  const double longest = LongestOf(units);
  std::vector<ZeroTrigger> clocks;
  for (const double hours : kHours) {
    const double interval = hours * kHour;
    if (interval >= kRowsApart * step && interval < longest) {
      clocks.push_back({.time = interval});
    }
  }
  clocks.push_back({});
  return clocks;
}

// Of least error among those of a time that take no more probes than `clock`.
ZeroTrigger FitTrigger(const ProbedSessions& units, const ZeroTrigger& clock) {
  constexpr std::array<double, 6> kTimes = {
      1.5, 2.0, 3.0, 4.0, 8.0, std::numeric_limits<double>::infinity()};
  constexpr int kHalvings = 14;
  const ZeroedErrors by_clock = ZeroAll(units, clock);
  double widest = 0.0;
  for (const ProbedSession* unit : units) {
    widest = std::max(
        widest, unit->temperature.maxCoeff() - unit->temperature.minCoeff());
  }
  if (!(widest > 0.0)) return clock;
  ZeroedErrors best = by_clock;
  for (const double times : kTimes) {
    // Smaller changes cost more probes.
    ZeroTrigger trigger{.time = times * clock.time, .temperature = widest};
    double few = std::log(widest);
    double many = few - std::log(1e3);
    for (int i = 0; i < kHalvings; ++i) {
      trigger.temperature = std::exp(0.5 * (few + many));
      const ZeroedErrors found = ZeroAll(units, trigger);
      const bool affordable = found.probes <= by_clock.probes;
      if (affordable && found.rmse < best.rmse) best = found;
      (affordable ? few : many) = std::log(trigger.temperature);
    }
  }
  return best.trigger;
}

// The least error of a clock with no more probes.
double BestClockRmse(const ProbedSessions& units, double probes) {
  constexpr int kPerOctave = 4;
  // Units hold some 50 rows: even steps end long before that.
  constexpr int kMostOctaves = 16;
  const double longest = LongestOf(units);
  const double step = StepOf(units);
  double least = ZeroAll(units, {}).rmse;
  for (int i = 0; i <= kMostOctaves * kPerOctave; ++i) {
    const double interval = longest * std::exp2(-i / double{kPerOctave});
    if (interval < step) break;
    const ZeroedErrors clock = ZeroAll(units, {.time = interval});
    if (clock.probes <= probes) least = std::min(least, clock.rmse);
  }
  return least;
}

ZeroSchedule::Rule JudgeRule(const ProbedSessions& units,
                             const ZeroTrigger& clock) {
  constexpr double kWorthIt = 0.95;
  constexpr std::size_t kFewestSessions = 4;
  ZeroSchedule::Rule rule{.trigger = FitTrigger(units, clock)};
  double squares = 0.0;
  std::size_t rows = 0;
  Index probes = 0;
  for (const ProbedSession* left_out : units) {
    ProbedSessions others = units;
    std::erase(others, left_out);
    const Zeroed by_rule = ZeroSession(*left_out, FitTrigger(others, clock));
    const double of_rule = SumOfSquares(by_rule.errors);
    if (of_rule < SumOfSquares(ZeroSession(*left_out, clock).errors)) {
      ++rule.better;
    }
    squares += of_rule;
    rows += by_rule.errors.size();
    probes += by_rule.probes;
  }
  rule.rmse = std::sqrt(squares / static_cast<double>(rows));
  rule.clock_rmse = BestClockRmse(
      units, static_cast<double>(probes) / static_cast<double>(units.size()));
  rule.established =
      units.size() >= kFewestSessions && 3 * rule.better >= 2 * units.size() &&
      rule.rmse < kWorthIt * rule.clock_rmse && !rule.trigger.is_clock();
  return rule;
}

ProbedSessions ProbedSessionsOf(const HeldOutErrors& errors) {
  ProbedSessions units;
  for (const ProbedSession& unit : errors.units) {
    if (unit.residuals.size() > 1) units.push_back(&unit);
  }
  return units;
}

}  // namespace

bool ZeroTrigger::is_clock() const { return !std::isfinite(temperature); }

double ZeroTrigger::Spent(double age, double change) const {
  return age / time + std::abs(change) / temperature;
}

ZeroTrigger ZeroSchedule::advised() const {
  if (rule && rule->established) return rule->trigger;
  return clock ? clock->trigger : ZeroTrigger{};
}

bool KnowsAges(const FittedModel& fitted) {
  return fitted.held_out != nullptr && fitted.held_out->time_unit == "s" &&
         fitted.interval && fitted.interval->of_sessions &&
         ProbedSessionsOf(*fitted.held_out).size() >= 2;
}

ZeroSchedule ScheduleZeros(const HeldOutErrors& errors, double goal) {
  const ProbedSessions units = ProbedSessionsOf(errors);
  if (units.size() < 2) {
    throw std::invalid_argument(
        "ScheduleZeros: needs two sessions of two rows");
  }
  ZeroSchedule schedule{.sessions = units.size(),
                        .none = WithoutProbes(units),
                        .clocks = {},
                        .clock = {},
                        .rule = {}};
  schedule.no_probe_serves = schedule.none.within_90 <= goal;
  for (const ZeroTrigger& trigger : ClocksFor(units)) {
    const ZeroedErrors clock = ZeroAll(units, trigger);
    // Of intervals that come to the same rows the longest.
    if (!schedule.clocks.empty() &&
        schedule.clocks.back().probes == clock.probes &&
        schedule.clocks.back().rmse == clock.rmse) {
      schedule.clocks.pop_back();
    }
    schedule.clocks.push_back(clock);
    if (clock.within_90 <= goal && !schedule.no_probe_serves) {
      schedule.clock = clock;
    }
  }
  if (schedule.clock && !errors.temperature.empty() &&
      std::isfinite(schedule.clock->trigger.time)) {
    schedule.rule = JudgeRule(units, schedule.clock->trigger);
  }
  return schedule;
}

Index TellingTemperature(const MatrixXd& temperatures,
                         const VectorXd& residuals,
                         const std::vector<std::vector<Index>>& sessions) {
  Index best = -1;
  double closest = 0.0;
  for (Index column = 0; column < temperatures.cols(); ++column) {
    // About zero: no change of the one goes with none of the other.
    double both = 0.0;
    double of_residual = 0.0;
    double of_temperature = 0.0;
    for (const std::vector<Index>& rows : sessions) {
      for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t j = i + 1; j < rows.size(); ++j) {
          const double error =
              std::abs(residuals[rows[j]] - residuals[rows[i]]);
          const double change = std::abs(temperatures(rows[j], column) -
                                         temperatures(rows[i], column));
          both += error * change;
          of_residual += error * error;
          of_temperature += change * change;
        }
      }
    }
    const double cosine = both / std::sqrt(of_residual * of_temperature);
    if (!(cosine > closest)) continue;
    closest = cosine;
    best = column;
  }
  return best;
}

}  // namespace errmap::models
