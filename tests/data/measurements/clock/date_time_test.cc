#include "data/measurements/clock/date_time.h"

#include <string>

#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/clock/text_times.h"

namespace errmap::data {
namespace {

std::optional<double> Seconds(std::string_view text,
                              DateOrder order = DateOrder::kDayFirst) {
  const auto parsed = ParseDateTime(text, order);
  return parsed ? std::optional(parsed->seconds) : std::nullopt;
}

TEST(DateTime, ReadsIso8601) {
  EXPECT_EQ(Seconds("1970-01-01T00:00:00Z"), 0.0);
  EXPECT_EQ(Seconds("2000-03-01"), 951868800.0);  // after a leap day
  EXPECT_EQ(Seconds("1970-01-02 01:02:03.5"), 86400.0 + 3723.5);
  EXPECT_EQ(Seconds(" 1970-01-01T00:01 "), 60.0);
  EXPECT_EQ(Seconds("1970-01-01T02:00:00+01:30"), 1800.0);
  EXPECT_EQ(Seconds("1970-01-01T02:00-0100"), 10800.0);
  EXPECT_EQ(Seconds("12:00:05"), 43205.0);
  EXPECT_EQ(Seconds("07:30"), 27000.0);
}

TEST(DateTime, ReadsMonthsByNameZonesAndElapsedTimes) {
  const double day = *Seconds("2024-03-04");
  for (const char* text : {"4-Mar-2024 08:05:07",
                           "Mon 04 Mar 2024 08:05:07",
                           "4. M\u00e4rz 2024, 08:05:07 Uhr",
                           "04/mars/24 8:05:07 AM",
                           "2024-03-04 08:05:07 UTC",
                           "2024-03-04 10:05:07 UTC+02",
                           "2024-03-04 09:05:07 CEST"}) {
    const auto parsed = ParseDateTime(text);
    ASSERT_TRUE(parsed && parsed->has_date) << text;
    EXPECT_EQ(parsed->seconds, day + 29107.0) << text;
  }
  EXPECT_EQ(Seconds("08h05"), 29100.0);
  EXPECT_EQ(Seconds("08 h 05"), 29100.0);
  for (const char* text : {"29:05:07",
                           "1 05:05:07",
                           "1.05:05:07",
                           "1 day, 5:05:07",
                           "1 days 05:05:07.000"}) {
    const auto parsed = ParseDateTime(text);
    ASSERT_TRUE(parsed && parsed->elapsed) << text;
    EXPECT_EQ(parsed->seconds, 104707.0) << text;
  }
  EXPECT_EQ(Seconds("125:03.5"), 7503.5);
  EXPECT_EQ(ParseDateTime("08.05.07", DateOrder::kNoDate)->seconds, 29107.0);
}

TEST(DateTime, RefusesWhatIsNone) {
  for (const char* text : {"",
                           "morning",
                           "2024-02-30",
                           "2023-02-29T12:00",
                           "2024-13-01",
                           "2024-3-1",
                           "2024-03-01 24:00",
                           "12:60",
                           "12",
                           "01.13.2024",
                           "1.3.024",
                           "2024/3",
                           "3.4",
                           "13:05 PM",
                           "0:05 AM",
                           "2024-03-01T",
                           "2024-03-01T12:00:05 h",
                           "2024-03-01T12:00:05+1"}) {
    EXPECT_FALSE(ParseDateTime(text).has_value()) << text;
  }
}

TEST(DateTime, ReadsWhatLoggersAndSpreadsheetsWrite) {
  const double day = *Seconds("2024-03-04");
  for (const char* text : {"04.03.2024",
                           "4.3.2024",
                           "04.03.24",
                           "2024/03/04",
                           "2024.3.4",
                           "04/03/2024",
                           "4-3-2024"}) {
    EXPECT_EQ(Seconds(text), day) << text;
  }
  EXPECT_EQ(Seconds("4.3.70"), *Seconds("1970-03-04"));
  const double minute = day + 7 * 3600.0 + 5 * 60.0;
  EXPECT_EQ(Seconds("04.03.2024 07:05"), minute);
  EXPECT_EQ(Seconds("04.03.2024 7:05:00,5"), minute + 0.5);
  EXPECT_EQ(Seconds("3/4/2024 7:05:00 AM", DateOrder::kMonthFirst), minute);
  EXPECT_EQ(Seconds("3/4/2024 7:05 pm", DateOrder::kMonthFirst),
            minute + 12 * 3600.0);
  EXPECT_EQ(Seconds("12:05 AM"), 300.0);
  EXPECT_EQ(Seconds("12:05PM"), 12 * 3600.0 + 300.0);
  EXPECT_FALSE(Seconds("13/4/2024", DateOrder::kMonthFirst).has_value());
}

TEST(DateTime, ReadsPackedDatesDaysOfTheYearAndTheTimeFirst) {
  const double moment = *Seconds("2024-03-04") + 8 * 3600.0 + 14 * 60.0;
  for (const char* text : {"20240304 0814",
                           "20240304T081400",
                           "20240304_081400",
                           "20240304-081400",
                           "20240304 08:14",
                           "2024-064T08:14",
                           "2024/064 08:14:00",
                           "04-Mar-2024 08:14:00",
                           "04/Mar/2024:08:14:00 +0000",
                           "Mon Mar  4 08:14:00 2024",
                           "Mon Mar  4 09:14:00 CEST 2024",
                           "Mar 4, 2024 08:14 AM",
                           "March 4 2024, 08:14:00",
                           "08:14:00 04/03/2024",
                           "08:14, 2024-03-04",
                           "8:14 a. m. 04.03.2024",
                           "04/03/2024 8:14\u202fa.\u00a0m.",
                           "2024-03-04 08:14:00:000",
                           "2024-03-04T08-14-00",
                           "2024-03-04 - 08:14",
                           "2024_03_04 08:14:00",
                           "04MAR2024 08:14:00",
                           "March 04, 2024 at 08:14 AM",
                           "04.03.2024 klo 08.14.00",
                           "4. 3. 2024 8:14",
                           "2024. 03. 04. 08:14:00",
                           "04/03/2024 08h14m00s",
                           "[2024-03-04 08:14:00]"}) {
    const auto parsed = ParseDateTime(text);
    ASSERT_TRUE(parsed && parsed->has_date && parsed->has_time) << text;
    EXPECT_EQ(parsed->seconds, moment) << text;
  }
  EXPECT_EQ(Seconds("20240304 081400.5"), moment + 0.5);
  EXPECT_EQ(Seconds("08:14:00:250"), 29640.25);
  EXPECT_EQ(Seconds("08:14 p. m."), 29640.0 + 43200.0);
  EXPECT_EQ(Seconds("08:14 3/4/2024", DateOrder::kMonthFirst), moment);
  EXPECT_TRUE(ParseDateTime("08:14 3/4/2024")->by_order);
  EXPECT_EQ(Seconds("24/03/04 08:14", DateOrder::kYearFirst), moment);
  for (const char* text : {"20240304",
                           "20241304 081400",
                           "20240304 0814000",
                           "2023-366T08:14",
                           "2024-000",
                           "25:14 04/03/2024",
                           "Mon Mar 32 08:14:00 2024",
                           "Foo 4 08:14:00 2024",
                           "1:08:14:00"}) {
    EXPECT_FALSE(ParseDateTime(text).has_value()) << text;
  }
}

TEST(DateTime, ReadsWeeksAndCharactersForTheParts) {
  const auto seconds = [](std::string_view text) {
    const auto parsed = ParseDateTime(text);
    return parsed ? parsed->seconds : -1.0;
  };
  EXPECT_EQ(seconds("2024-W22-7"), seconds("2024-06-02"));
  EXPECT_EQ(seconds("2021-W01-1"), seconds("2021-01-04"));
  EXPECT_EQ(seconds("2020-W53-5 08:00"), seconds("2021-01-01 08:00"));
  for (const char* text : {"2024\u5e744\u67083\u65e5 8\u664241\u520639\u79d2",
                           "2024\u5e7404\u670803\u65e508\u65f641\u520639\u79d2",
                           "\u4ee4\u548c6\u5e744\u67083\u65e5 8:41:39"}) {
    EXPECT_EQ(seconds(text), seconds("2024-04-03 08:41:39")) << text;
  }
  EXPECT_EQ(Seconds("8\u664241\u520639\u79d2"), Seconds("08:41:39"));
  EXPECT_EQ(Seconds("08\u65f641\u5206"), Seconds("08:41"));
  EXPECT_EQ(Seconds("\uc624\uc804 08:41:39"), Seconds("08:41:39"));
  EXPECT_EQ(Seconds("\u4e0b\u5348 08:41:39"), Seconds("20:41:39"));
  EXPECT_EQ(seconds("2024/4/3 \u4e0b\u534812:41:39"),
            seconds("2024-04-03 12:41:39"));
  EXPECT_EQ(seconds("2024\u5e744\u67083\u65e5 8\u664241\u5206"),
            seconds("2024-04-03 08:41"));
  EXPECT_EQ(seconds("2024-W54-1"), -1.0);
}

TEST(DateTime, GoesOnBeyondADayButNotAtItsEnd) {
  EXPECT_EQ(Seconds("24:00"), 86400.0);
  for (const char* text : {"24:00", "24:00:00", "23:59:59"}) {
    EXPECT_FALSE(ParseDateTime(text)->elapsed) << text;
  }
  for (const char* text : {"24:00:01", "24:01", "25:00"}) {
    EXPECT_TRUE(ParseDateTime(text)->elapsed) << text;
  }
}

TEST(DateTime, KnowsMonthsInOtherLanguages) {
  for (const char* text : {"2-Ene-2026", "2. janvier 2026", "2 Gen 26"}) {
    EXPECT_EQ(Seconds(text), *Seconds("2026-01-02")) << text;
  }
  EXPECT_EQ(Seconds("2. M\u00e4rz 2026"), *Seconds("2026-03-02"));
  EXPECT_EQ(Seconds("2 juillet 2026"), *Seconds("2026-07-02"));
  EXPECT_EQ(Seconds("2 Out 2026"), *Seconds("2026-10-02"));
  EXPECT_FALSE(Seconds("2 Foo 2026").has_value());
}

TEST(DateTime, TellsWhereTheOrderMatters) {
  for (const char* text : {"3/4/2024", "03-04-2024 7:05"}) {
    EXPECT_TRUE(ParseDateTime(text)->by_order) << text;
  }
  for (const char* text : {"3.4.2024", "2024-04-03", "2024/4/3", "7:05"}) {
    EXPECT_FALSE(ParseDateTime(text)->by_order) << text;
  }
}

TEST(DateTime, TellsDatesFromTimesOfDay) {
  EXPECT_TRUE(ParseDateTime("04.03.2024")->has_date);
  EXPECT_FALSE(ParseDateTime("04.03.2024")->has_time);
  EXPECT_FALSE(ParseDateTime("7:05")->has_date);
  EXPECT_TRUE(ParseDateTime("7:05")->has_time);
}

TEST(TextTimes, BeginWithTheYearWhereTheFileIsShortSo) {
  const auto order = [](const std::string& dates) {
    return ReadTimes(ParseCsv("time\n" + dates, "f.csv").columns[0]).order;
  };
  EXPECT_EQ(order("24/03/04 08:00\n24/03/05 08:00\n"), "year/month/day");
  EXPECT_EQ(order("04/03/24 08:00\n05/03/24 08:00\n"), "day/month/year");
  EXPECT_EQ(order("03/04/24 08:00\n03/05/24 08:00\n"), "month/day/year");
  EXPECT_EQ(order("04/03/24 08:00\n04/03/24 09:00\n"), "day/month/year");
}

}  // namespace
}  // namespace errmap::data
