#include "data/measurements/clock/clock.h"

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/input_error.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"

namespace errmap::data {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// Three days of four cycles to and fro over five positions; what stands in the
// first columns of row i of 120 is given.
using BeginOfRow = std::function<std::string(int row, double warm)>;

std::string Days(const std::string& header, const BeginOfRow& cells) {
  std::string text = header + ",x [mm],error [um]\n";
  for (int i = 0; i < 120; ++i) {
    const int cycle = i / 10 % 4;
    const int at = i % 10 < 5 ? i % 10 : 9 - i % 10;
    const double warm = 20.0 + 2.0 * cycle + i / 40;
    const double noise = std::sin(12.9898 * (i + 1)) * 1e4;
    const double error = 0.01 * at * (warm - 20.0) + (i % 10 < 5 ? 2.0 : -2.0) +
                         0.1 * (noise - std::floor(noise));
    text += cells(i, warm) + "," + std::to_string(100 * at) + "," +
            CsvNumber(error) + "\n";
  }
  return text;
}

PreparedDataset MadeOf(const std::string& text,
                       const DatasetSelection& selection = {}) {
  return MakeDataset(ParseCsv(text, "f.csv"), selection);
}

std::string TwoDigits(int number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

// From 8:00 on.
std::string HourOf(int minutes) {
  return TwoDigits(8 + minutes / 60) + ":" + TwoDigits(minutes % 60);
}

// Rows 30 s apart in a unit of so many seconds, counted from `first`.
PreparedDataset CountedIn(const std::string& name,
                          double seconds,
                          double first) {
  return MadeOf(Days(name, [&](int i, double /*warm*/) {
    const double elapsed = 30.0 * i + 54000.0 * (i / 40);
    return std::to_string(first + elapsed / seconds);
  }));
}

TEST(Clock, CountsInTheUnitThatItsNameStates) {
  for (const char* name : {"t [d]", "Time (days)"}) {
    const Reading reading = CountedIn(name, 86400.0, 0.0).reading;
    EXPECT_EQ(reading.time.column, name);
    EXPECT_EQ(reading.time.unit, "days");
    EXPECT_TRUE(reading.time.sure);
    EXPECT_NEAR(*reading.time.step_s, 30.0, 0.1);
  }
}

TEST(Clock, IsCalledByItsUnitInSeveralLanguages) {
  const std::vector<std::pair<const char*, double>> units = {
      {"secs", 1.0},
      {"seconds since start", 1.0},
      {"sec_of_run", 1.0},
      {"Minuten", 60.0},
      {"minute", 60.0},
      {"hours", 3600.0},
      {"Stunden", 3600.0},
      {"heures", 3600.0},
      {"ore", 3600.0},
      {"Tage", 86400.0}};
  for (const auto& [name, seconds] : units) {
    const Reading reading = CountedIn(name, seconds, 0.0).reading;
    EXPECT_EQ(reading.time.column, name);
    EXPECT_NEAR(*reading.time.step_s, 30.0, 0.1) << name;
    EXPECT_EQ(reading.sessions.count, 3) << name;
  }
}

// 2024-03-04 08:00 in the days of astronomers and of computers.
TEST(Clock, KnowsTheDaysOfAstronomers) {
  const double days = 19786.0 + 8.0 / 24.0;  // from 1970
  for (const auto& [name, first] : std::vector<std::pair<const char*, double>>{
           {"MJD", days + 40587.0},
           {"JD", days + 2440587.5},
           {"BJD_TDB", days + 2440587.5},
           {"days since 1970", days}}) {
    const Reading reading = CountedIn(name, 86400.0, first).reading;
    EXPECT_EQ(reading.time.column, name);
    EXPECT_EQ(reading.time.origin, "1970") << name;
    EXPECT_NEAR(*reading.time.step_s, 30.0, 0.2) << name;
    EXPECT_EQ(reading.sessions.count, 3) << name;
  }
}

// As a spreadsheet shows a clock: 59:58.0 is followed by 00:28.0.
TEST(Clock, IsRefusedWithoutItsHours) {
  const auto shown = [](int i, double /*warm*/) {
    const int seconds = 298 * i;
    return TwoDigits(seconds / 60 % 60) + ":" + TwoDigits(seconds % 60) + ".0";
  };
  try {
    MadeOf(Days("Time", shown));
    ADD_FAILURE() << "hours are guessed";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the hours are missing"));
    EXPECT_THAT(error.what(), HasSubstr("time = none"));
  }
}

// Hours that are lost behind a pause, too; what begins anew begins as before.
TEST(Clock, IsRefusedWhereItBeginsElsewhere) {
  const auto shown = [](int pause) {
    return [pause](int i, double /*warm*/) {
      const int seconds = 20 * (i % 40) + pause * (i / 40);
      return TwoDigits(seconds / 60 % 60) + ":" + TwoDigits(seconds % 60) +
             ".0";
    };
  };
  EXPECT_EQ(MadeOf(Days("Time", shown(0))).reading.sessions.count, 3);
  try {
    MadeOf(Days("Time", shown(2500)));
    ADD_FAILURE() << "hours are guessed";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the hours are missing"));
  }
}

TEST(Clock, IsNoDurationBesideADate) {
  const Reading reading =
      MadeOf(Days("Date,Settling time (s)", [](int i, double /*warm*/) {
        return "2024-03-1" + std::to_string(i / 40) + "," +
               CsvNumber(2.0 + 0.01 * (i * 37 % 101));
      })).reading;
  EXPECT_EQ(reading.time.column, std::nullopt);
  EXPECT_EQ(reading.sessions.by, "dates");
  EXPECT_EQ(reading.sessions.count, 3);
}

// Of a machine: they are not temperatures.
TEST(Clock, IsWhatHoursByTheirNameAre) {
  const PreparedDataset made =
      MadeOf(Days("Zeit,Betriebsstunden,T1 [degC]", [](int i, double warm) {
        const int minutes = 5 * (i % 40);
        return "2024-03-1" + std::to_string(i / 40) + " " + HourOf(minutes) +
               ":00," + CsvNumber(5120.0 + 24 * (i / 40) + minutes / 60) + "," +
               CsvNumber(warm + 0.01 * (i % 7));
      }));
  EXPECT_THAT(made.reading.sensors, ElementsAre("T1 [degC]"));
}

TEST(Clock, IsNotWhatCountsPerMinute) {
  for (const std::string name : {"Giri/min", "U/min", "tr/min"}) {
    const PreparedDataset made =
        MadeOf(Days("Zeit," + name, [](int i, double /*warm*/) {
          return "2024-03-1" + std::to_string(i / 40) + " " +
                 HourOf(5 * (i % 40)) + ":00," +
                 std::to_string(2000 * (i / 7 % 3));
        }));
    EXPECT_THAT(made.reading.sensors, ElementsAre(name));
  }
}

// Whole seconds with nights between them are a clock; numbers of rows have no
// pauses.
TEST(Clock, HasPausesWhateverItIsCalled) {
  for (const char* name : {"X_Value", "Heure", "TS"}) {
    const Reading reading = MadeOf(Days(name, [](int i, double /*warm*/) {
                              return std::to_string(30 * i + 54000 * (i / 40));
                            })).reading;
    EXPECT_EQ(reading.time.column, name);
    EXPECT_EQ(reading.time.step_s, 30.0) << name;
    EXPECT_EQ(reading.sessions.count, 3) << name;
  }
}

// Between cycles there are short pauses, between days nights.
TEST(Clock, MayPauseBetweenCyclesToo) {
  const Reading reading =
      MadeOf(Days("tick", [](int i, double /*warm*/) {
        return std::to_string(1200 * i + 3600 * (i / 5) + 9000000 * (i / 40));
      })).reading;
  EXPECT_EQ(reading.time.column, "tick");
  EXPECT_EQ(reading.sessions.count, 3);
}

TEST(Clock, OfDigitsShowsHoursMinutesAndSeconds) {
  const Reading reading =
      MadeOf(Days("time", [](int i, double /*warm*/) {
        const int minutes = 41 + i % 40 / 2;
        return std::to_string(70000 + minutes / 60 * 10000 +
                              minutes % 60 * 100 + i % 2 * 30);
      })).reading;
  EXPECT_EQ(reading.time.step_s, 30.0);
  EXPECT_EQ(reading.sessions.count, 3);
}

TEST(Clock, IsTheTimeSinceADateThatStands) {
  const Reading reading =
      MadeOf(Days("start,elapsed_min", [](int i, double /*warm*/) {
        return "2024-09-0" + std::to_string(7 + i / 40) + " 07:22," +
               CsvNumber(0.5 * (i % 40));
      })).reading;
  EXPECT_EQ(reading.time.column, "elapsed_min");
  EXPECT_EQ(reading.time.step_s, 30.0);
  EXPECT_EQ(reading.sessions.count, 3);
}

// A sheet's date is one at midnight.
TEST(Clock, OfADayCountsWithADateAtMidnight) {
  const Reading reading =
      MadeOf(Days("Date,Time", [](int i, double /*warm*/) {
        return "2024-09-0" + std::to_string(4 + i / 40) + " 00:00:00," +
               CsvNumber(std::round(1e9 * (0.3 + i % 40 / 2880.0)) / 1e9);
      })).reading;
  EXPECT_EQ(reading.time.column, "Date + Time");
  EXPECT_NEAR(reading.time.step_s.value_or(0.0), 30.0, 1e-3);
  EXPECT_EQ(reading.sessions.count, 3);
}

// As scopes write it, before each channel.
TEST(Clock, MayStandSeveralTimes) {
  const Reading reading =
      MadeOf(Days("Time [ms],T1,Time [ms],T2,Time [ms]",
                  [](int i, double warm) {
                    const std::string time =
                        std::to_string(8000 * i + 54000000 * (i / 40));
                    return time + "," + CsvNumber(warm) + "," + time + "," +
                           CsvNumber(40.0 - warm + i % 3) + "," + time;
                  }))
          .reading;
  EXPECT_EQ(reading.time.column, "Time [ms]");
  EXPECT_EQ(reading.time.step_s, 8.0);
  EXPECT_EQ(reading.sessions.count, 3);
}

// Of a day, as spreadsheets write it; hours would be possible, too.
TEST(Clock, IsAPartOfTheDayBelowOne) {
  const Reading reading =
      MadeOf(Days("Uhrzeit", [](int i, double /*warm*/) {
        return CsvNumber(std::round(1e7 * (8.0 / 24.0 + i % 40 / 2880.0)) /
                         1e7);
      })).reading;
  EXPECT_EQ(reading.time.unit, "days");
  EXPECT_FALSE(reading.time.sure);
  EXPECT_EQ(reading.sessions.count, 3);
}

TEST(Clock, OfTwoFieldsIsInMinutesWhereHoursGoOverTheDay) {
  const auto shown = [](int i, double /*warm*/) {
    return TwoDigits(i / 2) + ":" + (i % 2 == 0 ? "00" : "30");
  };
  for (const char* name : {"Time", "t mm:ss"}) {
    const Reading reading = MadeOf(Days(name, shown)).reading;
    EXPECT_EQ(reading.time.column, name);
    EXPECT_EQ(reading.time.step_s, 30.0);
  }
}

TEST(Clock, OfHoursCountsWithTheDateBesideIt) {
  const Reading reading = MadeOf(Days("Date,hour", [](int i, double /*warm*/) {
                            return "2024-03-0" + std::to_string(4 + i / 40) +
                                   "," + CsvNumber(8.0 + i % 40 / 120.0);
                          })).reading;
  EXPECT_EQ(reading.time.column, "Date + hour");
  EXPECT_EQ(reading.sessions.count, 3);
}

// 8.59 is a minute before 9.00; of parts of an hour some are above .59.
TEST(Clock, HasAPointBetweenHoursAndMinutesBesideADate) {
  const auto made = [](bool is_clock) {
    return MadeOf(Days("Date,Time",
                       [&](int i, double /*warm*/) {
                         const int minutes = 480 + 2 * (i % 40);
                         return "2024-03-0" + std::to_string(4 + i / 40) + "," +
                                CsvNumber(
                                    is_clock
                                        ? minutes / 60 + minutes % 60 / 100.0
                                        : std::round(minutes / 0.6) / 100.0);
                       }))
        .reading;
  };
  EXPECT_EQ(made(true).time.column, "Date + Time");
  EXPECT_EQ(made(true).time.unit, "date");
  EXPECT_NEAR(*made(true).time.step_s, 120.0, 1e-6);
  EXPECT_NE(made(false).time.step_s, made(true).time.step_s);
}

// A month in ms has as many figures as the seconds from 1970.
TEST(Clock, MayCountMonthsInTheUnitThatItsNameStates) {
  const Reading reading = CountedIn("time_ms", 1e-3, 2.6e9).reading;
  EXPECT_EQ(reading.time.unit, "ms");
  EXPECT_TRUE(reading.time.sure);
  EXPECT_NEAR(*reading.time.step_s, 30.0, 1e-6);
}

TEST(Clock, MayCountTheTicksOfAController) {
  const Reading reading = CountedIn("tick_10ms", 0.01, 0.0).reading;
  EXPECT_EQ(reading.time.unit, "10ms");
  EXPECT_NEAR(*reading.time.step_s, 30.0, 1e-9);
  EXPECT_EQ(reading.sessions.count, 3);
}

// Windows counts 100 ns from 1601: 2024-03-04 08:00.
TEST(Clock, KnowsTheTicksOfWindows) {
  const Reading reading = CountedIn("FileTime", 1e-7, 1.3354012e17).reading;
  EXPECT_EQ(reading.time.unit, "100ns");
  EXPECT_NEAR(*reading.time.step_s, 30.0, 1e-3);
  EXPECT_EQ(reading.sessions.count, 3);
}

// Each cycle its own clock: what was between them, nobody can tell.
TEST(Clock, ThatBeginsAnewInEachPassIsPassedOver) {
  const Reading reading = MadeOf(Days("t_s", [](int i, double /*warm*/) {
                            return std::to_string(5 * (i % 10));
                          })).reading;
  EXPECT_EQ(reading.sessions.count, 1);
  EXPECT_EQ(reading.time.column, std::nullopt);
  EXPECT_THAT(reading.remarks,
              Contains(HasSubstr("'t_s' restarts with each pass")));
}

TEST(Clock, IsNoThermometer) {
  for (const char* name : {"temp data", "tempo", "heating time temp", "cas"}) {
    const PreparedDataset prepared =
        MadeOf(Days(name, [](int, double warm) { return CsvNumber(warm); }),
               {.session = "none"});  // else by temperatures, of some
    EXPECT_EQ(prepared.reading.time.column, std::nullopt) << name;
    EXPECT_THAT(prepared.reading.sensors, ElementsAre(name));
    EXPECT_EQ(prepared.reading.sessions.count, 1);
  }
  const PreparedDataset drifting =
      MadeOf(Days("temp data", [](int i, double warm) {
        return CsvNumber(warm + 0.01 * i);
      }));
  EXPECT_EQ(drifting.reading.time.column, std::nullopt);
}

TEST(Clock, IsWhatGoesOnByTheNameOfATime) {
  for (const char* name : {"tempo", "czas", "hora inicio"}) {
    const Reading reading = MadeOf(Days(name, [](int i, double) {
                              return std::to_string(30 * i);
                            })).reading;
    EXPECT_EQ(reading.time.column, name);
  }
  // In another order, too.
  const Reading shuffled = MadeOf(Days("tempo", [](int i, double) {
                             return std::to_string(30 * (i * 7 % 120));
                           })).reading;
  EXPECT_EQ(shuffled.time.column, "tempo");
}

TEST(Clock, TakesNumbersFrom1970ForWhatTheyAre) {
  struct Case {
    const char* name;
    double scale;
    const char* unit;
    const char* other;
  };
  for (const Case& epoch : {Case{"time [min]", 1.0, "s", "min"},
                            Case{"timestamp_ms", 1.0, "s", "ms"},
                            Case{"time [s]", 1000.0, "ms", "s"}}) {
    const Reading reading =
        MadeOf(Days(epoch.name, [&](int i, double) {
          return CsvNumber(epoch.scale * (1772438400.0 + 60.0 * i));
        })).reading;
    EXPECT_EQ(reading.time.unit, epoch.unit) << epoch.name;
    EXPECT_EQ(reading.time.origin, "1970");
    EXPECT_EQ(reading.time.step_s, 60.0);
    EXPECT_FALSE(reading.time.sure);
    EXPECT_EQ(reading.time.alternative, epoch.other);
  }
  EXPECT_TRUE(MadeOf(Days("time [s]", [](int i, double) {
                return CsvNumber(1772438400.0 + 60.0 * i);
              })).reading.time.sure);
}

TEST(Clock, GoesOnWhereSummerTimeEndsAndSaysSo) {
  // A row each minute; from row 60 on the clock is back by `minutes`.
  const auto read = [](int minutes) {
    return MadeOf(Days("time", [=](int i, double) {
      return "2026-10-25 " + HourOf(i - (i >= 60 ? minutes : 0));
    }));
  };
  const PreparedDataset summer = read(60);
  EXPECT_EQ(summer.reading.sessions.count, 1);
  EXPECT_THAT(summer.remarks,
              Contains(HasSubstr("line 62 (data row 60), column 'time': the "
                                 "clock is set back by an hour")));
  for (const int minutes : {4, 20, 45}) {
    const PreparedDataset set = read(minutes);
    EXPECT_EQ(set.reading.sessions.count, 1) << minutes;
    EXPECT_THAT(set.remarks,
                Contains(HasSubstr(
                    "set back by " + std::to_string(minutes - 1) + " min; " +
                    std::to_string(minutes) + " min are added")));
    EXPECT_THAT(set.remarks, Not(Contains(HasSubstr("summer time"))));
  }
}

TEST(Clock, KnowsTicksFromTheYearOneHoursInCompoundsAndPackedHours) {
  const Reading ticks = MadeOf(Days("Ticks", [](int i, double) {
                          return CsvNumber(6.384e17 + 6e8 * i);
                        })).reading;
  EXPECT_EQ(ticks.time.unit, "100ns");
  EXPECT_EQ(ticks.time.step_s, 60.0);
  const Reading hours = MadeOf(Days("Betriebsstunden", [](int i, double) {
                          return CsvNumber(12000.0 + i / 60.0);
                        })).reading;
  EXPECT_EQ(hours.time.unit, "h");
  const Reading packed =
      MadeOf(Days("hhmmss", [](int i, double) {
        return TwoDigits(8 + i / 60) + TwoDigits(i % 60) + "07";
      })).reading;
  EXPECT_EQ(packed.time.column, "hhmmss");
  EXPECT_EQ(packed.time.step_s, 60.0);
}

TEST(Clock, TakesTheSecondColumnCalledMmForMinutes) {
  const PreparedDataset prepared =
      MadeOf(Days("YYYY,MM,DD,hh,mm,ss", [](int i, double) {
        return "2026,3,2," + std::to_string(8 + i / 60) + "," +
               std::to_string(i % 60) + ",7";
      }));
  EXPECT_EQ(prepared.reading.time.column, "YYYY + MM + DD + hh + mm + ss");
  EXPECT_EQ(prepared.reading.time.step_s, 60.0);
  EXPECT_THAT(prepared.reading.sensors, Not(Contains("mm")));
}

TEST(Clock, KnowsHoursAndMinutesWithoutAMarkBetween) {
  // 803, 804, ... 859, 900
  for (const std::string name : {"hhmm", "time", "Uhrzeit"}) {
    const Reading reading = MadeOf(Days(name, [](int i, double) {
                              return CsvNumber(803 + i + 40 * ((i + 3) / 60));
                            })).reading;
    EXPECT_EQ(reading.time.unit, "date") << name;
    EXPECT_EQ(reading.time.step_s, 60.0) << name;
    EXPECT_TRUE(reading.time.sure) << name;
  }
  // 0 to 39 in turn are not hours of a clock, and what has a unit counts.
  for (const std::string name : {"time", "time_min"}) {
    const Reading reading = MadeOf(Days(name, [](int i, double) {
                              return CsvNumber(i % 40);
                            })).reading;
    EXPECT_NE(reading.time.unit, "date") << name;
  }
  const Reading counts = MadeOf(Days("time_min", [](int i, double) {
                           return CsvNumber(803 + i + 40 * ((i + 3) / 60));
                         })).reading;
  EXPECT_EQ(counts.time.unit, "min");
  // Seconds have what no clock shows, or too few of its minutes.
  for (const int step : {1, 5, 50}) {
    const Reading reading = MadeOf(Days("time", [=](int i, double) {
                              return CsvNumber(800 + step * i);
                            })).reading;
    EXPECT_EQ(reading.time.unit, "s") << step;
  }
}

TEST(Clock, AddsTwelveHoursBehindNoonWhereTheHoursHaveHalves) {
  const PreparedDataset prepared = MadeOf(Days("time", [](int i, double) {
    const int minutes = 10 * 60 + 30 + 2 * i;
    const int hour = (minutes / 60 - 1) % 12 + 1;
    return "2026-10-25 " + TwoDigits(hour) + ":" + TwoDigits(minutes % 60);
  }));
  EXPECT_EQ(prepared.reading.sessions.count, 1);
  EXPECT_EQ(prepared.reading.time.step_s, 120.0);
  EXPECT_THAT(prepared.remarks, Contains(HasSubstr("hours from 1 to 12")));
}

TEST(Clock, TakesMidnightAt24ForTheEndOfADay) {
  const auto read = [](bool at_24) {
    return MadeOf(Days("time",
                       [=](int i, double) {
                         const int minutes = (20 * 60 + 3 * i) % (24 * 60);
                         if (minutes == 0 && at_24) return std::string("24:00");
                         return TwoDigits(minutes / 60) + ":" +
                                TwoDigits(minutes % 60);
                       }))
        .reading;
  };
  EXPECT_EQ(read(true).sessions.count, read(false).sessions.count);
  EXPECT_EQ(read(true).time.origin, "midnight");
}

TEST(Clock, KeepsTheDaysWhereACellLacks) {
  // By Excel's numbers, and by words.
  const auto of_excel = [](bool whole) {
    return Days("Date,Time", [=](int i, double) {
      return std::to_string(46000 + i / 40) + "," +
             (i == 7 && !whole ? "" : CsvNumber(0.33 + 0.002 * (i % 40)));
    });
  };
  const PreparedDataset excel =
      MadeOf(of_excel(false), {.missing = MissingPolicy::kDropRows});
  EXPECT_EQ(excel.reading.time.column, "Date + Time");
  EXPECT_EQ(excel.reading.sessions.count, 3);
  EXPECT_EQ(MadeOf(of_excel(true)).reading.sessions.count, 3);
  // Without leave to drop rows there is no time, but no days as seconds either.
  EXPECT_EQ(MadeOf(of_excel(false)).reading.time.column, std::nullopt);
  const PreparedDataset words = MadeOf(Days("Datum,Uhrzeit", [](int i, double) {
    return (i == 7 ? "" : TwoDigits(2 + i / 40) + ".03.2026") + "," +
           HourOf(2 * (i % 40));
  }));
  EXPECT_EQ(words.reading.time.column, "Datum + Uhrzeit");
  EXPECT_EQ(words.reading.sessions.count, 3);
}

TEST(Clock, ReadsNoDaysAsSeconds) {
  const Reading reading =
      MadeOf(Days("Date",
                  [](int i, double) { return std::to_string(46000 + i / 40); }),
             {.time = "Date"})
          .reading;
  EXPECT_EQ(reading.time.unit, "date");
  EXPECT_EQ(reading.time.step_s, 86400.0);
}

// How long a cycle takes is not a time of day, and a meter none at all.
TEST(Clock, IsNoDurationAndNoMeterBesideADate) {
  const auto date = [](int i) {
    return "2024-03-0" + std::to_string(4 + i / 40) + ",";
  };
  const std::string durations[] = {"88", "92", "96", "90", "94"};
  const BeginOfRow duration = [&](int i, double /*warm*/) {
    return date(i) + durations[i / 10 % 5];
  };
  const BeginOfRow meter = [&](int i, double /*warm*/) {
    return date(i) + std::to_string(5123.0 + 0.11 * i + 0.03 * (i % 3));
  };
  for (const auto& [name, cells] :
       {std::pair("Cycle time [s]", duration), {"Energy (kWh)", meter}}) {
    const Reading reading =
        MadeOf(Days("Date," + std::string(name), cells)).reading;
    EXPECT_EQ(reading.time.column, std::nullopt) << name;
    EXPECT_EQ(reading.sessions.by, "dates") << name;
    EXPECT_EQ(reading.sessions.count, 3) << name;
  }
  // A remark in brackets is not a unit.
  EXPECT_NEAR(
      *CountedIn("t (MATLAB)", 86400.0, 739315.5).reading.time.step_s, 30, 0.2);
}

}  // namespace
}  // namespace errmap::data
