#include "data/measurements/axis/counting.h"

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"

namespace errmap::data {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// Where a row stands: three days of four cycles to and fro over five positions.
struct Place {
  int row;
  int day;    // 0 to 2
  int cycle;  // 0 to 3 in each day
  int way;    // 0 to 1 in each cycle
};

constexpr int kDays = 3;
constexpr int kCycles = 4;
constexpr int kPositions = 5;

using Cell = std::function<std::string(const Place&)>;

PreparedDataset MadeWith(const std::string& header,
                         const Cell& cell,
                         const DatasetSelection& selection = {}) {
  std::string text = header + ",x [mm],t1_degC,error_um\n";
  for (int row = 0; row < kDays * kCycles * 2 * kPositions; ++row) {
    const int way = row / kPositions % 2;
    const Place place{.row = row,
                      .day = row / (2 * kPositions * kCycles),
                      .cycle = row / (2 * kPositions) % kCycles,
                      .way = way};
    const int at =
        way == 0 ? row % kPositions : kPositions - 1 - row % kPositions;
    const double warm = 20.0 + 2.0 * place.cycle + 0.3 * place.day + 0.01 * row;
    const double noise = std::sin(12.9898 * (row + 1)) * 1e4;
    const double error = 0.1 * at * (warm - 20.0) + 2.0 * way +
                         0.1 * (noise - std::floor(noise));
    text += cell(place) + "," + std::to_string(100 * at) + "," +
            CsvNumber(warm) + "," + CsvNumber(error) + "\n";
  }
  return MakeDataset(ParseCsv(text, "f.csv"), selection);
}

std::string Number(int number) { return std::to_string(number); }

int CycleInAll(const Place& at) { return kCycles * at.day + at.cycle; }

// What a column of numbers or words means is told by where it changes.
TEST(Counting, TellsSessionsWhateverItsColumnIsCalled) {
  const Cell day = [](const Place& at) { return Number(at.day + 1); };
  const Cell later_day = [](const Place& at) { return Number(at.day + 7); };
  const Cell cycle = [](const Place& at) { return Number(at.cycle + 1); };
  const Cell later_cycle = [](const Place& at) {
    return Number(at.cycle + at.day % 2 + 1);
  };
  const Cell in_all = [](const Place& at) { return Number(CycleInAll(at)); };
  const Cell way = [](const Place& at) {
    return Number(2 * CycleInAll(at) + at.way + 1);
  };
  const Cell way_anew = [](const Place& at) {
    return Number(2 * at.cycle + at.way + 1);
  };
  const Cell tens = [](const Place& at) {
    return Number(10 * CycleInAll(at) + 10);
  };
  const Cell down = [](const Place& at) { return Number(kCycles - at.cycle); };
  const Cell turns = [](const Place& at) {
    return std::string(at.day % 2 == 0 ? "A" : "B");
  };
  const Cell turns_in_numbers = [](const Place& at) {
    return Number(at.day % 2 + 1);
  };
  const Cell date_of_digits = [](const Place& at) {
    return Number(20240304 + at.day);
  };
  const Cell date_of_excel = [](const Place& at) {
    return Number(45355 + at.day);
  };
  struct Case {
    const char* header;
    Cell cell;
    int sessions;
    const char* by;
  };
  const std::vector<Case> cases = {
      {"night", later_day, 3, "column"},
      {"Versuchstag", day, 3, "column"},
      {"lot", day, 3, "column"},
      {"lot", later_day, 3, "rest"},  // nothing says that it counts
      {"campaign", later_day, 3, "column"},
      {"group", later_day, 3, "column"},
      {"Messreihe", in_all, 3, "rest"},
      {"Serie", cycle, 3, "counter"},
      {"Lauf", cycle, 3, "counter"},
      {"block", later_cycle, 3, "counter"},
      {"warmup_cycle", cycle, 3, "counter"},
      {"N. ciclo", tens, 3, "rest"},
      {"Countdown", down, 3, "counter"},
      {"sweep", way, 3, "rest"},
      {"pass", way_anew, 3, "counter"},
      {"Shift", turns, 3, "column"},
      {"run", turns_in_numbers, 2, "column"},
      {"date", date_of_digits, 3, "dates"},
      {"Datum", date_of_excel, 3, "dates"},
  };
  for (const Case& test : cases) {
    SCOPED_TRACE(test.header);
    const Reading reading = MadeWith(test.header, test.cell).reading;
    EXPECT_EQ(reading.sessions.count, test.sessions);
    EXPECT_EQ(reading.sessions.by, test.by);
    EXPECT_EQ(reading.cycles.count, kDays * kCycles);
    if (test.sessions > 1 || reading.cycles.column == test.header) {
      EXPECT_THAT(reading.sensors, Not(Contains(test.header)));
    }
  }
}

// Blocks by turns within a day, beside the number of each row.
TEST(Counting, LeavesTheDaysToTheirColumn) {
  const Reading reading = MadeWith("day,row,block", [](const Place& at) {
                            return Number(at.day + 1) + "," +
                                   Number(at.row % kPositions) + "," +
                                   Number(at.cycle % 2);
                          }).reading;
  EXPECT_EQ(reading.sessions.count, kDays);
  EXPECT_EQ(reading.sessions.column, "day");
}

TEST(Counting, IsNoInput) {
  const Reading ways = MadeWith("scan", [](const Place& at) {
                         return Number(2 * CycleInAll(at) + at.way);
                       }).reading;
  ASSERT_EQ(ways.left_out.size(), 1U);
  EXPECT_EQ(ways.left_out[0].column, "scan");
  EXPECT_EQ(ways.left_out[0].why, "counts the ways along the axis");
  const Reading parts = MadeWith("part_no", [](const Place& at) {
                          return Number(101 + 3 * CycleInAll(at));
                        }).reading;
  EXPECT_THAT(parts.sensors, ElementsAre("t1_degC"));
  // Whole degrees change within a pass, too.
  const Reading degrees = MadeWith("T2", [](const Place& at) {
                            return Number(1 + at.cycle + at.row / 7);
                          }).reading;
  EXPECT_THAT(degrees.sensors, Contains("T2"));
}

// "Position [um]" of a column "Position" is the error, and no axis as well.
TEST(Counting, TakesATargetForNothingElse) {
  const PreparedDataset made =
      MadeWith("Position",
               [](const Place& at) { return CsvNumber(0.1 * at.row * at.row); },
               {.target = "Position [um]", .exclude = {"error_um"}});
  EXPECT_EQ(made.dataset.target().name, "Position [um]");
  EXPECT_EQ(made.reading.position.column, "x [mm]");
  EXPECT_EQ(made.dataset.num_inputs(), 2);
}

// A map names the column of its sessions, and finds them as it was fitted.
TEST(Counting, PartsWhatComesAgainInANamedColumn) {
  const Cell shift = [](const Place& at) {
    return std::string(at.day % 2 == 0 ? "day" : "night");
  };
  const Reading reading =
      MadeWith("Shift", shift, {.session = "Shift"}).reading;
  EXPECT_EQ(reading.sessions.count, kDays);
}

// A thermometer that failed on the first day has no merged cells.
TEST(Counting, FillsNoThermometerThatFailed) {
  const Cell failed = [](const Place& at) {
    return at.day == 0 ? Number(20 + at.row % 3) : "";
  };
  const PreparedDataset made =
      MadeWith("t2_degC", failed, {.missing = MissingPolicy::kDropRows});
  EXPECT_EQ(made.dataset.num_rows(), kCycles * 2 * kPositions);
}

// What a spreadsheet shows once for merged cells holds for all of them.
TEST(Counting, FillsMergedCellsFromAbove) {
  const auto first_of = [](int rows, int row, int number) {
    return row % rows == 0 ? Number(number) : std::string();
  };
  const PreparedDataset made = MadeWith("Day,Cycle", [&](const Place& at) {
    return first_of(2 * kPositions * kCycles, at.row, at.day + 1) + "," +
           first_of(2 * kPositions, at.row, at.cycle + 1);
  });
  EXPECT_EQ(made.reading.sessions.count, kDays);
  EXPECT_EQ(made.reading.cycles.count, kDays * kCycles);
  EXPECT_EQ(made.dataset.num_rows(), kDays * kCycles * 2 * kPositions);
  EXPECT_THAT(made.remarks, Contains(HasSubstr("'Day', 'Cycle' are filled")));
}

TEST(Counting, HoldsTheReadingOfAThermometerThatIsReadOnceACycle) {
  constexpr int kRows = 2 * kPositions;
  const auto made = [&](int every) {
    return MadeWith("day,T_bed [degC]", [&](const Place& at) {
      return Number(at.day + 1) + "," +
             (at.row % every == 0 ? Number(20 + at.row / every % 7)
                                  : std::string());
    });
  };
  EXPECT_EQ(made(kRows).dataset.num_rows(), kDays * kCycles * kRows);
  EXPECT_THAT(made(kRows).remarks,
              Contains(HasSubstr("'T_bed [degC]' are filled")));
}

// As numbers "1.10" is "1.1".
TEST(Counting, TellsCyclesOfTwoPartsByThePositions) {
  const Reading reading = MadeWith("day,cycle", [](const Place& at) {
                            return Number(at.day + 1) + "," +
                                   Number(at.day + 1) + "." +
                                   Number(at.cycle == 3 ? 10 : at.cycle + 1);
                          }).reading;
  EXPECT_EQ(reading.cycles.count, kDays * kCycles);
  EXPECT_THAT(reading.sensors, ElementsAre("t1_degC"));
}

// A tool may change with each cycle, and a program line with each row.
TEST(Counting, KnowsWhatATableOfAControlHas) {
  const Reading reading =
      MadeWith("Tool,Line,seq", [](const Place& at) {
        return Number(1 + CycleInAll(at) % 4) + "," +
               Number(10 * (at.row % (2 * kPositions) + 1)) + "," +
               Number(at.row % 50);
      }).reading;
  EXPECT_EQ(reading.cycles.column, "cycle");
  EXPECT_EQ(reading.cycles.count, kDays * kCycles);
  EXPECT_THAT(reading.sensors, ElementsAre("t1_degC"));
}

// A date of the shift's beginning, and its clock over midnight.
TEST(Counting, GoesOnOverMidnightBesideTheDateOfTheBeginning) {
  const PreparedDataset made = MadeWith("Date,Time", [](const Place& at) {
    const int minutes = 23 * 60 + at.row % 40 * 3;  // to 00:57
    const int hour = minutes / 60 % 24;
    return "2024-03-0" + Number(4 + at.day) + "," + (hour < 10 ? "0" : "") +
           Number(hour) + (minutes % 60 < 10 ? ":0" : ":") +
           Number(minutes % 60);
  });
  EXPECT_EQ(made.reading.sessions.count, kDays);
  EXPECT_EQ(made.reading.time.step_s, 180.0);
}

TEST(Counting, TakesAnotherClockForNoSensor) {
  const Reading reading =
      MadeWith("time_s,Uptime [h]", [](const Place& at) {
        const int seconds = 5 * at.row + 50000 * at.day;
        return Number(seconds) + "," + CsvNumber(300.0 + seconds / 3600.0);
      }).reading;
  EXPECT_EQ(reading.time.column, "time_s");
  EXPECT_THAT(reading.sensors, ElementsAre("t1_degC"));
}

// A name that comes again beside a date: the date tells.
TEST(Counting, LeavesWhatComesAgainToTheDate) {
  const Reading reading = MadeWith("Date,Shift", [](const Place& at) {
                            return "2024-03-0" + Number(4 + at.day) + "," +
                                   (at.day % 2 == 0 ? "day" : "night");
                          }).reading;
  EXPECT_EQ(reading.sessions.column, "Date");
  EXPECT_EQ(reading.sessions.count, 3);
}

TEST(Counting, JoinsYearMonthAndDay) {
  const Cell parts = [](const Place& at) {
    const int seconds = 5 * (at.row % 40);
    return "2024,3," + Number(4 + at.day) + ",8," + Number(seconds / 60) + "," +
           Number(seconds % 60);
  };
  for (const auto& [names, joined] :
       {std::pair("Year,Month,Day,Hour,Minute,Second",
                  "Year + Month + Day + Hour + Minute + Second"),
        {"Jahr,Monat,Tag,Std,Min,Sek",
         "Jahr + Monat + Tag + Std + Min + Sek"}}) {
    const Reading reading = MadeWith(names, parts).reading;
    EXPECT_EQ(reading.time.column, joined);
    EXPECT_EQ(reading.sessions.count, 3);
    EXPECT_THAT(reading.sensors, ElementsAre("t1_degC"));
  }
}

// Labels of cycles name their day beside a number that begins anew.
TEST(Counting, FindsSessionsInTheLabelsOfCycles) {
  struct Form {
    const char* name;
    Cell cell;
  };
  const auto day = [](const Place& place) { return Number(place.day + 1); };
  const auto cycle = [](const Place& place) { return Number(place.cycle + 1); };
  for (const Form& form : std::vector<Form>{
           {"Cycle",
            [&](const Place& p) { return "D" + day(p) + "C" + cycle(p); }},
           {"Run", [&](const Place& p) { return day(p) + "/" + cycle(p); }},
           {"Run", [&](const Place& p) { return day(p) + "0" + cycle(p); }},
           {"File",
            [&](const Place& p) {
              return "X_2024030" + day(p) + "_0" + cycle(p) + ".rtl";
            }},
           {"Lauf", [&](const Place& p) {
              return cycle(p) + ". Lauf / Tag " + day(p);
            }}}) {
    const Reading reading = MadeWith(form.name, form.cell).reading;
    EXPECT_EQ(reading.sessions.count, kDays) << form.cell(Place{});
    EXPECT_EQ(reading.sessions.column, "session of " + std::string(form.name));
    EXPECT_FALSE(reading.sessions.sure);
    EXPECT_EQ(reading.cycles.count, kDays * kCycles);
  }
}

TEST(Counting, TakesReadingsAtEachPlaceForNoSensor) {
  const Reading reading = MadeWith("Reading", [](const Place& place) {
                            return Number(place.row % 3 + 1);
                          }).reading;
  EXPECT_THAT(reading.sensors, Not(Contains("Reading")));
}

TEST(Counting, OutranksADateThatChangesAtMidnight) {
  const PreparedDataset prepared =
      MadeWith("Date,Zyklus", [](const Place& place) {
        return "2024-03-0" + Number(place.day + (place.cycle > 1 ? 5 : 4)) +
               "," + Number(place.cycle + 1);
      });
  EXPECT_EQ(prepared.reading.sessions.by, "counter");
  EXPECT_EQ(prepared.reading.sessions.count, kDays);
}

// Programs and fixtures take turns; the axis shows the cycles.
TEST(Counting, TakesWhatComesAgainForNoCycles) {
  const auto cycles_with = [](const std::string& name, const Cell& cell) {
    return MadeWith("time_s," + name, [&](const Place& at) {
      return Number(5 * at.row + 50000 * at.day) + "," + cell(at);
    });
  };
  const char* const modes[] = {"AUTO", "JOG", "MDI", "AUTO"};
  for (const auto& [name, cell] : std::vector<std::pair<const char*, Cell>>{
           {"Prog",
            [](const Place& at) {
              return std::string(at.cycle % 2 == 0 ? "O1234" : "O1240");
            }},
           {"Mode", [&](const Place& at) { return modes[at.cycle]; }},
           {"Spannung",
            [](const Place& at) { return Number(at.cycle % 2 + 1); }}}) {
    const Reading reading = cycles_with(name, cell).reading;
    EXPECT_EQ(reading.cycles.column, "cycle") << name;
    EXPECT_EQ(reading.cycles.count, kDays * kCycles) << name;
    EXPECT_THAT(reading.sensors, ElementsAre("t1_degC"));
    EXPECT_THAT(reading.switches, ElementsAre());
  }
  const char* const diagonals[] = {"PPP", "NPP", "PNP", "PPN"};
  EXPECT_THAT(
      cycles_with("Diagonal",
                  [&](const Place& at) { return diagonals[at.cycle]; })
          .remarks,
      Contains(HasSubstr("rows that differ in 'Diagonal' may need a map")));
}

// Positions in no order show no passes.
TEST(Counting, FindsCyclesWithinSessionsWhereTheAxisShowsNone) {
  for (const char* names : {"Session,Run", "Session,Series", "Block,Series"}) {
    std::string text = std::string(names) + ",x [mm],t1_degC,error_um\n";
    const bool anew = std::string(names).ends_with("Run");
    for (int row = 0; row < 120; ++row) {
      const int at = (7 * row + row * row * row / 11) % 10;
      const double warm = 20.0 + row % 40 / 10;
      text += Number(row / 40 + 1) + "," +
              Number((anew ? row % 40 : row) / 10 + 1) + "," + Number(40 * at) +
              "," + CsvNumber(warm + 0.01 * (row % 7)) + "," +
              CsvNumber(0.1 * at + 2.0 * warm + 0.01 * (row % 3)) + "\n";
    }
    const Reading reading = MakeDataset(ParseCsv(text, "f.csv"), {}).reading;
    EXPECT_EQ(reading.sessions.count, 3) << names;
    EXPECT_EQ(reading.cycles.count, 12) << names;
  }
}

// Home is measured again before each point.
TEST(Counting, FindsCyclesWithinSessionsWhereEachPointIsAWay) {
  std::string text = "Session,Run,x [mm],t1_degC,error_um\n";
  for (int row = 0; row < 108; ++row) {
    const int run = row / 12 % 3;
    const int at = row % 2 == 0 ? 0 : row % 12 / 2 + 1;
    text += Number(row / 36 + 1) + "," + Number(run + 1) + "," +
            Number(60 * at) + "," + CsvNumber(20.0 + run + 0.01 * row) + "," +
            CsvNumber(0.3 * at + 2.0 * run + 0.01 * (row % 5)) + "\n";
  }
  const Reading reading = MakeDataset(ParseCsv(text, "f.csv"), {}).reading;
  EXPECT_EQ(reading.sessions.column, "Session");
  EXPECT_EQ(reading.cycles.column, "Run");
  EXPECT_EQ(reading.cycles.count, 9);
}

// A logger's rows between the sweeps.
TEST(Counting, LeavesRowsWithoutAnErrorOutOfStepsAndCycles) {
  std::string text = "time_s,x [mm],t1_degC,error_um\n";
  int time = 0;
  for (int cycle = 0; cycle < 12; ++cycle) {
    for (int i = 0; i < 12; ++i) {
      const std::string warm = CsvNumber(20.0 + 0.1 * (cycle % 4) + 0.01 * i);
      text += Number(time) + "," + (i < 5 ? Number(50 * i) : "") + "," + warm +
              "," + (i < 5 ? CsvNumber(0.1 * (i * i % 4) + cycle % 4) : "") +
              "\n";
      time += i < 4 ? 10 : 60;
    }
    if (cycle % 4 == 3) time += 60000;
  }
  const Reading reading = MakeDataset(ParseCsv(text, "f.csv"),
                                      {.missing = MissingPolicy::kDropRows})
                              .reading;
  EXPECT_EQ(reading.sessions.count, 3);
  EXPECT_EQ(reading.cycles.count, 12);
  EXPECT_EQ(reading.time.step_s, 10.0);
}

}  // namespace
}  // namespace errmap::data
