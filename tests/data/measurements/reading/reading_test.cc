// Times, cycles and sessions, by MakeDataset.

#include "data/measurements/reading/reading.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "tests/data/measurements/reading/warming_log.h"

namespace errmap::data {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;
using warming_log::Fixed;
using warming_log::Log;
using warming_log::Read;
using warming_log::Text;
using warming_log::TimePositionTempError;

// What reads a word back asks each number for its name.
TEST(Evidence, HasNoNameBeyondTheLast) {
  EXPECT_EQ(ToString(Evidence::kNameAndValues), "name+values");
  for (int i = 5; i < 256; ++i) {
    EXPECT_EQ(ToString(static_cast<Evidence>(i)), "");
  }
}

// The remarks on a log of four days; `change` may alter a row.
std::vector<std::string> RemarksOn(
    const std::function<void(Log::Row*)>& change) {
  std::vector<Log::Row> rows = Log().Rows();
  for (Log::Row& row : rows) change(&row);
  const std::string text =
      Text("time_s,position_mm,t1_degC,error_um", rows, TimePositionTempError);
  return MakeDataset(ParseCsv(text, "log.csv"), {}).remarks;
}

TEST(Reading, NamesASessionInAnotherUnit) {
  EXPECT_THAT(RemarksOn([](Log::Row* row) {
                if (row->day == 2) row->position /= 25.4;
              }),
              ElementsAre("position_mm is 0 to 9.84 in session 3, as if its "
                          "unit were 'in' there, and 0 to 250 in session 2"));
  EXPECT_THAT(RemarksOn([](Log::Row* row) {
                if (row->day == 1) row->warm = 1.8 * row->warm + 32.0;
              }),
              Contains(HasSubstr("in session 2, as if its unit were 'degF'")));
  // From a day on, and up to one.
  EXPECT_THAT(RemarksOn([](Log::Row* row) {
                if (row->day > 1) row->warm = 1.8 * row->warm + 32.0;
              }),
              Contains(HasSubstr("in session 3, as if its unit were 'degF'")));
  EXPECT_THAT(RemarksOn([](Log::Row* row) {
                if (row->day < 2) row->warm = 1.8 * row->warm + 32.0;
              }),
              Contains(HasSubstr("in session 2, as if its unit were 'degF'")));
  // Of no unit in its name.
  const std::string text = Text("time_s,position_mm,t1_temp,error_um",
                                Log().Rows(),
                                [](const Log::Row& row) {
                                  std::vector<std::string> cells =
                                      TimePositionTempError(row);
                                  if (row.day == 1) {
                                    cells[2] = Fixed(1.8 * row.warm + 32.0);
                                  }
                                  return cells;
                                });
  EXPECT_THAT(MakeDataset(ParseCsv(text, "log.csv"), {}).remarks,
              Contains(HasSubstr("in session 2, as if its unit were 'degF'")));
  // A short travel and a hot day are none.
  for (const double factor : {0.5, 0.8}) {
    EXPECT_THAT(RemarksOn([&](Log::Row* row) {
                  if (row->day == 2) row->position *= factor;
                  if (row->day == 3) row->warm += 20.0;
                }),
                Not(Contains(HasSubstr("as if its unit"))));
  }
}

TEST(Reading, CountsNoCycleWithoutAName) {
  std::string text = Text("day,cycle,position_mm,t1_degC,error_um",
                          Log().Rows(),
                          [](const Log::Row& row) -> std::vector<std::string> {
                            return {std::to_string(row.day),
                                    std::to_string(row.cycle),
                                    Fixed(row.position),
                                    Fixed(row.warm),
                                    Fixed(row.error)};
                          });
  text += "3,,,22.1,1.5\n";  // the means of a sheet
  EXPECT_EQ(Read(text, {.missing = MissingPolicy::kDropRows}).cycles.count, 20);
}

TEST(Reading, TakesCountsThatComeAgainForTheAxis) {
  const auto read = [](const std::string& name) {
    return Read(Text("time_s," + name + ",t1_degC,error_um",
                     Log().Rows(),
                     TimePositionTempError));
  };
  EXPECT_EQ(read("Encoder (counts)").position.column, "Encoder (counts)");
  EXPECT_EQ(read("Load (N)").position.column, std::nullopt);
}

TEST(Reading, PartsNoPassByABreakOfHours) {
  std::vector<Log::Row> rows = Log().Rows();
  // In the second day's last pass the logger stood, or its clock was set.
  for (std::size_t i = 57; i < rows.size(); ++i) rows[i].time += 3.0 * 3600.0;
  const Reading reading = Read(
      Text("time_s,position_mm,t1_degC,error_um", rows, TimePositionTempError));
  EXPECT_EQ(reading.sessions.count, 4);
  EXPECT_EQ(reading.cycles.count, 20);
}

TEST(Reading, PartsSessionsByNightsAndNotByPausesOfOneOrder) {
  for (const double pause : {60.0, 300.0, 1200.0, 3600.0}) {
    for (const double night : {15000.0, 50000.0, 200000.0}) {
      if (4.0 * pause > night) continue;
      Log log;
      log.pause = pause;
      log.night = night;
      const Reading reading = Read(Text("time_s,position_mm,t1_degC,error_um",
                                        log.Rows(),
                                        TimePositionTempError));
      EXPECT_EQ(reading.sessions.count, 4) << pause << " " << night;
      EXPECT_EQ(reading.sessions.by, "nights");
      EXPECT_THAT(reading.sessions.first_rows, ElementsAre(0, 30, 60, 90));
      EXPECT_EQ(reading.cycles.count, 20);
      EXPECT_EQ(reading.cycles.by, "position");
      EXPECT_TRUE(reading.sessions.sure);
    }
  }
}

TEST(Reading, EndsASessionWhereANightBreaksAPass) {
  std::vector<Log::Row> rows = Log{.days = 1, .cycles = 20}.Rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i >= 62) rows[i].time += 50000.0;  // behind the second of six positions
  }
  const Reading reading = Read(
      Text("time_s,position_mm,t1_degC,error_um", rows, TimePositionTempError));
  EXPECT_EQ(reading.sessions.by, "nights");
  EXPECT_THAT(reading.sessions.first_rows, ElementsAre(0, 62));
}

TEST(Reading, TakesOneRunOfOneDayForOneSession) {
  Log log;
  log.days = 1;
  const Reading reading = Read(Text("time_s,position_mm,t1_degC,error_um",
                                    log.Rows(),
                                    TimePositionTempError));
  EXPECT_EQ(reading.sessions.count, 1);
  EXPECT_EQ(reading.cycles.count, 5);
}

TEST(Reading, FindsTheUnitOfTimeByStepsAndSpan) {
  struct Clock {
    const char* name;
    double factor;
    double offset;
    const char* unit;
  };
  for (const Clock& clock :
       {Clock{"time_s", 1.0, 0.0, "s"},
        Clock{"time_ms", 1e3, 0.0, "ms"},
        Clock{"time_min", 1.0 / 60.0, 0.0, "min"},
        Clock{"t (h)", 1.0 / 3600.0, 0.0, "h"},
        Clock{"timestamp", 1.0, 1.7724384e9, "s"},
        Clock{"timestamp", 1e3, 1.7724384e12, "ms"},
        Clock{"stamp", 1e6, 1.7724384e15, "us"},
        Clock{"Datum", 1.0 / 86400.0, 46083.0, "Excel days"}}) {
    const Reading reading =
        Read(Text(std::string(clock.name) + ",position_mm,t1_degC,error_um",
                  Log().Rows(),
                  [&](const Log::Row& row) {
                    std::vector<std::string> cells = TimePositionTempError(row);
                    cells[0] =
                        CsvNumber(clock.factor * row.time + clock.offset);
                    return cells;
                  }));
    EXPECT_EQ(reading.time.column, clock.name);
    EXPECT_EQ(reading.time.unit, clock.unit) << clock.name;
    EXPECT_NEAR(reading.time.step_s.value_or(0.0), 10.0, 1e-2) << clock.name;
    EXPECT_EQ(reading.sessions.count, 4) << clock.name;
    EXPECT_THAT(reading.sensors, ElementsAre("t1_degC")) << clock.name;
  }
}

// Two shifts a day, and the cycles of each from 1 on.
TEST(Reading, PartsDaysWhereCyclesCountAnewInAnotherShift) {
  for (const bool dated : {true, false}) {
    const std::string text =
        Text(dated ? "Date,Shift,Cycle,position_mm,t1_degC,error_um"
                   : "Day,Session,Cycle,position_mm,t1_degC,error_um",
             Log().Rows(),
             [&](const Log::Row& row) {
               const std::string day = std::to_string(1 + row.day / 2);
               return std::vector<std::string>{
                   dated ? "2024-03-0" + day : day,
                   dated ? (row.day % 2 == 0 ? "A" : "B")
                         : std::to_string(1 + row.day % 2),
                   std::to_string(1 + row.cycle % 5),
                   Fixed(row.position),
                   Fixed(row.warm),
                   Fixed(row.error)};
             });
    const Reading reading = Read(text);
    EXPECT_EQ(reading.sessions.count, 4) << dated;
    EXPECT_EQ(reading.cycles.count, 20) << dated;
  }
}

TEST(Reading, BeginsASessionWhereTheCyclesCountAnew) {
  const Reading reading = Read(Text("cycle,position_mm,t1_degC,error_um",
                                    Log().Rows(),
                                    [](const Log::Row& row) {
                                      return std::vector<std::string>{
                                          std::to_string(row.cycle % 5 + 1),
                                          Fixed(row.position),
                                          Fixed(row.warm),
                                          Fixed(row.error)};
                                    }));
  EXPECT_EQ(reading.sessions.by, "counter");
  EXPECT_EQ(reading.sessions.count, 4);
  EXPECT_EQ(reading.cycles.count, 20);
}

std::vector<std::string> PositionTempError(const Log::Row& row) {
  return {Fixed(row.position), Fixed(row.warm), Fixed(row.error)};
}

TEST(Reading, BeginsASessionWhereTemperaturesFallBackToRest) {
  for (const int days : {2, 4, 7}) {
    Log log;
    log.days = days;
    log.cycles = 8;
    const std::string text =
        Text("position_mm,t1_degC,error_um", log.Rows(), PositionTempError);
    const Reading reading = Read(text);
    EXPECT_EQ(reading.sessions.by, "rest") << days;
    EXPECT_EQ(reading.sessions.count, days);
    EXPECT_EQ(reading.sessions.first_rows[1], 8 * log.positions);
    EXPECT_FALSE(reading.sessions.sure);
    EXPECT_THAT(ReadingLines(reading),
                Contains(HasSubstr("back at rest); or one")));
    EXPECT_EQ(Read(text, {.session = "none"}).sessions.count, 1);
  }
  Log one;
  one.days = 1;
  one.cycles = 30;
  one.pause = 2000.0;
  const Reading reading =
      Read(Text("position_mm,t1_degC,error_um", one.Rows(), PositionTempError));
  EXPECT_EQ(reading.sessions.count, 1);
  EXPECT_TRUE(reading.sessions.sure);
}

TEST(Reading, IsUnsureOfSessionsWhereTemperaturesFallHalfway) {
  // A pause cools by half, in one or in each cycle.
  const auto read = [](int each) {
    Log log;
    log.days = 1;
    log.cycles = 12;
    return Read(Text(
        "position_mm,t1_degC,error_um", log.Rows(), [=](const Log::Row& row) {
          const double warm = 24.0 +
                              2.0 * (row.cycle / each % 2 == 0 ? 1.0 : 0.0) +
                              0.001 * row.position;
          return std::vector<std::string>{
              Fixed(row.position), Fixed(warm), Fixed(row.error)};
        }));
  };
  for (const int each : {1, 6}) {
    const Reading reading = read(each);
    EXPECT_EQ(reading.sessions.count, each == 6 ? 2 : 1) << each;
    EXPECT_FALSE(reading.sessions.sure) << each;
  }
}

TEST(Reading, SeesNoRestInSpikesOfOneThermometer) {
  int at = 0;
  Log log;
  log.days = 1;
  log.cycles = 12;
  const Reading reading = Read(Text(
      "position_mm,t1_degC,error_um", log.Rows(), [&](const Log::Row& row) {
        const double warm = at++ % 20 == 0 ? 85.0 : row.warm;
        return std::vector<std::string>{
            Fixed(row.position), Fixed(warm), Fixed(row.error)};
      }));
  EXPECT_EQ(reading.sessions.count, 1);
}

TEST(Reading, KeepsARunningNumberOutWhateverItsName) {
  for (const std::string name : {"scan", "shot", "epoch", "n", "xyz"}) {
    int row_number = 0;
    const Reading reading =
        Read(Text("day," + name + ",position_mm,t1_degC,error_um",
                  Log().Rows(),
                  [&](const Log::Row& row) {
                    return std::vector<std::string>{
                        std::to_string(row.day),
                        std::to_string(30000 + 3 * row_number++),
                        Fixed(row.position),
                        Fixed(row.warm),
                        Fixed(row.error)};
                  }));
    EXPECT_THAT(reading.sensors, ElementsAre("t1_degC")) << name;
  }
}

TEST(Reading, GoesOnOverMidnight) {
  // Shifts from 21:00 on, by a clock without dates.
  Log log;
  log.step = 600.0;
  log.pause = 600.0;
  log.cycles = 8;
  const double shift = log.cycles * (log.positions * log.step + log.pause);
  log.night = 86400.0 - shift;
  const Reading reading = Read(Text(
      "time,position_mm,t1_degC,error_um", log.Rows(), [](const Log::Row& row) {
        const auto minutes =
            static_cast<int>((row.time - 1000.0) / 60.0) + 21 * 60;
        const auto two = [](int number) {
          return std::string(number < 10 ? "0" : "") + std::to_string(number);
        };
        std::vector<std::string> cells = TimePositionTempError(row);
        cells[0] = two(minutes / 60 % 24) + ":" + two(minutes % 60) + ":00";
        return cells;
      }));
  EXPECT_EQ(reading.sessions.count, 4);
  EXPECT_EQ(reading.cycles.count, 32);
}

// Days of cycles from 8:00 on, each day some 18 minutes later than the one
// before, but the third an hour later than its end; seconds of the day.
std::vector<Log::Row> InSecondsOfTheDay() {
  std::vector<Log::Row> rows = Log().Rows();
  double begin = 0.0;
  for (Log::Row& row : rows) {
    if (row.cycle % 5 == 0 && row.position == 0.0) begin = row.time;
    row.time +=
        28800.0 + 1083.0 * row.day + (row.day > 1 ? 3600.0 : 0.0) - begin;
  }
  return rows;
}

std::vector<std::string> DayAndRow(const Log::Row& row) {
  std::vector<std::string> cells = TimePositionTempError(row);
  cells.insert(cells.begin(), std::to_string(62 + row.day));
  return cells;
}

TEST(Reading, TakesBlocksForSessionsWhereAClockOfHoursHidesOne) {
  const Reading reading = Read(Text("doy,time_s,position_mm,t1_degC,error_um",
                                    InSecondsOfTheDay(),
                                    DayAndRow));
  EXPECT_EQ(reading.sessions.count, 4);
  EXPECT_EQ(reading.sessions.column, "doy");
  EXPECT_FALSE(reading.sessions.sure);
  EXPECT_EQ(reading.sessions.alternative, "3, where 'time_s' goes back");
  // Workpieces that change in the day, too, tell no nights.
  const Reading halves =
      Read(Text("lot,time_s,position_mm,t1_degC,error_um",
                InSecondsOfTheDay(),
                [](const Log::Row& row) {
                  std::vector<std::string> cells = DayAndRow(row);
                  cells[0] = std::to_string(2 * row.day + row.cycle % 5 / 3);
                  return cells;
                }));
  EXPECT_EQ(halves.sessions.count, 3);
}

TEST(Reading, TakesSecondsOfTheDayForTheTimeWhateverTheirName) {
  const Reading reading = Read(Text(
      "doy,sod,position_mm,t1_degC,error_um", InSecondsOfTheDay(), DayAndRow));
  EXPECT_EQ(reading.time.column, "sod");
  EXPECT_THAT(reading.sensors, ElementsAre("t1_degC"));
}

TEST(Reading, TakesNoAxisThatIsInTwoPlacesAtATime) {
  std::vector<Log::Row> rows = Log{.cycles = 1, .positions = 60}.Rows();
  for (Log::Row& row : rows) row.time -= rows[60].time * row.day;
  const Reading reading = Read(
      Text("Test day,time_s,t1_degC,error_um", rows, [](const Log::Row& row) {
        return std::vector<std::string>{std::to_string(row.day + 1),
                                        Fixed(std::round(row.position / 5.0)),
                                        Fixed(row.warm),
                                        Fixed(row.error)};
      }));
  EXPECT_EQ(reading.position.column, std::nullopt);
  EXPECT_EQ(reading.sessions.count, 4);
  EXPECT_EQ(reading.time.step_s, 10.0);
}

// Rows with a clock of dates, of which these lack it.
std::string WithoutTime(const std::function<bool(int)>& lacks) {
  int at = 0;
  return Text("position_mm,stamp,t1_degC,error_um",
              Log().Rows(),
              [&](const Log::Row& row) {
                std::vector<std::string> cells = TimePositionTempError(row);
                std::swap(cells[0], cells[1]);
                const auto minutes = static_cast<int>(row.time / 60.0);
                const auto two = [](int number) {
                  return std::string(number < 10 ? "0" : "") +
                         std::to_string(number);
                };
                cells[1] = "2024-03-" + two(1 + minutes / 1440) + " " +
                           two(minutes / 60 % 24) + ":" + two(minutes % 60);
                if (lacks(at++)) cells[1] = "";
                return cells;
              });
}

TEST(Reading, AsksForTheTimeThatFewRowsLack) {
  const std::string text = WithoutTime([](int row) { return row == 44; });
  EXPECT_THAT([&] { Read(text); },
              ThrowsMessage<InputError>(HasSubstr(
                  "line 46 (data row 44), column 'stamp': empty cell; fill it "
                  "in, or drop such rows with ")));
  const Reading reading = Read(text, {.missing = MissingPolicy::kDropRows});
  EXPECT_EQ(reading.sessions.count, 4);
  EXPECT_EQ(reading.time.column, "stamp");
  // A column that says the time here and there is no clock.
  EXPECT_EQ(Read(WithoutTime([](int row) { return row % 6 != 0; })).time.column,
            std::nullopt);
}

TEST(Reading, CountsNoCycleOfRowsWithoutATime) {
  std::string text;
  int lines = 0;
  for (const char c : WithoutTime([](int) { return false; })) {
    text += c;
    const bool ends_day = c == '\n' && lines++ > 0 && lines % 30 == 1;
    if (ends_day) text += ",,22.1,1.5\n";  // its means
  }
  EXPECT_EQ(Read(text, {.missing = MissingPolicy::kDropRows}).cycles.count, 20);
}

TEST(Reading, TakesTheAxisThatIsNamed) {
  const std::string text =
      Text("x_mm,y_mm,,t1_degC,T_set_degC,error_um",
           Log().Rows(),
           [](const Log::Row& row) {
             return std::vector<std::string>{Fixed(row.position),
                                             Fixed(0.75 * row.position),
                                             Fixed(row.position + 1.0),
                                             Fixed(row.warm),
                                             std::to_string(20 + row.day % 2),
                                             Fixed(row.error)};
           });
  const PreparedDataset made =
      MakeDataset(ParseCsv(text, "log.csv"), {.position = "y_mm"});
  EXPECT_EQ(made.dataset.inputs()[0].name, "y_mm");
  EXPECT_THAT(made.reading.sensors, ElementsAre("t1_degC"));
  EXPECT_EQ(Read(text, {.position = "column_3"}).position.column, "column_3");
  EXPECT_THAT([&] { Read(text, {.position = "t1_degC"}); },
              ThrowsMessage<InputError>(HasSubstr("is no position")));
}

TEST(Reading, ListsTheOtherAxesAmongTheInputs) {
  const Reading reading = Read(Text(
      "time_s,x_mm,y_mm,SpindleRPM,t1_degC,error_um",
      Log().Rows(),
      [](const Log::Row& row) {
        return std::vector<std::string>{Fixed(row.time),
                                        Fixed(row.position),
                                        Fixed(0.75 * row.position),
                                        Fixed(1000.0 + 200.0 * (row.cycle % 4)),
                                        Fixed(row.warm),
                                        Fixed(row.error)};
      }));
  EXPECT_EQ(reading.position.column, "x_mm");
  EXPECT_THAT(reading.positions, ElementsAre("y_mm"));
  EXPECT_THAT(reading.sensors, ElementsAre("SpindleRPM", "t1_degC"));
}

TEST(Reading, TellsTheStepWithinTheMinutesOfAClock) {
  const Reading reading = Read(
      Text("time,position_mm,t1_degC,error_um",
           Log{.step = 12.0}.Rows(),
           [](const Log::Row& row) {
             const auto minute = static_cast<int>(row.time / 60.0);
             const std::string two = std::to_string(100 + minute % 60);
             return std::vector<std::string>{
                 "2024-03-0" + std::to_string(1 + minute / 1440) + " " +
                     std::to_string(minute / 60 % 24) + ":" + two.substr(1),
                 Fixed(row.position),
                 Fixed(row.warm),
                 Fixed(row.error)};
           }));
  EXPECT_NEAR(reading.time.step_s.value(), 12.0, 1.0);
}

TEST(Reading, KeepsTheClockOfATableWithAColumnForEachPosition) {
  std::string text = "t_min,E_0,E_50,E_100,T1\n";
  for (int i = 0; i < 30; ++i) {
    text += Fixed(2.3 * i) + "," + Fixed(0.1 * i) + ",1.5,2.5,20.1\n";
  }
  const Reading reading = Read(text, {.target = "error [um]"});
  EXPECT_EQ(reading.rows, 90);
  EXPECT_EQ(reading.time.column, "t_min");
}

TEST(Reading, LeavesOutWhatReadsAnAxisThatStands) {
  const Reading reading = Read(Text(
      "Nom X,Nom Y,Act Y,T1,error_um", Log().Rows(), [](const Log::Row& row) {
        return std::vector<std::string>{Fixed(row.position),
                                        "250",
                                        Fixed(250.0 + 1e-3 * row.warm),
                                        Fixed(row.warm),
                                        Fixed(row.error)};
      }));
  EXPECT_THAT(reading.sensors, ElementsAre("T1"));
}

}  // namespace
}  // namespace errmap::data
