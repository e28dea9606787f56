#include "data/measurements/reading/reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/directions.h"
#include "data/measurements/reading/motion.h"
#include "data/measurements/reading/read_table.h"

namespace errmap::data {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A machine that warms: days of cycles of positions, up or both ways.
struct Log {
  int days = 4;
  int cycles = 5;
  int positions = 6;
  double step = 10.0;      // s
  double pause = 300.0;    // s
  double night = 50000.0;  // s
  bool both_ways = false;

  struct Row {
    int day = 0;
    int cycle = 0;  // in all days
    double time = 0.0;
    double position = 0.0;
    double warm = 0.0;
    double error = 0.0;
  };

  std::vector<Row> Rows() const {
    std::vector<Row> rows;
    double time = 1000.0;
    for (int day = 0; day < days; ++day) {
      const double begin = time;
      for (int cycle = 0; cycle < cycles; ++cycle) {
        const int ways = both_ways ? 2 : 1;
        for (int i = 0; i < ways * positions; ++i) {
          const int at = i < positions ? i : ways * positions - 1 - i;
          const double warm =
              20.0 + 0.3 * day + 5.0 * (1.0 - std::exp((begin - time) / 2000));
          const double noise =
              std::sin(12.9898 * static_cast<double>(rows.size() + 1)) * 1e4;
          rows.push_back({.day = day,
                          .cycle = day * cycles + cycle,
                          .time = time,
                          .position = 50.0 * at,
                          .warm = warm,
                          .error = 2.0 * (warm - 20.0) + 0.5 * at +
                                   (i < positions ? 0.0 : 3.0) + 0.1 * noise -
                                   0.1 * std::floor(noise)});
          time += step;
        }
        time += pause;
      }
      time += night;
    }
    return rows;
  }
};

std::string Fixed(double value) {
  return CsvNumber(std::round(1e4 * value) / 1e4);
}

using CellsOfRow = std::function<std::vector<std::string>(const Log::Row&)>;

std::string Text(const std::string& header,
                 const std::vector<Log::Row>& rows,
                 const CellsOfRow& cells) {
  std::string text = header + "\n";
  for (const Log::Row& row : rows) {
    std::string line;
    for (const std::string& cell : cells(row)) {
      line += (line.empty() ? "" : ",") + cell;
    }
    text += line + "\n";
  }
  return text;
}

Reading Read(const std::string& text, const DatasetSelection& selection = {}) {
  return MakeDataset(ParseCsv(text, "log.csv"), selection).reading;
}

std::vector<std::string> TimePositionTempError(const Log::Row& row);

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

std::vector<std::string> TimePositionTempError(const Log::Row& row) {
  return {
      Fixed(row.time), Fixed(row.position), Fixed(row.warm), Fixed(row.error)};
}

// What reads a word back asks each number for its name.
TEST(Evidence, HasNoNameBeyondTheLast) {
  EXPECT_EQ(ToString(Evidence::kNameAndValues), "name+values");
  for (int i = 5; i < 256; ++i) {
    EXPECT_EQ(ToString(static_cast<Evidence>(i)), "");
  }
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

TEST(Reading, PutsShuffledRowsInTheOrderOfTheirClock) {
  const std::vector<Log::Row> rows = Log().Rows();
  std::vector<Log::Row> sorted = rows;
  std::ranges::stable_sort(sorted, {}, &Log::Row::position);
  const auto make = [](const std::vector<Log::Row>& of) {
    return MakeDataset(ParseCsv(Text("time_s,position_mm,t1_degC,error_um",
                                     of,
                                     TimePositionTempError),
                                "log.csv"),
                       {});
  };
  const PreparedDataset measured = make(rows);
  const PreparedDataset found = make(sorted);
  EXPECT_EQ(found.reading.order, "time");
  EXPECT_EQ(found.dataset.target_values(), measured.dataset.target_values());
  EXPECT_EQ(found.dataset.log()->sessions.codes,
            measured.dataset.log()->sessions.codes);
}

std::string DateText(double seconds) {
  const auto time = static_cast<std::time_t>(std::round(seconds));
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::array<char, 32> text{};
  return {text.data(),
          std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &parts)};
}

// A file's times as dates, with lines that are put in.
std::string WithDates(const std::vector<Log::Row>& rows,
                      const std::string& put_in = "") {
  std::string text =
      Text("time,position_mm,t1_degC,error_um", rows, [](const Log::Row& row) {
        std::vector<std::string> cells = TimePositionTempError(row);
        cells[0] = DateText(1772000000.0 + row.time);
        return cells;
      });
  return text.insert(text.find('\n', text.size() / 3) + 1, put_in);
}

// A pass has one time: dates come again in the rows of a pass, and nowhere
// else. Sorted by position they come again everywhere.
TEST(Reading, PutsPassesWithOneDateEachInOrder) {
  std::vector<Log::Row> rows = Log().Rows();
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].position > rows[i - 1].position)
      rows[i].time = rows[i - 1].time;
  }
  const auto make = [](const std::vector<Log::Row>& of) {
    return MakeDataset(ParseCsv(WithDates(of), "log.csv"), {});
  };
  const PreparedDataset measured = make(rows);
  std::vector<Log::Row> newest_first = rows;
  std::ranges::stable_sort(
      newest_first, std::ranges::greater(), &Log::Row::time);
  std::vector<Log::Row> by_position = rows;
  std::ranges::stable_sort(by_position, {}, &Log::Row::position);
  for (const auto& others : {newest_first, by_position}) {
    const PreparedDataset found = make(others);
    EXPECT_EQ(found.reading.order, "time");
    EXPECT_EQ(found.dataset.target_values(), measured.dataset.target_values());
    EXPECT_EQ(found.dataset.log()->time, measured.dataset.log()->time);
    EXPECT_EQ(found.reading.sessions.count, 4);
  }
}

TEST(Reading, LeavesOutTheRowOfWordsWhereverTimePutsTheOthers) {
  std::vector<Log::Row> rows = Log().Rows();
  std::ranges::stable_sort(rows, {}, &Log::Row::position);
  const auto make = [&](const std::string& put_in) {
    return MakeDataset(ParseCsv(WithDates(rows, put_in), "log.csv"),
                       {.missing = MissingPolicy::kDropRows});
  };
  const PreparedDataset found = make("Mean,100,22,9\n");
  EXPECT_EQ(found.reading.order, "time");
  EXPECT_EQ(found.reading.cycles.count, 20);
  EXPECT_EQ(found.dataset.target_values(), make("").dataset.target_values());
}

TEST(Reading, ReadsOnceWhatWasSavedTwiceWithItsDate) {
  const std::vector<Log::Row> rows = Log().Rows();
  std::vector<Log::Row> again = rows;
  again.insert(again.begin() + 40, rows.begin() + 25, rows.begin() + 40);
  const PreparedDataset once =
      MakeDataset(ParseCsv(WithDates(rows), "log.csv"), {});
  const PreparedDataset twice =
      MakeDataset(ParseCsv(WithDates(again), "log.csv"), {});
  EXPECT_EQ(twice.dataset.target_values(), once.dataset.target_values());
  EXPECT_EQ(twice.reading.sessions.count, 4);
  EXPECT_TRUE(twice.reading.sessions.sure);
  EXPECT_EQ(twice.reading.cycles.count, 20);
  EXPECT_EQ(twice.reading.rows_left_out.size(), 15U);
  EXPECT_THAT(twice.remarks,
              Contains(HasSubstr("15 rows stand twice, with their times")));
}

TEST(Reading, TakesNoHistoryFromRowsThatWereSortedWithoutAClock) {
  std::vector<Log::Row> rows = Log().Rows();
  std::ranges::stable_sort(rows, {}, &Log::Row::position);
  const PreparedDataset prepared = MakeDataset(
      ParseCsv(Text("day,cycle,position_mm,t1_degC,error_um",
                    rows,
                    [](const Log::Row& row) {
                      return std::vector<std::string>{std::to_string(row.day),
                                                      std::to_string(row.cycle),
                                                      Fixed(row.position),
                                                      Fixed(row.warm),
                                                      Fixed(row.error)};
                    }),
               "log.csv"),
      {});
  EXPECT_EQ(prepared.reading.order, "none");
  EXPECT_FALSE(prepared.dataset.log()->ordered);
  EXPECT_EQ(prepared.dataset.num_sessions(), 4);
  EXPECT_THAT(ReadingLines(prepared.reading).back(),
              HasSubstr("no map gets a memory"));
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

TEST(Reading, AsksForTheSignOfACorrection) {
  const std::string text = Text("time_s,position_mm,t1_degC,correction_um",
                                Log().Rows(),
                                TimePositionTempError);
  try {
    Read(text);
    FAIL() << "no question";
  } catch (const OpenQuestion& open) {
    EXPECT_EQ(open.question().topic, "target");
    EXPECT_EQ(open.question().answers.size(), 2U);
    EXPECT_THAT(open.what(),
                AllOf(HasSubstr("-correction_um"), HasSubstr("target")));
  }
  const CsvTable table = ParseCsv(text, "log.csv");
  const PreparedDataset error = MakeDataset(table, {.target = "correction_um"});
  const PreparedDataset against =
      MakeDataset(table, {.target = "-correction_um"});
  EXPECT_EQ(against.dataset.target_values(),
            Eigen::VectorXd(-error.dataset.target_values()));
  EXPECT_EQ(against.reading.target.sign, -1);
  EXPECT_EQ(against.dataset.target().unit.symbol, "um");
}

// Of notes above or below the table.
TEST(Reading, AsksForTheSignThatANoteTells) {
  const std::string rows = Text("time_s,position_mm,t1_degC,error_um",
                                Log().Rows(),
                                TimePositionTempError);
  for (const char* note : {"sign convention: nominal minus actual",
                           "error = target - reading",
                           "positive error: the axis stops short",
                           "Vorzeichen: Soll minus Ist"}) {
    EXPECT_THROW(Read("# " + std::string(note) + "\n" + rows), OpenQuestion)
        << note;
  }
  EXPECT_THROW(Read(rows + "\nNote: Deviation = nominal - actual\n"),
               OpenQuestion);
  EXPECT_NO_THROW(Read("# error = measured - target\n" + rows));
}

TEST(Reading, AsksForTheDifferenceOfWhatWasReadAndCommanded) {
  for (const std::string unit : {"", " [mm]"}) {
    const std::string text = Text("T1," + ("Target" + unit) + ",Actual" + unit,
                                  Log().Rows(),
                                  [](const Log::Row& row) {
                                    return std::vector<std::string>{
                                        Fixed(row.warm),
                                        Fixed(row.position),
                                        Fixed(row.position + row.error / 1e3)};
                                  });
    try {
      Read(text);
      FAIL() << "no question";
    } catch (const OpenQuestion& open) {
      const std::string option = open.question().answers.front().option;
      EXPECT_THAT(option, HasSubstr("Actual"));
      const std::string target =
          "Actual" + unit + "-Target" + (unit.empty() ? " [mm]" : unit);
      EXPECT_THAT(option, HasSubstr(target));
      EXPECT_EQ(Read(text, {.target = target}).target.unit, "mm");
    }
  }
}

TEST(Reading, OffersEachInstrumentThatReadWhatWasCommanded) {
  const std::string text = Text(
      "T1,cmd_mm,encoder_mm,laser_mm", Log().Rows(), [](const Log::Row& row) {
        return std::vector<std::string>{Fixed(row.warm),
                                        Fixed(row.position),
                                        Fixed(row.position + 1e-4 * row.warm),
                                        Fixed(row.position + row.error / 1e3)};
      });
  try {
    Read(text);
    FAIL() << "no question";
  } catch (const OpenQuestion& open) {
    std::vector<std::string> options;
    for (const auto& answer : open.question().answers) {
      options.push_back(answer.option);
    }
    EXPECT_THAT(options,
                ElementsAre(HasSubstr("encoder_mm-cmd_mm"),
                            HasSubstr("laser_mm-cmd_mm")));
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

}  // namespace
}  // namespace errmap::data
