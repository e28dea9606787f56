#include "cli/turning_centre/simulation.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::turning_centre {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Simulation, VisitsEveryStopOfEveryCycle) {
  const Simulation simulation = Simulate({.days = 2, .cycles = 3});
  ASSERT_EQ(simulation.stops.size(), 2U * 3U * 4U * 17U);
  const Stop& first = simulation.stops.front();
  EXPECT_EQ(first.day, 1);
  EXPECT_EQ(first.cycle, 1);
  EXPECT_EQ(first.position(), -12.7);
  const Stop& last = simulation.stops.back();
  EXPECT_EQ(last.day, 2);
  EXPECT_EQ(last.cycle, 6);  // counts on
  EXPECT_EQ(last.slide(), Slide::kZ);
  EXPECT_EQ(last.direction(), Direction::kReverse);
  EXPECT_EQ(last.position(), -25.4);
  EXPECT_NEAR(simulation.stops[16].position(), -215.9, 1e-12);
  EXPECT_NEAR(simulation.stops[17].position(), -215.9, 1e-12);
  // A stop each five seconds, a cycle each 13 minutes.
  EXPECT_NEAR(simulation.stops[1].hours - first.hours, 5.0 / 3600.0, 1e-12);
  EXPECT_NEAR(simulation.stops[68].hours - first.hours, 780.0 / 3600.0, 1e-12);
}

TEST(Simulation, IsTheSameForTheSameSeedAndGrowsAtItsEnd) {
  const Simulation two = Simulate({.seed = 4, .days = 2, .cycles = 4});
  const Simulation three = Simulate({.seed = 4, .days = 3, .cycles = 4});
  const Simulation other = Simulate({.seed = 5, .days = 2, .cycles = 4});
  for (std::size_t i = 0; i < two.stops.size(); ++i) {
    ASSERT_EQ(two.stops[i].rise, three.stops[i].rise) << i;
    ASSERT_EQ(two.stops[i].readings, three.stops[i].readings) << i;
  }
  for (std::size_t i = 0; i < two.points.size(); ++i) {
    ASSERT_EQ(two.points[i].x, three.points[i].x) << i;
  }
  EXPECT_NE(two.stops.back().rise, other.stops.back().rise);
}

TEST(Simulation, NoiseLeavesTheMachineAsItWas) {
  const Simulation quiet =
      Simulate({.days = 2, .cycles = 3, .sensor_noise = 0.0});
  const Simulation loud =
      Simulate({.days = 2, .cycles = 3, .sensor_noise = 1.0, .noisy = {3, 4}});
  for (std::size_t i = 0; i < quiet.stops.size(); ++i) {
    ASSERT_EQ(quiet.stops[i].rise, loud.stops[i].rise) << i;
  }
  EXPECT_NE(quiet.stops[5].readings, loud.stops[5].readings);
}

TEST(Simulation, WarmsUpThroughTheDayAndCoolsOverNight) {
  const Simulation simulation = Simulate({.days = 3});
  const auto bearing = [&](int day, int cycle) {
    const auto index = static_cast<std::size_t>((day - 1) * 35 + cycle - 1);
    return simulation.stops[index * 68].rise[kBearingFront];
  };
  for (int day = 1; day <= 3; ++day) {
    // Not all day long: some end with a slow spindle.
    double warmest = bearing(day, 1);
    for (int cycle = 2; cycle <= 35; ++cycle) {
      warmest = std::max(warmest, bearing(day, cycle));
    }
    EXPECT_GT(warmest, bearing(day, 1) + 2.0) << day;
    if (day < 3) {
      EXPECT_LT(bearing(day + 1, 1), warmest - 2.0) << day;
    }
  }
}

TEST(Simulation, StartsDaysWarmFromTheSecondOn) {
  const Simulation cold = Simulate({.days = 2, .cycles = 2});
  const Simulation warm = Simulate({.days = 2, .cycles = 2, .warm_hours = 3.0});
  constexpr std::size_t kStopsOfDay = 2 * 4 * 17;
  const Stop& first_cold = cold.stops[kStopsOfDay];
  const Stop& first_warm = warm.stops[kStopsOfDay];
  EXPECT_EQ(cold.stops[0].rise, warm.stops[0].rise);
  EXPECT_EQ(first_warm.time_s() - first_cold.time_s(),
            3 * 3600 + kWarmBreakSeconds);
  const auto mean = [](const Stop& stop) {
    double sum = 0.0;
    for (const double reading : stop.readings) sum += reading;
    return sum / static_cast<double>(stop.readings.size());
  };
  EXPECT_GT(mean(first_warm), mean(first_cold) + 0.3);
}

TEST(Simulation, MoreAirKeepsTheMachineCooler) {
  const Simulation still = Simulate({.days = 1, .air_factor = 0.5});
  const Simulation windy = Simulate({.days = 1, .air_factor = 3.0});
  EXPECT_GT(still.stops.back().rise[kHeadFrontUpper],
            windy.stops.back().rise[kHeadFrontUpper] + 1.0);
}

TEST(Simulation, PointsFillTheWorkVolumeInOrderOfTime) {
  const Simulation simulation =
      Simulate({.days = 2, .cycles = 10, .points_per_day = 500});
  ASSERT_EQ(simulation.points.size(), 1000U);
  EXPECT_TRUE(std::is_sorted(
      simulation.points.begin(),
      simulation.points.end(),
      [](const auto& a, const auto& b) { return a.stop < b.stop; }));
  int both_forward = 0;
  double least_x = 0.0;
  double most_x = -1000.0;
  for (const ToolTipPoint& point : simulation.points) {
    EXPECT_GE(point.x, -215.9);
    EXPECT_LE(point.x, -12.7);
    EXPECT_GE(point.z, -431.8);
    EXPECT_LE(point.z, -25.4);
    least_x = std::min(least_x, point.x);
    most_x = std::max(most_x, point.x);
    both_forward += point.x_direction == Direction::kForward &&
                            point.z_direction == Direction::kForward
                        ? 1
                        : 0;
  }
  EXPECT_LT(least_x, -205.0);
  EXPECT_GT(most_x, -22.0);
  EXPECT_GT(both_forward, 200);
  EXPECT_LT(both_forward, 300);
}

TEST(SimulationOptions, DefaultsPassAndEachBoundBites) {
  EXPECT_NO_THROW(SimulationOptions().Validate());
  struct Case {
    std::function<void(SimulationOptions*)> spoil;
    const char* says;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Case> cases = {
      {[](auto* o) { o->days = 0; }, "days 0: give a whole number from 1"},
      {[](auto* o) { o->days = 367; }, "days 367"},
      {[](auto* o) { o->cycles = 0; }, "cycles 0: give a whole number from 1"},
      {[](auto* o) { o->cycles = 1001; }, "cycles 1001"},
      {[](auto* o) { o->days = 100, o->cycles = 101; }, "10000 cycles in all"},
      {[](auto* o) { o->points_per_day = -1; }, "points -1"},
      {[](auto* o) { o->workload.duty = -0.1; }, "duty -0.1"},
      {[](auto* o) { o->workload.speed = 5.0; }, "speed 5"},
      {[](auto* o) { o->warm_hours = -1.0; }, "warm -1"},
      {[](auto* o) { o->air_factor = 0.0; }, "air 0: conductances"},
      {[](auto* o) { o->air_factor = -2.0; }, "air -2: conductances"},
      {[](auto* o) { o->noise_um = -1.0; }, "noise -1"},
      {[=](auto* o) { o->noise_urad = nan; }, "angle-noise nan"},
      {[](auto* o) { o->sensor_noise = -1.0; }, "sensor-noise -1"},
      {[](auto* o) { o->dead = {40}; },
       "no thermocouple 40: they are numbered"},
      {[](auto* o) { o->stuck = {-1}; }, "no thermocouple -1"},
      {[](auto* o) { o->dead = {3}, o->noisy = {3}; },
       "thermocouple 3 is named twice"}};
  for (const Case& c : cases) {
    SimulationOptions options;
    c.spoil(&options);
    EXPECT_THAT([&] { Simulate(options); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(c.says)));
  }
}

}  // namespace
}  // namespace errmap::turning_centre
