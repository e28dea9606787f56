// The order of rows and which of them are read: row_order.h and base_rows.h, by
// MakeDataset.

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <functional>
#include <optional>
#include <string>
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
using warming_log::Fixed;
using warming_log::Log;
using warming_log::Text;
using warming_log::TimePositionTempError;

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
              Contains(HasSubstr("15 rows occur twice, with their times")));
}

TEST(Reading, ReadsOnceASingleRowWhoseTimeNoOtherHas) {
  const std::vector<Log::Row> rows = Log().Rows();
  std::vector<Log::Row> again = rows;
  again.insert(again.begin() + 70, rows[69]);
  again.insert(again.begin() + 26, rows[25]);
  const auto make = [](const std::vector<Log::Row>& of) {
    return MakeDataset(ParseCsv(WithDates(of), "log.csv"), {});
  };
  const PreparedDataset twice = make(again);
  EXPECT_EQ(twice.dataset.target_values(), make(rows).dataset.target_values());
  EXPECT_EQ(twice.reading.rows_left_out.size(), 2U);
  // A clock that shows several readings alike tells none from another.
  again[80].time = again[79].time;
  EXPECT_EQ(make(again).reading.rows_left_out.size(), 0U);
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

TEST(Reading, KeepsTheClockBesideAColumnThatCountsOn) {
  const PreparedDataset prepared = MakeDataset(
      ParseCsv(Text("time_s,group,t1_degC,error_um",
                    Log().Rows(),
                    [](const Log::Row& row) {
                      return std::vector<std::string>{Fixed(row.time),
                                                      std::to_string(row.cycle),
                                                      Fixed(row.warm),
                                                      Fixed(row.error)};
                    }),
               "log.csv"),
      {});
  EXPECT_NE(prepared.reading.order, "none");
  EXPECT_EQ(prepared.reading.time.column, "time_s");
  EXPECT_EQ(prepared.reading.position.column, std::nullopt);
  EXPECT_TRUE(prepared.dataset.log()->ordered);
}

TEST(Reading, TurnsDaysAndRowsThatCountDownUpsideDown) {
  std::vector<Log::Row> rows = Log().Rows();
  std::ranges::reverse(rows);
  for (const bool by_day : {true, false}) {
    int id = 700;
    const PreparedDataset made =
        MakeDataset(ParseCsv(Text(by_day ? "day,position_mm,t1_degC,error_um"
                                         : "id,position_mm,t1_degC,error_um",
                                  rows,
                                  [&](const Log::Row& row) {
                                    return std::vector<std::string>{
                                        std::to_string(by_day ? row.day : id--),
                                        Fixed(row.position),
                                        Fixed(row.warm),
                                        Fixed(row.error)};
                                  }),
                             "log.csv"),
                    {});
    EXPECT_EQ(made.reading.order, "time");
    EXPECT_THAT(made.reading.direction.values, ElementsAre("up"));
  }
}

TEST(Reading, TurnsCyclesThatCountDownUpsideDown) {
  std::vector<Log::Row> rows = Log().Rows();
  const auto make = [](const std::vector<Log::Row>& of) {
    return MakeDataset(ParseCsv(Text("cycle,position_mm,t1_degC,error_um",
                                     of,
                                     [](const Log::Row& row) {
                                       return std::vector<std::string>{
                                           std::to_string(row.cycle + 1),
                                           Fixed(row.position),
                                           Fixed(row.warm),
                                           Fixed(row.error)};
                                     }),
                                "log.csv"),
                       {});
  };
  const PreparedDataset measured = make(rows);
  std::ranges::reverse(rows);
  const PreparedDataset newest_first = make(rows);
  EXPECT_EQ(newest_first.dataset.target_values(),
            measured.dataset.target_values());
  EXPECT_EQ(newest_first.reading.sessions.count,
            measured.reading.sessions.count);
  EXPECT_THAT(ReadingLines(newest_first.reading),
              Contains(HasSubstr("They were turned upside down.")));
}

}  // namespace
}  // namespace errmap::data
