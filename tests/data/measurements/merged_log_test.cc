#include "data/measurements/merged_log.h"

#include <cstddef>
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

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Four readings of an error at 0, 10, 20 and 30 s, with decimal points.
PreparedDataset MadeWith(const std::string& log) {
  CsvTable table = ParseCsv("time_s,error_um\n0,1.5\n10,2.5\n20,3.5\n30,5.5\n",
                            "errors.csv");
  MergeLog(ParseCsv(log, "log.csv"), {}, &table);
  return MakeDataset(table, {});
}

TEST(MergeLog, TakesTheLastReadingOfALogOfItsOwnDecimals) {
  const PreparedDataset prepared =
      MadeWith("time_s;t_degC\n0;20,5\n10;21,5\n20;22,5\n30;24,5\n");
  EXPECT_THAT(prepared.dataset.input_values().col(0),
              ElementsAre(20.5, 21.5, 22.5, 24.5));
}

TEST(MergeLog, RefusesALogThatMixesDecimalMarks) {
  EXPECT_THAT(
      [] {
        MadeWith(
            "time_s;t1_degC;t2_degC\n0;20,5;20.5\n10;21,5;21.5\n"
            "20;22,5;22.5\n30;24,5;24.5\n");
      },
      ThrowsMessage<InputError>(HasSubstr("decimal comma (20,5)")));
}

// Eight readings of an error, 10 s apart on two days, the second log's times.
CsvTable Errors() {
  std::string text = "time,error_um\n";
  for (int i = 0; i < 8; ++i) {
    text += "2024-03-0" + std::to_string(4 + i / 4) +
            " 08:00:" + std::to_string(10 + 10 * (i % 4)) + "," +
            std::to_string(i) + "\n";
  }
  return ParseCsv(text, "errors.csv");
}

// The columns that a log adds, and what the first of them has in each row.
std::vector<std::string> NamesWith(const std::string& log,
                                   std::vector<double>* first) {
  CsvTable table = Errors();
  MergeLog(ParseCsv(log, "log.csv"), {}, &table);
  std::vector<std::string> names;
  for (std::size_t i = 2; i < table.columns.size(); ++i) {
    names.push_back(table.columns[i].name);
  }
  *first = table.columns.at(2).values;
  return names;
}

// A line of a log for each of the moments, in the order given.
std::string LogOf(const std::string& header,
                  const std::vector<int>& order,
                  const std::function<std::string(int)>& line) {
  std::string text = header + "\n";
  for (const int i : order) text += line(i) + "\n";
  return text;
}

std::string At(int i) {
  return "2024-03-0" + std::to_string(4 + i / 4) +
         " 08:00:" + std::to_string(10 + 10 * (i % 4));
}

TEST(MergeLog, TakesRowsInAnyOrder) {
  for (const std::vector<int>& order :
       {std::vector<int>{7, 6, 5, 4, 3, 2, 1, 0},
        std::vector<int>{3, 7, 0, 5, 1, 6, 2, 4}}) {
    std::vector<double> first;
    EXPECT_THAT(NamesWith(LogOf("time,t1_degC",
                                order,
                                [](int i) {
                                  return At(i) + "," + std::to_string(20 + i);
                                }),
                          &first),
                ElementsAre("t1_degC"));
    EXPECT_THAT(first, ElementsAre(20, 21, 22, 23, 24, 25, 26, 27));
  }
}

TEST(MergeLog, LeavesOutDatesAndRunningNumbers) {
  const std::vector<int> order = {0, 1, 2, 3, 4, 5, 6, 7};
  std::vector<double> first;
  for (const char* name : {"No.", "Nr", "Sample"}) {
    EXPECT_THAT(NamesWith(LogOf(std::string(name) + ";Datum;Uhrzeit;t1_degC",
                                order,
                                [](int i) {
                                  return std::to_string(i + 1) + ";0" +
                                         std::to_string(4 + i / 4) +
                                         ".03.2024;" + At(i).substr(11) +
                                         ":000;20," + std::to_string(i);
                                }),
                          &first),
                ElementsAre("t1_degC"));
    EXPECT_EQ(first[7], 20.7);
  }
  EXPECT_THAT(NamesWith(LogOf("Date,timestamp,t1_degC",
                              order,
                              [](int i) {
                                return At(i).substr(0, 10) + "," + At(i) +
                                       ",20";
                              }),
                        &first),
              ElementsAre("t1_degC"));
}

TEST(MergeLog, MakesAColumnOfEachChannel) {
  const struct {
    const char* header;
    const char* ends[2];  // of a line of each channel
    std::vector<std::string> names;
  } kCases[] = {
      {"time,channel,value", {",T1,2", ",T2,3"}, {"T1", "T2"}},
      {"time,channel,value,unit",
       {",T1,2,degC", ",Air,3,degC"},
       {"T1 [degC]", "Air [degC]"}},
      {"time,sensor_id,temperature_degC",
       {",1,2", ",2,3"},
       {"temperature 1 [degC]", "temperature 2 [degC]"}},
  };
  for (const auto& [header, ends, names] : kCases) {
    const auto line = [&ends = ends](int i) {
      return At(i / 2) + ends[i % 2] + "";
    };
    for (const bool by_channel : {false, true}) {
      std::vector<int> order;
      for (int i = 0; i < 16; ++i) {
        order.push_back(by_channel ? 2 * (i % 8) + i / 8 : i);
      }
      std::vector<double> first;
      EXPECT_EQ(NamesWith(LogOf(header, order, line), &first), names);
      EXPECT_EQ(first, std::vector<double>(8, 2.0)) << header;
    }
  }
}

TEST(MergeLog, JoinsAStateAsItIs) {
  std::vector<double> first;
  EXPECT_THAT(NamesWith(LogOf("time,t1_degC,state",
                              {0, 1, 2, 3, 4, 5, 6, 7},
                              [](int i) {
                                return At(i) + ",20," + (i < 4 ? "on" : "off");
                              }),
                        &first),
              ElementsAre("t1_degC", "state"));
}

TEST(MergeLog, SaysWhyATimeIsNone) {
  CsvTable table = Errors();
  EXPECT_THAT(
      [&] {
        MergeLog(ParseCsv("time,t_degC\n2024-W10 8h05,1\n2024-W10 8h06,2\n",
                          "log.csv"),
                 {},
                 &table);
      },
      ThrowsMessage<InputError>(
          HasSubstr("'2024-W10 8h05' is not a time; write "
                    "it as 2024-03-01T12:00:05")));
}

// Times of errors.csv under this name, two hours before those of the log.
PreparedDataset MadeInZones(const std::string& name,
                            const std::string& behind,
                            const std::string& log_name,
                            const std::string& log_behind,
                            const std::string& offset = "") {
  const auto text = [](const std::string& head,
                       const std::string& end,
                       int hour,
                       const std::string& value) {
    std::string lines = head;
    for (int i = 0; i < 4; ++i) {
      lines += "2024-06-03 " + std::string(hour < 10 ? "0" : "") +
               std::to_string(hour) + ":00:" + std::to_string(10 + 10 * i) +
               end + ";" + value + std::to_string(i) + "\n";
    }
    return lines;
  };
  CsvTable table =
      ParseCsv(text(name + ";error_um\n", behind, 10, ""), "errors.csv");
  MergeLog(
      ParseCsv(text(log_name + ";t_degC\n", log_behind, 8, "2"), "log.csv"),
      {.clock_offset = offset},
      &table);
  return MakeDataset(table, {});
}

TEST(MergeLog, TakesAccountOfTimeZones) {
  for (const auto& [name, log_name] :
       std::vector<std::pair<std::string, std::string>>{
           {"Time (CEST)", "Time (UTC)"},
           {"Date Time, GMT+02:00", "Date Time, GMT+00:00"}}) {
    EXPECT_THAT(
        MadeInZones(name, "", log_name, "").dataset.input_values().col(0),
        ElementsAre(20, 21, 22, 23));
  }
  EXPECT_THAT(
      MadeInZones("time", "+02:00", "time", "Z").dataset.input_values().col(0),
      ElementsAre(20, 21, 22, 23));
}

TEST(MergeLog, AsksWhereOneOfTheClocksHasAZone) {
  for (const auto& [log_name, behind] :
       std::vector<std::pair<std::string, std::string>>{{"time", "Z"},
                                                        {"Time (UTC)", ""}}) {
    EXPECT_THAT([&] { MadeInZones("time", "", log_name, behind); },
                ThrowsMessage<OpenQuestion>(HasSubstr("clock_offset = -2h")));
    EXPECT_THAT(MadeInZones("time", "", log_name, behind, "-2h")
                    .dataset.input_values()
                    .col(0),
                ElementsAre(20, 21, 22, 23));
  }
}

}  // namespace
}  // namespace errmap::data
