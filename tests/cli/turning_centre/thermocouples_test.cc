#include "cli/turning_centre/thermocouples.h"

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "cli/turning_centre/day_programme.h"
#include "data/csv.h"
#include "tests/places.h"

namespace errmap::turning_centre {
namespace {

using data::CsvTable;
using data::ReadCsv;

constexpr double kResolution = 0.01;
constexpr double kNoise = 0.02;

using Faults = std::array<SensorFault, kNumThermocouples>;

// Readings of a machine at 30 degC throughout, once a cycle of an hour.
std::vector<Thermocouples::Readings> Watch(const Faults& faults,
                                           double noise_sd = kNoise,
                                           int cycles = 200) {
  Thermocouples thermocouples(1, noise_sd, faults, cycles);
  const std::vector<double> temperatures(kNumBodies, 30.0);
  thermocouples.StartDay(1, temperatures, 30.0);
  std::vector<Thermocouples::Readings> readings;
  for (int cycle = 1; cycle <= cycles; ++cycle) {
    thermocouples.Step(temperatures, 30.0);
    readings.push_back(thermocouples.Read(cycle, cycle));
  }
  return readings;
}

double Sd(const std::vector<Thermocouples::Readings>& readings,
          std::size_t sensor) {
  double sum = 0.0;
  double sum_2 = 0.0;
  for (const auto& reading : readings) {
    sum += reading[sensor];
    sum_2 += reading[sensor] * reading[sensor];
  }
  const auto n = static_cast<double>(readings.size());
  return std::sqrt(sum_2 / n - sum * sum / (n * n));
}

TEST(Thermocouples, SitesAreThoseOfTheShippedTable) {
  const CsvTable table =
      ReadCsv(tests::SourceDir() + "/data/sets/nistir5367_table1.csv");
  ASSERT_EQ(table.num_rows, kNumThermocouples);
  ASSERT_EQ(table.columns.size(), 3U);
  EXPECT_EQ(table.columns[0].name, "number");
  EXPECT_EQ(table.columns[1].name, "location");
  EXPECT_EQ(table.columns[2].name, "axis");
  for (std::size_t i = 0; i < kNumThermocouples; ++i) {
    const ThermocoupleSite& site = ThermocoupleSites()[i];
    EXPECT_EQ(table.columns[0].values[i], static_cast<double>(i));
    EXPECT_EQ(table.CellText(table.columns[1], i), site.location);
    EXPECT_EQ(table.CellText(table.columns[2], i), site.axis);
  }
}

TEST(Thermocouples, AxesAreThoseOfTheReportsRuns) {
  // Sections 9.3 and 9.5, 9.4 and 9.6.
  const std::set<std::size_t> x = {0, 1, 11, 12, 13, 14, 35, 38};
  const std::set<std::size_t> z = {
      7, 8, 9, 10, 15, 16, 17, 18, 20, 21, 22, 23, 36, 37, 39};
  for (std::size_t i = 0; i < kNumThermocouples; ++i) {
    EXPECT_EQ(ThermocoupleSites()[i].axis == "x", x.count(i) == 1) << i;
    EXPECT_EQ(ThermocoupleSites()[i].axis == "z", z.count(i) == 1) << i;
  }
}

TEST(Thermocouples, ReadTheirSiteWithGainOffsetNoiseAndResolution) {
  const auto readings = Watch({});
  for (std::size_t i = 0; i < kNumThermocouples; ++i) {
    // Offset 0.2, gain 0.3 % of 30: four standard deviations of their sum.
    EXPECT_NEAR(readings[0][i], 30.0, 0.9) << i;
    // The noise and the rounding; 200 readings fix a standard deviation to 5 %.
    EXPECT_NEAR(Sd(readings, i),
                std::sqrt(kNoise * kNoise + kResolution * kResolution / 12.0),
                4.0 * 0.05 * kNoise)
        << i;
    const double steps = readings[7][i] / kResolution;
    EXPECT_NEAR(steps, std::round(steps), 1e-9) << i;
  }
  EXPECT_NE(readings[0][0], readings[0][1]);
}

TEST(Thermocouples, FaultsDoWhatTheySay) {
  Faults faults{};
  faults[3] = SensorFault::kDead;
  faults[7] = SensorFault::kStuck;
  faults[9] = SensorFault::kDrifting;
  faults[11] = SensorFault::kNoisy;
  const auto good = Watch({});
  const auto bad = Watch(faults);
  for (std::size_t i = 0; i < kNumThermocouples; ++i) {
    if (faults[i] != SensorFault::kNone) continue;
    // A fault of one sensor leaves the others as they were.
    for (std::size_t k = 0; k < good.size(); ++k) {
      ASSERT_EQ(bad[k][i], good[k][i]) << i;
    }
  }
  for (const auto& reading : bad) EXPECT_EQ(reading[3], 0.0);
  // From some cycle on the same; before it, as the sound sensor.
  std::size_t first_stuck = bad.size() - 1;
  while (first_stuck > 0 && bad[first_stuck - 1][7] == bad.back()[7]) {
    --first_stuck;
  }
  EXPECT_LT(first_stuck, bad.size() - 10);
  for (std::size_t k = 0; k < first_stuck; ++k) {
    EXPECT_EQ(bad[k][7], good[k][7]);
  }
  for (const std::size_t k : {0U, 99U, 199U}) {
    EXPECT_NEAR(bad[k][9] - good[k][9],
                kDriftPerHour * static_cast<double>(k + 1),
                kResolution);
  }
  EXPECT_GT(Sd(bad, 11), 0.8 * kNoisyFactor * kNoise);
}

TEST(Thermocouples, ALogChangesNoReading) {
  Faults faults{};
  faults[7] = SensorFault::kStuck;
  const std::vector<double> warm(kNumBodies, 30.0);
  Thermocouples logged(1, kNoise, faults, 1);
  Thermocouples plain(1, kNoise, faults, 1);
  for (Thermocouples* one : {&logged, &plain}) one->StartDay(1, warm, 30.0);
  const Thermocouples::Readings before = logged.Log(0.0);
  const Thermocouples::Readings stop = logged.Read(0.0, 1);
  const Thermocouples::Readings after = logged.Log(0.0);
  EXPECT_EQ(stop, plain.Read(0.0, 1));
  EXPECT_EQ(logged.Read(0.1, 1), plain.Read(0.1, 1));
  EXPECT_NE(before, after);
  EXPECT_NEAR(before[0], stop[0], 8.0 * kNoise);
  // Stuck from the first stop on, not before it.
  EXPECT_NE(before[7], stop[7]);
  EXPECT_EQ(after[7], stop[7]);
}

TEST(Thermocouples, FollowAStepWithinTheirTimeConstant) {
  Thermocouples thermocouples(1, 0.0, {}, 1);
  thermocouples.StartDay(1, std::vector<double>(kNumBodies, 20.0), 20.0);
  const double before = thermocouples.Read(0.0, 1)[6];
  const std::vector<double> hot(kNumBodies, 30.0);
  // From 20 to 30 degC within one step, then constant.
  thermocouples.Step(hot, 30.0);
  const double soon = thermocouples.Read(0.0, 1)[6];
  for (int i = 0; i < 200; ++i) thermocouples.Step(hot, 30.0);
  const double late = thermocouples.Read(0.0, 1)[6];
  EXPECT_GT(soon, before);
  EXPECT_LT(soon, before + 4.0);
  EXPECT_NEAR(late - before, 10.0, 0.2);  // the gain
}

}  // namespace
}  // namespace errmap::turning_centre
