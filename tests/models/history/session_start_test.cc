#include "models/history/session_start.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "models/history/with_history.h"
#include "stats/distributions.h"
#include "stats/random.h"
#include "tests/models/history/history_data.h"
#include "tests/models/simulated_days.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using errmap::testing::ColumnNamed;
using errmap::testing::FirstSessions;
using errmap::testing::SimulatedDays;
using errmap::testing::WithLog;

constexpr Index kRowsOfDay = 60;
constexpr double kStepOfDay = 120.0;  // s
constexpr double kNight = 86400.0;

// Days of three thermometers in a room whose temperature differs from day to
// day: one warms by 5 degC, one by 1, one follows the room.
data::Dataset WarmingDays(Index days,
                          std::uint64_t seed,
                          double starts_at = 27000.0) {
  stats::Random random(seed);
  const auto normal = [&] {
    return stats::NormalQuantile(random.Uniform() + 0x1.0p-54);
  };
  Eigen::MatrixXd values(kRowsOfDay * days, 3);
  Eigen::VectorXd time(values.rows());
  std::vector<Index> codes;
  Index row = 0;
  for (Index day = 0; day < days; ++day) {
    const double room = 20.0 + 2.0 * normal();
    const double start =
        kNight * static_cast<double>(day) + starts_at + 900.0 * normal();
    Eigen::RowVector3d apart;
    apart << 0.15 * normal(), 0.15 * normal(), 0.15 * normal();
    for (Index i = 0; i < kRowsOfDay; ++i, ++row) {
      const double elapsed = kStepOfDay * static_cast<double>(i);
      const double warm = 1.0 - std::exp(-elapsed / 3000.0);
      time[row] = start + elapsed;
      codes.push_back(day);
      values.row(row) << room + 5.0 * warm, room + warm, room;
      values.row(row) += apart;
      for (Index k = 0; k < 3; ++k) values(row, k) += 0.02 * normal();
    }
  }
  return WithLog(
      {ColumnNamed("t1_degC"), ColumnNamed("t2_degC"), ColumnNamed("t3_degC")},
      values,
      time,
      codes);
}

History Remembering(const data::Dataset& training) {
  History history;
  history.time_unit = "s";
  for (const data::ColumnInfo& input : training.inputs()) {
    if (data::IsPosition(input)) continue;
    history.derived.push_back(Ema(input, 600.0, "s"));
    history.form_inputs.push_back(history.derived.back().column.name);
  }
  LearnStarts(training, &history);
  return history;
}

// The log of a day from this row on.
data::SessionLog FromRow(const data::SessionLog& log, Index day, Index row) {
  data::SessionLog cut;
  const Index first = day * kRowsOfDay + row;
  const Index count = kRowsOfDay - row;
  cut.sessions.codes.assign(static_cast<std::size_t>(count), 0);
  cut.sessions.labels = {"1"};
  cut.first_rows = {0};
  cut.time = log.time.segment(first, count);
  cut.time_unit = "s";
  cut.input_values = log.input_values.middleRows(first, count);
  return cut;
}

TEST(SessionStart, TellsLogsThatBeginInsideFromThoseThatBeginWithASession) {
  const History history = Remembering(WarmingDays(6, 1));
  const data::Dataset later = WarmingDays(40, 2);
  int whole = 0;
  int cut = 0;
  for (Index day = 0; day < 40; ++day) {
    whole += BeginsInside(FromRow(*later.log(), day, 0), 0, history);
    cut += BeginsInside(FromRow(*later.log(), day, kRowsOfDay / 3), 0, history);
  }
  EXPECT_LE(whole, 5);
  EXPECT_EQ(cut, 40);
}

// Of machines whose thermometers scatter together from morning to morning.
TEST(SessionStart, TellsLogsThatLackATenthOfADay) {
  constexpr Index kTrained = 6;
  int days = 0;
  int whole = 0;
  int cut = 0;
  for (const std::uint64_t seed : {15, 16, 17, 18, 19, 20}) {
    const data::Dataset all = SimulatedDays(seed, 12, 12);
    History history = Remembering(FirstSessions(all, kTrained));
    history.start_clock = std::nan("");
    data::SessionLog log = *all.log();
    std::vector<Index> columns;
    for (const std::string& name : history.columns()) {
      columns.push_back(all.FindInput(name));
    }
    log.input_values = Eigen::MatrixXd(log.input_values(Eigen::all, columns));
    for (Index day = kTrained; day < 12; ++day, ++days) {
      const auto first = std::ranges::find(log.sessions.codes, day);
      const Index row = first - log.sessions.codes.begin();
      const Index tenth = std::ranges::count(log.sessions.codes, day) / 10;
      whole += BeginsInside(log, row, history);
      cut += BeginsInside(log, row + tenth, history);
    }
  }
  EXPECT_LE(whole, days / 12) << "of " << days;
  EXPECT_GE(cut, 9 * days / 10) << "of " << days;
}

TEST(SessionStart, SaysSoOfEachRowUntilTheMemoryIsFull) {
  const History history = Remembering(WarmingDays(6, 1));
  const data::SessionLog cut =
      FromRow(*WarmingDays(1, 3).log(), 0, kRowsOfDay / 2);
  const std::vector<Missing> missing = FindMissing(cut, history);
  for (std::size_t row = 0; row < missing.size(); ++row) {
    const double since = cut.time[static_cast<Index>(row)] - cut.time[0];
    EXPECT_EQ(
        missing[row],
        since < history.settles_after() ? Missing::kStart : Missing::kNothing);
  }
  const std::vector<Missing> nothing(missing.size(), Missing::kNothing);
  EXPECT_EQ(FindMissing(cut, history, true), nothing);
}

// Thermometers that all stand as at the start, by a clock that says noon.
TEST(SessionStart, GoesByTheTimeOfTheDayWhereThatIsAHabit) {
  const History history = Remembering(WarmingDays(6, 1));
  EXPECT_NEAR(history.start_clock, 27000.0, 1800.0);
  const data::Dataset noon = WarmingDays(1, 3, 43200.0);
  EXPECT_TRUE(BeginsInside(*noon.log(), 0, history));
  History by_readings = history;
  by_readings.start_clock = std::nan("");
  EXPECT_FALSE(BeginsInside(*noon.log(), 0, by_readings));
}

TEST(SessionStart, LearnsNothingFromFewSessionsOrFromAClockThatBeginsAnew) {
  EXPECT_TRUE(Remembering(WarmingDays(3, 1)).start_readings.empty());
  const data::Dataset days = WarmingDays(6, 1);
  Eigen::VectorXd anew(days.num_rows());
  for (Index row = 0; row < anew.size(); ++row) {
    anew[row] = kStepOfDay * static_cast<double>(row % kRowsOfDay);
  }
  const History history = Remembering(WithLog(
      days.inputs(), days.input_values(), anew, days.log()->sessions.codes));
  EXPECT_TRUE(std::isnan(history.start_clock));
  EXPECT_FALSE(history.start_readings.empty());
}

TEST(SessionStart, HoldsNoDateAgainstAClockThatBeginsAnew) {
  History history = Remembering(WarmingDays(6, 1));
  history.latest_start = 600.0;
  history.start_limit = history.start_clock = std::nan("");
  const data::Dataset days = WarmingDays(2, 3);
  EXPECT_TRUE(BeginsInside(*days.log(), 0, history));  // 7.5 h on that clock
  EXPECT_FALSE(BeginsInside(*days.log(), kRowsOfDay, history));  // the 2nd day
}

}  // namespace
}  // namespace errmap::models
