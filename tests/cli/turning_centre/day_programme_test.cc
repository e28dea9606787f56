#include "cli/turning_centre/day_programme.h"

#include <gtest/gtest.h>

namespace errmap::turning_centre {
namespace {

TEST(Climate, IsWarmestInTheAfternoon) {
  const Climate climate{.mean = 22.0, .daily_amplitude = 1.5};
  EXPECT_NEAR(climate.AirAt(15.5), 23.5, 1e-12);
  EXPECT_NEAR(climate.AirAt(3.5), 20.5, 1e-12);
  const Climate trend{.mean = 22.0, .trend = 0.5};
  EXPECT_EQ(trend.AirAt(14.0), 23.0);
}

TEST(DayProgramme, ReportDayGoesOnAsItsLastCycle) {
  const DayProgramme day = ReportDay({}, 40);
  ASSERT_EQ(day.cycles.size(), 40U);
  EXPECT_EQ(day.cycles[25].pause_s, 600);
  EXPECT_EQ(day.cycles[39].pause_s, 0);
  EXPECT_EQ(day.cycles[39].spindle_rpm, day.cycles[34].spindle_rpm);
}

TEST(DayProgramme, DrawnDaysDifferAndKeepTheirPlace) {
  const DayProgramme day_2 = DrawDay({}, 1, 2, 35);
  const DayProgramme day_3 = DrawDay({}, 1, 3, 35);
  EXPECT_EQ(day_2.cycles.size(), 35U);
  EXPECT_NE(day_2.climate.mean, day_3.climate.mean);
  // The same day of a shorter programme begins alike.
  const DayProgramme shorter = DrawDay({}, 1, 2, 10);
  EXPECT_EQ(shorter.climate.mean, day_2.climate.mean);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(shorter.cycles[i].spindle_rpm, day_2.cycles[i].spindle_rpm);
    EXPECT_EQ(shorter.cycles[i].pause_s, day_2.cycles[i].pause_s);
  }
}

TEST(DayProgramme, WorkloadScalesDutyAndSpeed) {
  const DayProgramme plain = DrawDay({}, 1, 2, 20);
  const DayProgramme hard = DrawDay({.duty = 100.0, .speed = 0.5}, 1, 2, 20);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(hard.cycles[i].spindle_rpm, 0.5 * plain.cycles[i].spindle_rpm);
    EXPECT_EQ(hard.cycles[i].feed_duty, 1.0);
  }
}

TEST(DayProgramme, EveryPhaseIsAWholeNumberOfSteps) {
  for (int day_number = 2; day_number < 40; ++day_number) {
    const DayProgramme day = DrawDay({}, 7, day_number, 35);
    EXPECT_EQ(day.start_s % kStepSeconds, 0);
    EXPECT_GE(day.start_s, 6 * 3600);
    EXPECT_LE(day.start_s, 9 * 3600);
    for (const CyclePlan& plan : day.cycles) {
      EXPECT_EQ(plan.pause_s % kStepSeconds, 0);
      EXPECT_GE(plan.feed_duty, 0.1);
      EXPECT_LE(plan.feed_duty, 0.6 + 1e-12);
    }
  }
}

}  // namespace
}  // namespace errmap::turning_centre
