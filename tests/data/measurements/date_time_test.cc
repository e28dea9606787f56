#include "data/measurements/date_time.h"

#include <gtest/gtest.h>

namespace errmap::data {
namespace {

TEST(DateTime, ReadsIso8601) {
  EXPECT_EQ(ParseDateTime("1970-01-01T00:00:00Z"), 0.0);
  EXPECT_EQ(ParseDateTime("2000-03-01"), 951868800.0);  // after a leap day
  EXPECT_EQ(ParseDateTime("1970-01-02 01:02:03.5"), 86400.0 + 3723.5);
  EXPECT_EQ(ParseDateTime(" 1970-01-01T00:01 "), 60.0);
  EXPECT_EQ(ParseDateTime("1970-01-01T02:00:00+01:30"), 1800.0);
  EXPECT_EQ(ParseDateTime("1970-01-01T02:00-0100"), 10800.0);
  EXPECT_EQ(ParseDateTime("12:00:05"), 43205.0);
  EXPECT_EQ(ParseDateTime("07:30"), 27000.0);
}

TEST(DateTime, RefusesWhatIsNone) {
  for (const char* text : {"",
                           "morning",
                           "2024-02-30",
                           "2023-02-29T12:00",
                           "2024-13-01",
                           "2024-3-1",
                           "24:00",
                           "12:60",
                           "12",
                           "01.03.2024",
                           "2024-03-01T",
                           "2024-03-01T12:00:05 h",
                           "2024-03-01T12:00:05+1"}) {
    EXPECT_FALSE(ParseDateTime(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace errmap::data
