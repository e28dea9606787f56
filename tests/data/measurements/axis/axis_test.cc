// The axis, its passes and the two ways along it: axis.h, motion.h and
// directions.h, by MakeDataset.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/axis/directions.h"
#include "data/measurements/axis/motion.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"
#include "tests/data/measurements/reading/warming_log.h"

namespace errmap::data {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using warming_log::Fixed;
using warming_log::Log;
using warming_log::Read;
using warming_log::Text;
using warming_log::TimePositionTempError;

// With a column of words for the two ways, that upwards first.
std::string WithWays(const Log& log,
                     const std::string& upwards,
                     const std::string& downwards) {
  int i = 0;
  return Text("direction,position_mm,t1_degC,error_um",
              log.Rows(),
              [&](const Log::Row& row) {
                std::vector<std::string> cells = TimePositionTempError(row);
                const bool up = i++ % (2 * log.positions) < log.positions;
                cells[0] = up ? upwards : downwards;
                return cells;
              });
}

TEST(Reading, TakesWhatIsCommandedForTheAxisWhateverItsName) {
  for (const std::string name : {"position_mm",
                                 "x_pos_mm",
                                 "X [mm]",
                                 "Sollposition [mm]",
                                 "Achse Z [mm]",
                                 "posizione [mm]",
                                 "axis_x_mm",
                                 "reach [mm]",
                                 "travel_um",
                                 "stroke_um",
                                 "target_um",
                                 "Soll [\u00b5m]",
                                 "Weg [um]"}) {
    const Reading reading = Read(Text("time_s," + name + ",t1_degC,error_um",
                                      Log().Rows(),
                                      TimePositionTempError));
    EXPECT_EQ(reading.position.column, name);
    EXPECT_THAT(reading.direction.values, ElementsAre("up")) << name;
    EXPECT_THAT(reading.left_out, IsEmpty()) << name;
  }
}

TEST(Reading, TakesNumbersOfPlacesForTheAxisWhereNothingElseIs) {
  for (const char* name : {"Station", "Point No.", "Messpunkt"}) {
    const Reading reading =
        Read(Text("time_s," + std::string(name) + ",t1_degC,error_um",
                  Log().Rows(),
                  [](const Log::Row& row) {
                    std::vector<std::string> cells = TimePositionTempError(row);
                    cells[1] = Fixed(row.position / 50.0 + 1.0);
                    return cells;
                  }));
    EXPECT_EQ(reading.position.column, name);
    EXPECT_FALSE(reading.position.sure);
    EXPECT_EQ(reading.cycles.count, 20);
  }
}

TEST(Reading, LeavesOutThePositionThatWasMeasuredBesideIt) {
  const auto text = [](bool at_one_place) {
    return Text("day,nominal [mm],actual [mm],t1_degC,error_um",
                Log().Rows(),
                [&](const Log::Row& row) {
                  const double nominal = at_one_place ? 100.0 : row.position;
                  return std::vector<std::string>{
                      std::to_string(row.day),
                      Fixed(nominal),
                      CsvNumber(nominal + 1e-3 * std::stod(Fixed(row.error))),
                      Fixed(row.warm),
                      Fixed(row.error)};
                });
  };
  EXPECT_EQ(Read(text(false)).position.column, "nominal [mm]");
  EXPECT_THAT(Read(text(false)).sensors, ElementsAre("t1_degC"));
  EXPECT_EQ(Read(text(true)).position.column, std::nullopt);
  const PreparedDataset one = MakeDataset(ParseCsv(text(true), "log.csv"), {});
  EXPECT_EQ(one.dataset.num_inputs(), 1);
}

TEST(Reading, FindsTheTwoWaysThroughThePositions) {
  Log log;
  log.both_ways = true;
  const std::string text = Text(
      "time_s,position_mm,t1_degC,error_um", log.Rows(), TimePositionTempError);
  const Reading reading = Read(text);
  EXPECT_THAT(reading.direction.values, ElementsAre("up", "down"));
  EXPECT_EQ(reading.direction.column, kDirectionColumn);
  EXPECT_EQ(reading.cycles.count, 20);
  const PreparedDataset up =
      MakeDataset(ParseCsv(text, "log.csv"), {.direction = "up"});
  EXPECT_EQ(up.dataset.num_rows(), 4 * 5 * 6);
  EXPECT_EQ(up.where.size(), 1U);
  EXPECT_THAT(DirectionsOf(reading, {.direction = "up"}), IsEmpty());
  EXPECT_EQ(DirectionsOf(reading, {}).size(), 2U);
}

TEST(Reading, KeepsTheWordsForTheWaysWhereTheRowsGoOtherWays) {
  Log log;
  log.both_ways = true;
  const auto rows = [&](const std::string& of, const std::string& way) {
    return MakeDataset(ParseCsv(of, "f.csv"), {.direction = way})
        .dataset.rows();
  };
  const std::string words = WithWays(log, "down", "up");
  const Reading reading = Read(words);
  EXPECT_THAT(reading.direction.labels, ElementsAre("up", "down"));
  EXPECT_FALSE(reading.direction.sure);
  EXPECT_THAT(ReadingLines(reading),
              Contains(HasSubstr("Unsure: the rows that direction calls up go "
                                 "to lower position_mm")));
  EXPECT_NE(rows(words, "up"), rows(words, "down"));
  EXPECT_EQ(rows(words, "up").front(), 6);  // the first six go down by name
  // Words that say nothing of the positions get it from the rows.
  const Reading others = Read(WithWays(log, "rev", "fwd"));
  EXPECT_THAT(others.direction.labels, ElementsAre("rev", "fwd"));
  EXPECT_TRUE(others.direction.sure);
  EXPECT_EQ(rows(WithWays(log, "rev", "fwd"), "fwd").front(), 6);
}

// Both ways at each position, one row below the other: the names alone tell.
TEST(Reading, TakesTheWayFromColumnsThatAreCalledOne) {
  struct Column {
    const char* name;
    const char* up;
    const char* down;
  };
  for (const Column& column : {Column{"backward", "FALSE", "TRUE"},
                               Column{"reversed", "no", "yes"},
                               Column{"is_up", "1", "0"},
                               Column{"R\u00fcckweg", "0", "1"},
                               Column{"verso", "andata", "ritorno"}}) {
    bool up = false;
    const std::string text =
        Text(std::string("day,cycle,way,").replace(10, 3, column.name) +
                 "position_mm,t1_degC,error_um",
             Log().Rows(),
             [&](const Log::Row& row) {
               up = !up;
               const int at = static_cast<int>(row.position / 50.0) / 2;
               return std::vector<std::string>{std::to_string(row.day),
                                               std::to_string(row.cycle),
                                               up ? column.up : column.down,
                                               std::to_string(100 * at),
                                               Fixed(row.warm),
                                               Fixed(row.error)};
             });
    const Reading reading = Read(text);
    EXPECT_EQ(reading.direction.column, column.name);
    EXPECT_THAT(reading.direction.labels, ElementsAre(column.up, column.down));
    EXPECT_TRUE(reading.direction.sure) << column.name;
  }
}

// Two points, or half of the way, and then all from the start.
TEST(Motion, BeginsAPassAnewAfterOneThatWasBrokenOff) {
  for (const int broken_off : {2, 5}) {
    std::vector<double> positions;
    for (const int points : {9, 9, broken_off, 9, 9}) {
      for (int i = 0; i < points; ++i) positions.push_back(50.0 * i);
    }
    const Motion motion = MotionThrough(LevelsOf(positions));
    EXPECT_EQ(motion.num_passes, 5) << broken_off;
    EXPECT_EQ(std::ranges::count(motion.directions, 1), std::ssize(positions));
  }
}

// Sampled in motion, no position comes again.
TEST(Axis, IsSweptToAndFroWithoutAStop) {
  std::string text = "time_s,position_mm,t1_degC,error_um\n";
  for (int i = 0; i < 900; ++i) {
    const double phase = std::fmod(i / 187.3, 1.0);
    const double x = 1000.0 * std::min(phase, 1.0 - phase);
    const double noise = 0.5 * std::sin(i * i);
    text += std::to_string(i) + "," + CsvNumber(x + noise) + "," +
            CsvNumber(20.0 + 0.002 * i) + "," +
            CsvNumber(0.01 * x + (phase < 0.5 ? 1.0 : 0.0)) + "\n";
  }
  const Reading reading = MakeDataset(ParseCsv(text, "f.csv"), {}).reading;
  EXPECT_EQ(reading.position.column, "position_mm");
  EXPECT_THAT(reading.direction.values, ElementsAre("up", "down"));
  EXPECT_EQ(reading.cycles.count, 5);
}

}  // namespace
}  // namespace errmap::data
