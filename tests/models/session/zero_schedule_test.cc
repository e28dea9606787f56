#include "models/session/zero_schedule.h"

#include <cmath>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

#include "stats/distributions.h"
#include "stats/random.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kRowsToZero = 48;
constexpr double kStepToZero = 750.0;  // s: ten hours
constexpr double kHourToZero = 3600.0;

double NormalToZero(stats::Random* random) {
  return stats::NormalQuantile(std::max(random->Uniform(), 1e-12));
}

// Days on which a temperature leaps now and then; errors follow the leaps where
// `by_temperature`, else a walk of their own.
HeldOutErrors DaysToZero(int count, std::uint64_t seed, bool by_temperature) {
  stats::Random random(seed);
  HeldOutErrors errors{
      .time_unit = "s", .position = "", .rmse = 1.0, .units = {}};
  errors.temperature = "t_degC";
  for (int day = 0; day < count; ++day) {
    HeldOutErrors::Unit unit{.label = "day",
                             .rmse = 1.0,
                             .elapsed = VectorXd(kRowsToZero),
                             .position = {},
                             .residuals = VectorXd(kRowsToZero)};
    unit.temperature.resize(kRowsToZero);
    double temperature = 20.0;
    double walk = 0.0;
    for (Index i = 0; i < kRowsToZero; ++i) {
      if (random.Uniform() < 0.06) temperature += 3.0 * NormalToZero(&random);
      walk += 0.4 * NormalToZero(&random);
      unit.elapsed[i] = kStepToZero * static_cast<double>(i);
      unit.temperature[i] = temperature;
      unit.residuals[i] =
          (by_temperature ? temperature : walk) + 0.1 * NormalToZero(&random);
    }
    errors.units.push_back(std::move(unit));
  }
  return errors;
}

double RmseKeeping(const HeldOutErrors& errors,
                   const ZeroTrigger& trigger,
                   double* probes) {
  double squares = 0.0;
  double rows = 0.0;
  *probes = 0.0;
  for (const HeldOutErrors::Unit& unit : errors.units) {
    Index zero = 0;
    for (Index i = 1; i < kRowsToZero; ++i) {
      squares += std::pow(unit.residuals[i] - unit.residuals[zero], 2);
      ++rows;
      if (trigger.Spent(unit.elapsed[i] - unit.elapsed[zero],
                        unit.temperature[i] - unit.temperature[zero]) >= 1.0) {
        zero = i;
        ++*probes;
      }
    }
  }
  return std::sqrt(squares / rows);
}

TEST(ZeroSchedule, TakesTheLongestIntervalThatKeepsTheGoal) {
  // Errors grow by 1 an hour: nine tenths of those in d hours are below 0.9 d.
  HeldOutErrors errors = DaysToZero(3, 1, false);
  for (HeldOutErrors::Unit& unit : errors.units) {
    unit.residuals = unit.elapsed / kHourToZero;
  }
  const ZeroSchedule schedule = ScheduleZeros(errors, 2.0);
  ASSERT_TRUE(schedule.clock);
  EXPECT_EQ(schedule.clock->trigger.time, 2.0 * kHourToZero);
  EXPECT_LE(schedule.clock->within_90, 2.0);
  for (std::size_t i = 1; i < schedule.clocks.size(); ++i) {
    EXPECT_LE(schedule.clocks[i].probes, schedule.clocks[i - 1].probes);
    EXPECT_GE(schedule.clocks[i].within_90, schedule.clocks[i - 1].within_90);
  }
  EXPECT_FALSE(ScheduleZeros(errors, 1e-3).clock);
  EXPECT_FALSE(ScheduleZeros(errors, 1e-3).serves());
  EXPECT_TRUE(ScheduleZeros(errors, 20.0).no_probe_serves);
  EXPECT_FALSE(ScheduleZeros(errors, std::nan("")).clock);
}

// Errors of +1 and -1 in turn: each new zero makes the next ones worse.
TEST(ZeroSchedule, AdvisesNoProbeWhereTheMapServesAsItIs) {
  HeldOutErrors errors = DaysToZero(3, 1, false);
  for (HeldOutErrors::Unit& unit : errors.units) {
    for (Eigen::Index i = 0; i < unit.residuals.size(); ++i) {
      unit.residuals[i] = i % 2 == 0 ? 1.0 : -1.0;
    }
  }
  const ZeroSchedule schedule = ScheduleZeros(errors, 1.5);
  EXPECT_EQ(schedule.none.probes, 0.0);
  EXPECT_DOUBLE_EQ(schedule.none.rmse, 1.0);
  EXPECT_GT(schedule.clocks.front().rmse, 1.0);
  EXPECT_TRUE(schedule.no_probe_serves);
  EXPECT_FALSE(schedule.clock);
  EXPECT_FALSE(std::isfinite(schedule.advised().time));
}

TEST(ZeroSchedule, AdvisesTheTemperatureWhereTheErrorsFollowIt) {
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const ZeroSchedule schedule =
        ScheduleZeros(DaysToZero(10, seed, true), 2.5);
    ASSERT_TRUE(schedule.rule) << seed;
    if (!schedule.rule->established) continue;
    // On days that had no part in it, against the clock.
    const HeldOutErrors later = DaysToZero(40, 100 + seed, true);
    double of_rule = 0.0;
    double of_clock = 0.0;
    const double rule = RmseKeeping(later, schedule.advised(), &of_rule);
    const double clock = RmseKeeping(later, schedule.clock->trigger, &of_clock);
    EXPECT_LT(rule, clock) << seed;
    EXPECT_LT(of_rule, 1.2 * of_clock) << seed;
    ++better;
  }
  EXPECT_GE(better, 8);
}

TEST(ZeroSchedule, KeepsToTheClockWhereTheTemperatureTellsNothing) {
  int established = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ZeroSchedule schedule =
        ScheduleZeros(DaysToZero(8, seed, false), 2.5);
    ASSERT_TRUE(schedule.clock) << seed;
    if (schedule.rule && schedule.rule->established) ++established;
  }
  EXPECT_LE(established, 1);
}

TEST(ZeroSchedule, NeedsWholeSessionsWithTimes) {
  HeldOutErrors errors = DaysToZero(3, 1, false);
  FittedModel fitted;
  EXPECT_FALSE(KnowsAges(fitted));
  fitted.held_out = std::make_shared<const HeldOutErrors>(errors);
  fitted.interval.emplace().of_sessions = true;
  EXPECT_TRUE(KnowsAges(fitted));
  fitted.interval->of_sessions = false;
  EXPECT_FALSE(KnowsAges(fitted));
  fitted.interval->of_sessions = true;
  errors.time_unit = "rows";
  fitted.held_out = std::make_shared<const HeldOutErrors>(errors);
  EXPECT_FALSE(KnowsAges(fitted));
  errors.units.resize(1);
  EXPECT_THROW(ScheduleZeros(errors, 1.0), std::invalid_argument);
}

// Three positions a moment: most rows are not later than the one before.
TEST(ZeroSchedule, ReadsCyclesThatMeasureSeveralPositionsAtOneTime) {
  HeldOutErrors errors = DaysToZero(6, 3, true);
  for (HeldOutErrors::Unit& unit : errors.units) {
    for (Index i = 0; i < kRowsToZero; ++i) {
      unit.elapsed[i] = kHourToZero * static_cast<double>(i / 3);
    }
  }
  const ZeroSchedule schedule = ScheduleZeros(errors, 4.0);
  ASSERT_TRUE(schedule.clock);
  ASSERT_TRUE(schedule.rule);
  EXPECT_TRUE(std::isfinite(schedule.rule->clock_rmse));
  // None within two hours, which are two steps.
  EXPECT_GE(schedule.clocks.front().trigger.time, 2.0 * kHourToZero);
}

TEST(ZeroSchedule, HasNoClockWhereNoRowIsLaterThanAnother) {
  HeldOutErrors errors = DaysToZero(3, 3, true);
  for (HeldOutErrors::Unit& unit : errors.units) unit.elapsed.setZero();
  const ZeroSchedule schedule = ScheduleZeros(errors, 100.0);
  ASSERT_EQ(schedule.clocks.size(), 1U);
  EXPECT_FALSE(std::isfinite(schedule.clocks.front().trigger.time));
}

TEST(ZeroSchedule, FindsTheTemperatureThatTheErrorsFollow) {
  const HeldOutErrors errors = DaysToZero(1, 7, true);
  stats::Random random(8);
  Eigen::MatrixXd temperatures(kRowsToZero, 3);
  std::vector<std::vector<Index>> rows(1);
  for (Index i = 0; i < kRowsToZero; ++i) {
    temperatures(i, 0) = NormalToZero(&random);
    temperatures(i, 1) = errors.units[0].temperature[i];
    temperatures(i, 2) = 21.0;
    rows[0].push_back(i);
  }
  const VectorXd& residuals = errors.units[0].residuals;
  EXPECT_EQ(TellingTemperature(temperatures, residuals, rows), 1);
  EXPECT_EQ(TellingTemperature(temperatures.rightCols(1), residuals, rows), -1);
}

}  // namespace
}  // namespace errmap::models
