#include "data/measurements/sessions.h"

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data/measurements/reading/warming_log.h"

namespace errmap::data {
namespace {

using Eigen::Index;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;
using warming_log::Log;

FoundSessions Find(const std::string& text, DatasetSelection selection = {}) {
  const CsvTable table = ParseCsv(text, "log.csv");
  std::vector<Index> rows;
  for (std::size_t i = 0; i < table.num_rows; ++i) {
    rows.push_back(static_cast<Index>(i));
  }
  return FindSessions(table, selection, rows);
}

std::vector<double> Times(const FoundSessions& found) {
  return {found.time.begin(), found.time.end()};
}

auto Refuses(const std::string& what) {
  return ThrowsMessage<InputError>(HasSubstr(what));
}

TEST(Sessions, AreThoseOfTheColumnSessionElseDayElseRun) {
  const std::string rows = "1,1,1\n1,1,1\n1,1,2\n1,2,2\n2,2,2\n2,2,2\n";
  EXPECT_EQ(Find("Session,day,run\n" + rows).sessions.column, "Session");
  EXPECT_EQ(Find("x,day,run\n" + rows).sessions.column, "day");
  EXPECT_EQ(Find("x,y,run\n" + rows).sessions.column, "run");
  const FoundSessions found = Find("x,y,run\n" + rows, {.session = "y"});
  EXPECT_EQ(found.sessions.column, "y");
  EXPECT_THAT(found.sessions.codes, ElementsAre(0, 0, 0, 1, 1, 1));
  EXPECT_EQ(found.time_unit, "rows");
  EXPECT_THAT(Times(found), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(Sessions, BeginWhereTheCyclesThatAreGroupsCountAnew) {
  std::string text = "cycle,Zyklus,x\n";
  for (int i = 0; i < 24; ++i) {
    text += std::to_string(i % 12 / 3 + 1) + "," + std::to_string(i / 3 + 1) +
            "," + std::to_string(i % 5) + "\n";
  }
  EXPECT_EQ(Find(text).by, "counter");
  EXPECT_EQ(Find(text).sessions.labels.size(), 2U);
}

TEST(Sessions, AreDaysInGerman) {
  const FoundSessions found = Find("Tag,x\n1,1\n1,2\n2,3\n2,4\n");
  EXPECT_EQ(found.sessions.column, "Tag");
}

TEST(Sessions, AreTextsToo) {
  const FoundSessions found = Find("session,x\nmo,1\nmo,2\ntu,3\ntu,4\n");
  EXPECT_THAT(found.sessions.labels, ElementsAre("mo", "tu"));
}

TEST(Sessions, PassOverADefaultColumnThatCountsRows) {
  const FoundSessions found = Find("run,x\n1,1\n2,2\n3,3\n4,4\n");
  EXPECT_EQ(found.sessions.column, "");
  EXPECT_THAT(found.sessions.labels, ElementsAre("1"));
  EXPECT_THAT(found.remarks,
              Contains(HasSubstr("column 'run' has 4 values in 4 rows, which "
                                 "are not sessions")));
}

TEST(Sessions, TimeIsInSecondsByItsUnit) {
  EXPECT_THAT(Times(Find("time_s\n1\n2\n")), ElementsAre(1, 2));
  EXPECT_THAT(Times(Find("Time_min\n1\n2\n")), ElementsAre(60, 120));
  EXPECT_THAT(Times(Find("time_h\n1\n2\n")), ElementsAre(3600, 7200));
  EXPECT_THAT(Times(Find("time_ms\n1000\n2000\n")), ElementsAre(1, 2));
  const FoundSessions unnamed = Find("time\n1\n2\n");
  EXPECT_EQ(unnamed.time_unit, "s");
  EXPECT_THAT(unnamed.remarks,
              ElementsAre("time names no unit and is taken for seconds"));
  EXPECT_THAT(Times(Find("clock\n5\n7\n", {.time = "clock"})),
              ElementsAre(5, 7));
}

TEST(Sessions, TimeIsFoundInGerman) {
  EXPECT_THAT(Times(Find("Zeit [min],x\n1,5\n2,6\n")), ElementsAre(60, 120));
  EXPECT_EQ(Find("Zeit [s],time_s\n5,1\n6,2\n").time_column, 1);
}

TEST(Sessions, TimeMayBeDates) {
  const FoundSessions found = Find(
      "time,x\n2024-03-01T23:59:58,1\n2024-03-02 00:00:01,2\n"
      "2024-03-02T01:00:03+01:00,3\n");
  EXPECT_EQ(found.time[1] - found.time[0], 3.0);
  EXPECT_EQ(found.time[2] - found.time[1], 2.0);
  EXPECT_EQ(found.time_unit, "s");
}

TEST(Sessions, TimeIsFoundByItsDatesWhateverItsName) {
  const FoundSessions found = Find(
      "Zeitpunkt,Bediener,x\n04.03.2024 07:30,A,1\n04.03.2024 07:31,A,2\n"
      "05.03.2024 07:30,B,3\n05.03.2024 07:31,B,4\n");
  EXPECT_EQ(found.time_column, 0);
  EXPECT_TRUE(found.dated);
  EXPECT_THAT(found.sessions.codes, ElementsAre(0, 0, 1, 1));
  EXPECT_EQ(found.by, "nights");
  // One whose name says so comes first.
  EXPECT_EQ(Find("When,time_s\n07:30,1\n07:31,2\n").time_column, 1);
  EXPECT_FALSE(Find("When,time_s\n07:30,1\n07:31,2\n").dated);
}

TEST(Sessions, DatesHaveTheOrderThatGoesForward) {
  const auto times = [](const std::string& dates) {
    const FoundSessions found = Find("time\n" + dates);
    return std::pair(found.time[1] - found.time[0], found.remarks.at(0));
  };
  constexpr double kDay = 86400.0;
  const auto day_first = times("30/04/2024 7:00\n01/05/2024 7:00\n");
  EXPECT_EQ(day_first.first, kDay);
  EXPECT_THAT(day_first.second, HasSubstr("are read as day/month/year"));
  const auto month_first = times("4/30/2024 7:00\n5/1/2024 7:00\n");
  EXPECT_EQ(month_first.first, kDay);
  EXPECT_THAT(month_first.second, HasSubstr("are read as month/day/year"));
  // 3 April and 2 May, or 4 March and 5 February.
  EXPECT_EQ(times("03/04/2024 7:00\n02/05/2024 7:00\n").first, 29 * kDay);
  EXPECT_EQ(times("04/03/2024 7:00\n05/02/2024 7:00\n").first, 29 * kDay);
}

TEST(Sessions, AreTheDatesWhereTimeHasNone) {
  const std::string rows =
      "01.03.2024,7:00,1\n01.03.2024,7:10,2\n02.03.2024,7:20,3\n"
      "02.03.2024,7:30,4\n";
  // Hours beside them tell the nights.
  const FoundSessions apart = Find("Datum,Uhrzeit,x\n" + rows);
  EXPECT_THAT(apart.sessions.codes, ElementsAre(0, 0, 1, 1));
  EXPECT_EQ(apart.by, "nights");
  EXPECT_EQ(apart.time_column, 1);
  EXPECT_EQ(apart.time[2] - apart.time[1], 86400.0 + 600.0);
  EXPECT_EQ(Find("Datum,other,x\n01.03.2024,a,1\n02.03.2024,b,2\n"
                 "02.03.2024,b,2\n")
                .sessions.column,
            "Datum");
  EXPECT_EQ(Find("empty,x\n,1\n,2\n").sessions.column, "");
  EXPECT_EQ(Find("Datum,time_s\n01.03.2024,1\n02.03.2024,2\n02.03.2024,3\n")
                .sessions.column,
            "");
}

TEST(Sessions, AreCutWhereTimeGoesBackOrAfterANight) {
  std::string text = "time_s\n";
  for (const int time : {0,
                         10,
                         20,
                         30,
                         40,
                         50,
                         3000,
                         3010,
                         43000,
                         43010,
                         43020,
                         0,
                         10,
                         20,
                         30,
                         40}) {
    text += std::to_string(time) + "\n";
  }
  // A pause of 50 minutes is none of 11 hours.
  const FoundSessions found = Find(text);
  EXPECT_THAT(found.sessions.codes,
              ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2, 2));
  EXPECT_EQ(found.by, "clock");
  EXPECT_EQ(found.sessions.column, "");
  EXPECT_THAT(Find(text, {.gap = "20min"}).sessions.labels.size(), 4U);
}

TEST(Sessions, AreOneWhereNothingTells) {
  const FoundSessions found = Find("x\n1\n2\n");
  EXPECT_THAT(found.sessions.codes, ElementsAre(0, 0));
  EXPECT_THAT(found.remarks, IsEmpty());
  EXPECT_THAT(found.known, Each(true));
  EXPECT_THAT(Find("time_s\n1\n2\n").sessions.labels, SizeIs(1));
}

TEST(Sessions, MayHaveSeveralRowsAtOneTime) {
  EXPECT_THAT(Times(Find("time_s,day\n0,1\n5,1\n5,1\n5,1\n9,1\n")),
              ElementsAre(0, 5, 5, 5, 9));
  EXPECT_THAT(Find("time_s\n5\n5\n5\n").sessions.codes, ElementsAre(0, 0, 0));
}

TEST(Sessions, RefuseTimeThatGoesBackInANamedOne) {
  EXPECT_THAT([] { Find("time_s,day\n0,1\n9,1\n0,2\n5,2\n3,2\n"); },
              Refuses("log.csv: line 6 (data row 4), column 'time_s': time "
                      "goes back by 2 s within 'day' '2'; sort its rows"));
  // Another session may begin anew, and rows of two may alternate.
  EXPECT_NO_THROW(Find("time_s,day\n5,1\n0,2\n6,1\n1,2\n"));
  EXPECT_EQ(
      Find("time_s,day\n9,1\n0,1\n9,2\n0,2\n", {.time = "none"}).time_unit,
      "rows");
}

TEST(Sessions, PassOverATimeWithoutOrder) {
  const std::string text = "time_s\n5\n3\n8\n1\n9\n2\n7\n4\n";
  const FoundSessions found = Find(text);
  EXPECT_EQ(found.time_unit, "rows");
  EXPECT_EQ(found.sessions.labels.size(), 1U);
  EXPECT_THAT(found.remarks,
              Contains(HasSubstr("'time_s' goes back at 4 of 7 steps, so the "
                                 "rows are not in order of time")));
  EXPECT_THAT([&] { Find(text, {.time = "time_s"}); },
              Refuses("sort them, or name the column of sessions"));
}

TEST(Sessions, PassOverATimeInWordsThatNobodyNamed) {
  const std::string text = "time,x\nmorning,1\nnoon,2\n";
  EXPECT_THAT(
      Find(text).remarks,
      Contains(HasSubstr(
          "column 'time': 'morning' is not a time; the column is skipped")));
  EXPECT_THAT([&] { Find(text, {.time = "time"}); },
              Refuses("'morning' is not a time; write seconds, or dates"));
}

TEST(Sessions, SayWhereACellIsMissing) {
  const std::string text = "time_s,x\n0,1\n,2\n8,3\n";
  EXPECT_THAT(Find(text).remarks, Contains(HasSubstr("no value there")));
  EXPECT_THAT([&] { Find(text, {.time = "time_s"}); },
              Refuses("line 3 (data row 1), column 'time_s': empty cell"));
  const FoundSessions found =
      Find(text, {.time = "time_s", .missing = MissingPolicy::kDropRows});
  EXPECT_THAT(found.known, ElementsAre(true, false, true));
  EXPECT_THAT(Times(found), ElementsAre(0, 0, 8));
  EXPECT_THAT([] { Find("day,x\n1,1\n,2\n", {.session = "day"}); },
              Refuses("column 'day': empty cell"));
}

TEST(Sessions, OfAnEmptyColumnAreRefusedOnlyWhereItIsNamed) {
  const std::string text = "day,run,x\n,1,1\n,1,2\n,2,3\n";
  const FoundSessions found = Find(text, {.missing = MissingPolicy::kDropRows});
  EXPECT_EQ(found.sessions.column, "run");
  EXPECT_THAT(found.known, Each(true));
  EXPECT_THAT(found.remarks, Contains(HasSubstr("column 'day' is empty; the")));
  EXPECT_THAT(
      [&] {
        Find(text, {.session = "day", .missing = MissingPolicy::kDropRows});
      },
      Refuses("column 'day' names no session in any row"));
}

TEST(Sessions, AskWhichOfSeveralTimesIsMeant) {
  EXPECT_THAT(Find("time_s,time_h\n0,1\n1,2\n").remarks,
              Contains(HasSubstr("name one with time")));
  EXPECT_THAT([] { Find("x\n0\n", {.time = "clock"}); },
              Refuses("no column 'clock' (time)"));
}

TEST(Sessions, NeverTakeWhatIsMeasuredForTheTime) {
  const std::string text = "time_to_fail,day\n3,1\n1,2\n2,2\n";
  const FoundSessions found = Find(text, {.target = "time_to_fail"});
  EXPECT_EQ(found.time_unit, "rows");
  EXPECT_THAT(found.sessions.codes, ElementsAre(0, 1, 1));
  EXPECT_THAT(Find(text, {.target = "day"}).sessions.column, IsEmpty());
  EXPECT_THAT(
      [&] { Find(text, {.target = "day", .session = "day"}); },
      Refuses("column 'day' is the target or the weight; name another with "
              "session"));
}

// A machine that warms, read with other columns before its own.
Reading ReadWith(const std::string& header,
                 const std::function<std::string(const Log::Row&)>& cells) {
  return warming_log::Read(warming_log::Text(
      header + ",position_mm,t1_degC,error_um",
      Log().Rows(),
      [&](const Log::Row& row) {
        return std::vector<std::string>{cells(row),
                                        warming_log::Fixed(row.position),
                                        warming_log::Fixed(row.warm),
                                        warming_log::Fixed(row.error)};
      }));
}

TEST(Sessions, AreCountedWhereRowsAreUsed) {
  const std::string text = warming_log::Text(
      "day,position_mm,t1_degC,error_um",
      Log().Rows(),
      [](const Log::Row& row) {
        return std::vector<std::string>{
            std::to_string(row.day),
            warming_log::Fixed(row.position),
            warming_log::Fixed(row.warm),
            row.day == 1 ? "" : warming_log::Fixed(row.error)};
      });
  EXPECT_EQ(warming_log::Read(text, {.missing = MissingPolicy::kDropRows})
                .sessions.count,
            3);
}

TEST(Sessions, AreNotThoseOfALabelThatAllRowsShare) {
  const Reading reading = ReadWith("session,time_s", [](const Log::Row& row) {
    return "1," + warming_log::Fixed(row.time);
  });
  EXPECT_EQ(reading.sessions.count, 4);
  EXPECT_EQ(reading.sessions.by, "nights");
  EXPECT_EQ(
      ReadWith("session", [](const Log::Row&) { return "7"; }).sessions.column,
      "session");
}

TEST(Sessions, AreNoMonthsOfDates) {
  int day = 0;
  const Reading reading = ReadWith("date", [&](const Log::Row&) {
    const int month = day / 28;
    const int of_month = 1 + day++ % 28;
    return "2024-0" + std::to_string(1 + month) + (of_month < 10 ? "-0" : "-") +
           std::to_string(of_month);
  });
  EXPECT_EQ(reading.sessions.by, "rest");
}

TEST(Sessions, GoOnWhereSecondsOfTheDayPassMidnight) {
  // The first of four nights begins at 23:55.
  const auto of_day = [](const Log::Row& row) {
    return std::fmod(row.time - 1000.0 + 86100.0, 86400.0);
  };
  const Reading seconds = ReadWith("time_s", [&](const Log::Row& row) {
    return warming_log::Fixed(of_day(row));
  });
  EXPECT_EQ(seconds.sessions.count, 4);
  const Reading hours = ReadWith("hour", [&](const Log::Row& row) {
    return warming_log::Fixed(of_day(row) / 3600.0);
  });
  EXPECT_EQ(hours.sessions.count, 4);
}

TEST(Sessions, AreShiftsAndWeekdaysEachTimeTheyReturn) {
  const Reading shifts = ReadWith("shift,clock", [](const Log::Row& row) {
    return std::to_string(1 + row.day % 2) + "," +
           (row.day % 2 == 0 ? "06:" : "15:") +
           std::to_string(10 + row.cycle % 5) + ":00";
  });
  EXPECT_EQ(shifts.sessions.count, 4);
  const Reading weekdays = ReadWith("KW,Tag", [](const Log::Row& row) {
    return (row.day < 3 ? "2024-W09," : "2024-W10,") +
           std::to_string(1 + row.day % 3);
  });
  EXPECT_EQ(weekdays.sessions.count, 4);
}

TEST(Sessions, BeginColdWhereHoursOfWorkStandStillOvernight) {
  double hours = 1234.0;
  const Reading reading = ReadWith("Betriebsstunden [h]", [&](const Log::Row&) {
    hours += 0.02;
    return warming_log::Fixed(hours);
  });
  EXPECT_EQ(reading.sessions.count, 4);
  EXPECT_EQ(reading.sessions.by, "rest");
}

TEST(MakeDataset, KnowsTheSessionsOfEveryRowRead) {
  const PreparedDataset prepared = MakeDataset(
      ParseCsv("day,time_s,t1_degC,error_um\n1,0,,1\n1,5,20,2\n2,60,21,3\n"
               "2,65,,4\n2,70,22,6\n",
               "log.csv"),
      {.missing = MissingPolicy::kDropRows});
  const Dataset& dataset = prepared.dataset;
  ASSERT_NE(dataset.log(), nullptr);
  EXPECT_THAT(dataset.log_rows(), ElementsAre(1, 2, 4));
  EXPECT_THAT(dataset.session_codes(), ElementsAre(0, 1, 1));
  EXPECT_THAT(dataset.log()->first_rows, ElementsAre(1, 2));
  EXPECT_EQ(dataset.log()->input_values.rows(), 5);
  EXPECT_TRUE(std::isnan(dataset.log()->input_values(3, 0)));
  EXPECT_EQ(dataset.log()->input_values(4, 0), 22.0);
  EXPECT_EQ(dataset.num_inputs(), 1);  // neither day nor time
  EXPECT_NE(&dataset.input_values(), &dataset.log()->input_values);
}

// What is not measured there is known there.
TEST(MakeDataset, TakesTheZeroAtTheFirstCompleteRowMeasuredOrNot) {
  const PreparedDataset prepared = MakeDataset(
      ParseCsv("day,time_s,t1_degC,error_um\n1,0,,\n1,5,20,\n1,10,21,2\n"
               "2,60,21,\n2,65,22,4\n2,70,23,6\n",
               "log.csv"),
      {.missing = MissingPolicy::kDropRows});
  EXPECT_THAT(prepared.dataset.log()->first_rows, ElementsAre(1, 3));
}

TEST(MakeDataset, KeepsTheInputsOnceWhereNoRowWasDropped) {
  const PreparedDataset prepared = MakeDataset(
      ParseCsv("day,time_s,t1_degC,error_um\n1,0,20,1\n1,5,21,2\n2,60,22,3\n",
               "log.csv"),
      {});
  const Dataset& dataset = prepared.dataset;
  ASSERT_NE(dataset.log(), nullptr);
  EXPECT_EQ(&dataset.input_values(), &dataset.log()->input_values);
  EXPECT_EQ(dataset.input_values(), Eigen::Vector3d(20, 21, 22));
}

TEST(MakeDataset, TakesTheFirstValueOfEachSessionOffTheTarget) {
  const PreparedDataset prepared =
      MakeDataset(ParseCsv("day,t1_degC,error_um\n1,20,5\n1,21,7\n2,20,-3\n"
                           "2,22,1\n",
                           "log.csv"),
                  {.align = Alignment::kFirst});
  EXPECT_EQ(prepared.dataset.target_values(), Eigen::Vector4d(0, 2, 0, 4));
  EXPECT_EQ(prepared.dataset.align(), Alignment::kFirst);
  EXPECT_THAT(prepared.remarks, Contains(HasSubstr("align = first")));
}

}  // namespace
}  // namespace errmap::data
