#include "data/measurements/joined_tables.h"

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::data {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

JoinedTable Join(const std::vector<std::pair<std::string, std::string>>& files,
                 const DatasetSelection& selection = {}) {
  std::vector<CsvTable> tables;
  for (const auto& [name, text] : files) {
    tables.push_back(ParseCsv(text, name));
  }
  return JoinTables(std::move(tables), selection);
}

std::vector<std::string> Cells(const CsvTable& table, const char* name) {
  std::vector<std::string> cells;
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    cells.push_back(table.CellText(table.At(table.Find(name)), row));
  }
  return cells;
}

TEST(JoinTables, MakesASessionOfEachFileWhereNothingElseTellsThemApart) {
  const JoinedTable joined =
      Join({{"a/2024-03-01.csv", "t_degC,error_um\n20,1\n21,2\n"},
            {"a/2024-03-02.csv", "error_um,t_degC\n3,22\n"}});
  EXPECT_THAT(joined.remarks, IsEmpty());
  EXPECT_THAT(Cells(joined.table, "t_degC"), ElementsAre("20", "21", "22"));
  EXPECT_THAT(Cells(joined.table, "error_um"), ElementsAre("1", "2", "3"));
  EXPECT_THAT(Cells(joined.table, kFileColumn),
              ElementsAre("2024-03-01", "2024-03-01", "2024-03-02"));
  EXPECT_EQ(joined.table.Where(2, "t_degC"),
            "a/2024-03-02.csv: line 2 (data row 0), column 't_degC'");
  const PreparedDataset prepared =
      MakeDataset(Join({{"a.csv", "t_degC,error_um\n20,1\n21,2\n22,4\n"},
                        {"b.csv", "t_degC,error_um\n23,3\n24,2\n"}})
                      .table,
                  {});
  EXPECT_EQ(prepared.dataset.num_sessions(), 2);
  EXPECT_EQ(prepared.dataset.log()->sessions.column, kFileColumn);
}

TEST(JoinTables, TakesTheNumberOfAFileForNoReading) {
  const std::string header = "time_s,t_degC,error_um\n";
  const Dataset dataset =
      MakeDataset(
          Join({{"04.csv", header + "0,20,1\n5,21,2\n10,22,4\n"},
                {"05.csv", header + "90000,23,3\n90005,24,2\n90010,22,4\n"}})
              .table,
          {})
          .dataset;
  EXPECT_EQ(dataset.num_rows(), 6);
  EXPECT_EQ(dataset.num_inputs(), 1);
}

TEST(JoinTables, LeavesSessionsAsTheyAreWhereNoTwoFilesNameThemAlike) {
  const CsvTable table = Join({{"a.csv", "day,error_um\n1,1\n1,2\n2,2\n2,3\n"},
                               {"b.csv", "day,error_um\n3,1\n3,2\n"}})
                             .table;
  EXPECT_LT(table.Find(kFileColumn), 0);
  EXPECT_THAT(Cells(table, "day"), ElementsAre("1", "1", "2", "2", "3", "3"));
}

TEST(JoinTables, NamesSessionsByTheirFileWhereTwoHaveTheSameName) {
  const CsvTable table = Join({{"a.csv", "day,error_um\n1,1\n1,2\n"},
                               {"b.csv", "day,error_um\n1,1\n1,2\n2,3\n2,3\n"}})
                             .table;
  EXPECT_LT(table.Find(kFileColumn), 0);
  EXPECT_THAT(Cells(table, "day"),
              ElementsAre("a", "a", "b, 1", "b, 1", "b, 2", "b, 2"));
}

TEST(JoinTables, TakesAFileForOneSessionWhateverTheLeapsOfItsTime) {
  const auto cycles = [](const std::string& last) {
    return "time_s,x_mm,error_um\n0,1,1\n1,2,2\n2,3,3\n900,1,3\n901,2," + last +
           "\n";
  };
  const PreparedDataset prepared = MakeDataset(
      Join({{"a.csv", cycles("1")}, {"b.csv", cycles("1.5")}}).table, {});
  EXPECT_THAT(prepared.dataset.log()->sessions.labels, ElementsAre("a", "b"));
}

TEST(JoinTables, MakesOneSessionOfFilesThatAreCountedInADay) {
  const auto files = [](const std::vector<std::string>& names,
                        const std::string& head,
                        const std::string& time) {
    std::vector<std::pair<std::string, std::string>> texts;
    for (const std::string& name : names) {
      std::string text = head + "x_mm,error_um\n";
      for (int i = 0; i < 4; ++i) {
        text += (time.empty() ? "" : std::to_string(i) + time) +
                std::to_string(50 * i) + "," +
                std::to_string(i + static_cast<int>(texts.size())) + "\n";
      }
      texts.emplace_back(name + ".csv", text);
    }
    return texts;
  };
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{
           {"day1_run1", "day1_run2", "day2_run1", "day2_run2"},
           {"X_20240307_01", "X_20240307_02", "X_20240308_01", "X_20240308_02"},
           {"X_2024-06-17_07-58-30",
            "X_2024-06-17_08-06-50",
            "X_2024-06-18_08-50-53",
            "X_2024-06-18_09-15-53"}}) {
    for (const char* const time : {"", ","}) {
      const JoinedTable joined =
          Join(files(names, *time == 0 ? "" : "t [s],", time));
      EXPECT_THAT(joined.remarks, ElementsAre(HasSubstr("2 sessions")));
      const PreparedDataset prepared = MakeDataset(joined.table, {});
      EXPECT_EQ(prepared.dataset.num_sessions(), 2) << names[0];
      EXPECT_EQ(prepared.dataset.num_inputs(), 1);
    }
  }
  // Numbers that go on, or other words, are files of their own.
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{
           {"day1_run1", "day1_run2", "day2_run3", "day2_run4"},
           {"x_up1", "x_up2", "x_down1", "x_down2"}}) {
    EXPECT_EQ(MakeDataset(Join(files(names, "", "")).table, {})
                  .dataset.num_sessions(),
              4);
  }
}

TEST(JoinTables, PutsFilesWhoseDatesInterleaveInOrderOfTime) {
  std::string up = "time,x_mm,error_um\n";
  std::string down = up;
  for (int day = 0; day < 2; ++day) {
    for (int i = 0; i < 24; ++i) {
      const bool is_up = i / 4 % 2 == 0;
      const int place = is_up ? i % 4 : 3 - i % 4;
      (is_up ? up : down) += "2024-05-1" + std::to_string(5 + day) +
                             " 08:" + std::to_string(10 + i) + ":00," +
                             std::to_string(50 * place) + "," +
                             std::to_string(i % 7) + "\n";
    }
  }
  const PreparedDataset prepared =
      MakeDataset(Join({{"x_down.csv", down}, {"x_up.csv", up}}).table, {});
  EXPECT_EQ(prepared.dataset.num_sessions(), 2);
  EXPECT_EQ(prepared.reading.order, "time");
}

TEST(JoinTables, LeavesOutAFileThatWasSavedTwice) {
  const std::string day = "time_s,x_mm,error_um\n0,1,1\n1,2,2\n2,3,3\n";
  const JoinedTable joined = Join({{"a.csv", day}, {"b.csv", day}});
  EXPECT_EQ(joined.table.num_rows, 3U);
  EXPECT_THAT(joined.remarks,
              ElementsAre(HasSubstr("b.csv: holds the rows of a.csv")));
}

TEST(JoinTables, KeepsADayThatGoesOnInTheNextFile) {
  const std::string head = "day,time_s,error_um\n";
  const JoinedTable joined =
      Join({{"a.csv", head + "1,0,1\n1,600,2\n"},
            {"b.csv", head + "1,1200,3\n1,1800,4\n2,90000,5\n"}});
  EXPECT_THAT(Cells(joined.table, "day"), ElementsAre("1", "1", "1", "1", "2"));
  // A clock that starts anew in each file is one of another day.
  const JoinedTable anew = Join({{"a.csv", head + "1,0,1\n1,600,2\n"},
                                 {"b.csv", head + "1,0,3\n1,600,4\n"}});
  EXPECT_THAT(Cells(anew.table, "day"), ElementsAre("a", "a", "b", "b"));
}

TEST(JoinTables, ReadsNamesAndUnitsAsTheFirstFileHasThem) {
  const JoinedTable joined = Join({{"a.csv", "T_degC,error_um\n20,1\n"},
                                   {"b.csv", "t_K,error_mm\n293.15,0.002\n"}});
  EXPECT_THAT(Cells(joined.table, "T_degC"), ElementsAre("20", "20"));
  EXPECT_THAT(Cells(joined.table, "error_um"), ElementsAre("1", "2"));
  EXPECT_THAT(
      joined.remarks,
      ElementsAre("b.csv: 't_K' is read as 'T_degC', from K to degC",
                  "b.csv: 'error_mm' is read as 'error_um', from mm to um"));
}

TEST(JoinTables, LeavesOutWhatNotAllFilesHaveAndSaysSo) {
  const JoinedTable joined =
      Join({{"a.csv", "t_degC,humidity,error_um\n20,40,1\n"},
            {"b.csv", "t_degC,u,error_um\n21,3,2\n"}});
  EXPECT_LT(joined.table.Find("humidity"), 0);
  EXPECT_THAT(joined.remarks,
              ElementsAre("columns that not all files have are left out: "
                          "'humidity' (not in b.csv), 'u' (not in a.csv)"));
}

TEST(JoinTables, RefusesFilesThatContradict) {
  EXPECT_THAT(
      [] {
        Join({{"a.csv", "t_degC,error_x_um\n20,1\n"},
              {"b.csv", "t_degC,error_y_um\n20,1\n"}});
      },
      ThrowsMessage<InputError>(
          "b.csv: no column 'error_x_um', which a.csv has; files that are "
          "joined measure the same error"));
  EXPECT_THAT(
      [] {
        Join({{"a.csv", "t_degC,error_um\n20,1\n"},
              {"b.csv", "t_degC,error_urad\n20,1\n"}});
      },
      ThrowsMessage<InputError>(
          "b.csv: column 'error_urad' is not in the unit of 'error_um' in "
          "a.csv, nor to be converted; name both with their units"));
  EXPECT_THAT(
      [] {
        Join({{"a.csv", "t_degC,h,error_um\n20,1,1\n"},
              {"b.csv", "t_degC,error_um\n20,1\n"}},
             {.inputs = {"h"}});
      },
      ThrowsMessage<InputError>(
          HasSubstr("b.csv: no column 'h', which a.csv")));
}

TEST(JoinTables, KnowsAMixtureOfDecimalsInOneFileOnly) {
  const std::string comma = "t_degC;error_um\n20,5;1,5\n21,5;2,5\n22,0;1,0\n";
  const std::string point = "t_degC;error_um\n20.5;1.5\n21.5;2.5\n22.0;1.5\n";
  EXPECT_EQ(MakeDataset(Join({{"a.csv", comma}, {"b.csv", point}}).table, {})
                .dataset.num_rows(),
            6);
}

}  // namespace
}  // namespace errmap::data
