// How tables stand in files of laboratories, and which rows are theirs.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "tests/data/tables/small_tables.h"

namespace errmap::data {
namespace {

using namespace small_tables;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(TableShape, FindsTheTableBelowTitles) {
  for (const std::string title :
       {"Linear test of slide X,,\nin the morning,,\n,,\n",
        "Laser linear test\nFile: X.rtl\nDate: 04/03/2024 08:12\nTemp: "
        "20.3\n\n",
        "Machine,3\nTemp,20.3\n",
        "Temp,20.3,,\n"}) {
    const CsvTable table = ParseCsv(title + kNames + "\n" + Rows(), "f.csv");
    EXPECT_THAT(NamesIn(table),
                ElementsAre("position_mm", "t1_degC", "error_um"));
    ExpectRows(table);
    EXPECT_THAT(table.remarks, ElementsAre(HasSubstr(" above the table: '")));
    EXPECT_FALSE(table.titles.empty());
  }
}

// Two headers of LabVIEW above the rows; `names` and units in the second.
std::string Labview(const std::string& names,
                    const std::string& dimension,
                    const std::string& end = "\n") {
  std::string text = "LabVIEW Measurement\t\nSeparator\tTab\n" +
                     std::string("***End_of_Header***\t\n\t\n") +
                     "Channels\t2\t\t\nY_Unit_Label\tmm\tum\t\n" +
                     "X_Dimension\t" + dimension + "\t" + dimension +
                     "\t\nDelta_X\t0.5\t0.5\t\n***End_of_Header***\t\t\t\n" +
                     names + "\tComment\n";
  for (int i = 0; i < 4; ++i) {
    text += CsvNumber(0.5 * i) + "\t" + std::to_string(50 * (i % 2)) + "\t" +
            CsvNumber(1.25 + i) + "\t\n";
  }
  std::string lines;
  for (const char c : text) lines += c == '\n' ? end : std::string(1, c);
  return lines;
}

TEST(TableShape, FindsTheTableBelowBothHeadersOfLabview) {
  for (const char* end : {"\n", "\r\n"}) {
    const CsvTable table =
        ParseCsv(Labview("X_Value\tposition\terror", "Time", end), "f.lvm");
    ASSERT_GE(table.columns.size(), 3U);
    EXPECT_EQ(table.columns[0].name, "time_s");
    EXPECT_EQ(table.columns[1].name, "position [mm]");
    EXPECT_EQ(table.columns[2].name, "error [um]");
    EXPECT_EQ(table.num_rows, 4U);
    EXPECT_EQ(table.LineOfRow(0), 11U);
    EXPECT_EQ(table.columns[2].values[3], 4.25);
  }
  // A spectrum has no times.
  EXPECT_LT(
      ParseCsv(Labview("X_Value\tx\ty", "Frequency"), "f.lvm").Find("time_s"),
      0);
  // One header, and a line of tabs below it.
  EXPECT_EQ(ParseCsv("LabVIEW Measurement\n***End_of_Header***\t\n\t\n"
                     "X_Value\terror_um\n0\t1.5\n1\t2.5\n",
                     "f.lvm")
                .Find("time_s"),
            0);
}

TEST(TableShape, PassesOverTotalsBelowTheRows) {
  for (const char* totals : {"\nMean,2.31\nSamples,8\n",
                             "Mean,2.31\nSamples,8\n",
                             "\nStatistic,Value\nMean,2.31\n"}) {
    std::string text = "position_mm,t1_degC,error_um,n\n" + Rows(",1") + totals;
    const CsvTable table = ParseCsv(text, "f.csv");
    ExpectRows(table);
    EXPECT_THAT(table.remarks,
                ::testing::Contains(HasSubstr("2 lines of words among the "
                                              "rows")));
  }
}

TEST(TableShape, PassesOverTotalsUnderTheirColumns) {
  const CsvTable table = ParseCsv(
      "day,cycle,x_mm,error_um,t1_degC\n1,1,0,1.5,20\n1,1,50,2.5,20\n"
      "1,1,90,3.5,21\n\nMean,,,2.5\nStd dev,,,1\n",
      "f.csv");
  EXPECT_EQ(table.num_rows, 3U);
  EXPECT_FALSE(table.columns[0].is_text());
}

// As a sheet of ISO 230-2 ends.
TEST(TableShape, PassesOverFiguresBelowTheRowsOfASheet) {
  const CsvTable table = ParseCsv(
      "i,Target [mm],Run 1 \u2191 [um],Run 2 \u2191 [um]\n1,0,-0.5,1\n"
      "2,100,-2,0.5\n3,200,-3,0.25\nAccuracy A,,,12.4\nReversal B,,,1.3\n",
      "f.csv");
  EXPECT_EQ(table.num_rows, 3U);
  EXPECT_THAT(NamesIn(table),
              ::testing::Not(::testing::Contains("Accuracy A")));
  EXPECT_THAT(table.remarks,
              ::testing::Contains(HasSubstr("'Accuracy A', ...")));
}

TEST(TableShape, TakesNoBreakSpacesOffNamesAndNumbers) {
  const CsvTable table = ParseCsv(
      " x\xC2\xA0;\xE2\x80\xAFy ;z\n1\xC2\xA0;\xC2\xA0"
      "2,5;\xE2\x80\x89"
      "3\n\xA0"
      "4\xA0;5;6\n",
      "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("x", "y", "z"));
  EXPECT_THAT(table.columns[0].values, ElementsAre(1.0, 4.0));
  EXPECT_THAT(table.columns[1].values, ElementsAre(2.5, 5.0));
  EXPECT_THAT(table.columns[2].values, ElementsAre(3.0, 6.0));
}

TEST(TableShape, ReadsQuotesBehindBackslashes) {
  const CsvTable table = ParseCsv(
      "name,x\n\"Pipe \\\"0, inch\\\"\",1\n\"Bolt \\\"M19\\\", long\",2\n",
      "f.csv");
  EXPECT_EQ(table.CellText(table.columns[0], 0), "Pipe \"0, inch\"");
  EXPECT_EQ(table.CellText(table.columns[0], 1), "Bolt \"M19\", long");
  EXPECT_THAT(table.columns[1].values, ElementsAre(1.0, 2.0));
  // The end of a path.
  EXPECT_EQ(RefusalOf("name,x\n\"C:\\data\\\",1\n"), "read");
}

TEST(TableShape, ReadsQuotesInsideQuotedCells) {
  const CsvTable table =
      ParseCsv("x,note\n1,\"slide \"X\" warm\"\n2,\"\"\n", "f.csv");
  EXPECT_EQ(table.CellText(table.columns[1], 0), "slide \"X\" warm");
  EXPECT_THAT(table.columns[0].values, ElementsAre(1.0, 2.0));
}

// ---- Rows of another length.

TEST(OddRows, AreNamedAllAtOnceAndLeftOutWhereAsked) {
  const std::string text =
      kNames + ",remark\n" + Rows(",") + "1,,2,3,\n1,2,3\n1,2,3\n7,8,9,\n1,2\n";
  EXPECT_EQ(RefusalOf(text, OddRows::kOffer),
            "f.csv: 4 rows have another number of cells than the header's 4: "
            "line 10 has 5, lines 11 to 12 have 3, line 14 has 2; complete "
            "them or remove them, or leave them out with missing = drop-rows");
  EXPECT_THAT(RefusalOf(text, OddRows::kRefuse),
              ::testing::EndsWith("complete them or remove them"));
  const CsvTable table = ParseCsv(text, "f.csv", OddRows::kLeaveOut);
  EXPECT_EQ(table.num_rows, 9U);
  EXPECT_EQ(table.LineOfRow(8), 13U);
  EXPECT_EQ(table.columns[2].values[8], 9.0);
  EXPECT_EQ(table.columns[1].exceptions.size(), 0U);
  EXPECT_THAT(table.remarks, ElementsAre(HasSubstr("4 rows are left out")));
}

TEST(OddRows, AreNoneWhereAllRowsEndAlike) {
  const CsvTable longer = ParseCsv(kNames + "\n" + Rows(",,"), "f.csv");
  ExpectRows(longer);
  EXPECT_THAT(longer.columns, SizeIs(3));
  EXPECT_THAT(longer.remarks, IsEmpty());
  const CsvTable shorter = ParseCsv(kNames + ",remark\n" + Rows(), "f.csv");
  ExpectRows(shorter);
  EXPECT_TRUE(shorter.columns[3].is_text());
  EXPECT_THAT(shorter.remarks, ElementsAre(HasSubstr("'remark'")));
  // A column with a unit should have numbers.
  EXPECT_THAT(RefusalOf("day," + kNames + "\n" + Rows(), OddRows::kRefuse),
              HasSubstr("3 fields, in all rows, where the header has 4"));
}

TEST(OddRows, MayEndBeforeColumnsWithoutANameThatAreEmpty) {
  const std::string rows = Rows(",");
  ExpectRows(ParseCsv(kNames + ",\n" + rows.substr(0, rows.size() - 2) + "\n",
                      "f.csv"));
  EXPECT_THAT(
      RefusalOf(kNames + ",\n" + Rows(",x") + "1,2,3\n", OddRows::kRefuse),
      HasSubstr("3 fields where the header has 4"));
}

TEST(TableShape, RefusesAnotherTableBelow) {
  const std::string table = kNames + "\n" + Rows();
  EXPECT_THAT(RefusalOf(table + "\na,b\n1,2\n", OddRows::kLeaveOut),
              HasSubstr("f.csv: line 11: another table begins here"));
  EXPECT_THAT(RefusalOf(table + "a,b,c\n1,2,3\n", OddRows::kLeaveOut),
              HasSubstr("f.csv: line 10: another table begins here"));
}

TEST(TableShape, ReadsOnBelowTheSameNamesAndBlankLines) {
  const CsvTable table =
      ParseCsv(kNames + "\n1,2,3\n4,5,6\n\n" + kNames + "\n7,8,9\n", "f.csv");
  EXPECT_THAT(table.columns[0].values, ElementsAre(1.0, 4.0, 7.0));
  EXPECT_EQ(table.LineOfRow(2), 6U);
  EXPECT_THAT(table.remarks,
              ElementsAre(HasSubstr("blank lines between rows"),
                          HasSubstr("names are repeated between the rows")));
}

// ---- Lines that part the rows.

// A table of four rows below each of these lines.
std::string Blocks(const std::vector<std::string>& titles,
                   const std::string& names) {
  std::string text = names.empty() ? kNames + "\n" : "";
  for (const std::string& title : titles) {
    text += title + "\n" + names;
    for (int i = 0; i < 4; ++i) {
      text += std::to_string(50 * i) + ",20.5,-1.25\n";
    }
  }
  return text;
}

TEST(TableShape, MakesAColumnOfLinesThatPartTheRows) {
  struct Case {
    std::vector<std::string> titles;
    std::string names;
    std::string column;
    std::vector<std::string> cells;  // of each block
  };
  const std::string again = kNames + "\n";
  for (const Case& of : std::vector<Case>{
           {{"# day 1", "# day 2"}, "", "day", {"day 1", "day 2"}},
           {{"# day 1, 2024-07-14", "# day 2, 2024-07-16"},
            "",
            "date",
            {"2024-07-14", "2024-07-16"}},
           {{"Date: 2024-04-15", "Date: 2024-04-16"},
            again,
            "date",
            {"2024-04-15", "2024-04-16"}},
           {{"Day 1 Cycle 1", "Day 1 Cycle 2", "Day 2 Cycle 1"},
            again,
            "session",
            {"Day 1", "Day 1", "Day 2"}},
           {{"Tag 1,,", "Tag 2,,"}, again, "day", {"Tag 1", "Tag 2"}},
           {{"Date,06.07.2024", "Session 2"},
            "cycle," + kNames + ",n\n",
            "run",
            {"Date,06.07.2024", "Session 2"}},
       }) {
    std::string text = Blocks(of.titles, of.names);
    if (of.column == "run") {
      for (std::size_t at = 0; (at = text.find("20.5", at)) != text.npos;) {
        text.insert(at, "1,");
        text.insert(text.find('\n', at), ",4");
        at += 8;
      }
    }
    const CsvTable table = ParseCsv(text, "f.csv");
    const std::ptrdiff_t column = table.Find(of.column);
    ASSERT_GE(column, 0) << of.titles[0];
    ASSERT_EQ(table.num_rows, 4 * of.cells.size());
    for (std::size_t row = 0; row < table.num_rows; ++row) {
      EXPECT_EQ(table.CellText(table.At(column), row), of.cells[row / 4]);
    }
  }
  // What is not a session and no date, or comes once.
  for (const std::vector<std::string>& titles :
       std::vector<std::vector<std::string>>{
           {"# zero 1", "# zero 2"},
           {"# tool 100-20-300", "# tool 100-20-301"},
           {"# day 1", "# oil changed"},
           {"# day 1"}}) {
    EXPECT_THAT(ParseCsv(Blocks(titles, ""), "f.csv").columns, SizeIs(3));
  }
}

TEST(TableShape, PassesOverSignsOfPrograms) {
  const CsvTable framed = ParseCsv("%\n" + kNames + "\n" + Rows() + "%\n", "f");
  EXPECT_THAT(NamesIn(framed),
              ElementsAre("position_mm", "t1_degC", "error_um"));
  ExpectRows(framed);
  std::string text = Rows();
  std::ranges::replace(text, ',', ' ');
  ExpectRows(ParseCsv("% columns: position_mm t1_degC error_um\n" + text, "f"));
  text = Rows();
  std::ranges::replace(text, ',', ';');
  const CsvTable program =
      ParseCsv("%_N_X_MPF\n;position_mm;t1_degC;error_um\n" + text, "f");
  EXPECT_THAT(NamesIn(program),
              ElementsAre("position_mm", "t1_degC", "error_um"));
  ExpectRows(program);
}

TEST(TableShape, TurnsARowForEachVariable) {
  const CsvTable table = ParseCsv(
      "Time,08:00:00,08:00:05,08:00:10,08:00:15\nX [mm],0,50,100,150\n"
      "Error [um],1.5,2.5,3.5,4.5\nT1 [degC],20,21,22,23\n",
      "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("Time", "X [mm]", "Error [um]", "T1 [degC]"));
  EXPECT_EQ(table.CellText(table.columns[0], 3), "08:00:15");
  EXPECT_THAT(table.columns[2].values, ElementsAre(1.5, 2.5, 3.5, 4.5));
}

// As databases write them, with a number for each field.
TEST(TableShape, SpreadsARowForEachReading) {
  std::string text = "table,_time,_value,_field\n";
  const char* const fields[] = {"x_mm", "t1_degC", "error_um"};
  for (int field = 0; field < 3; ++field) {
    for (int i = 0; i < 12; ++i) {
      text += std::to_string(field) +
              ",2024-03-04T08:00:" + std::to_string(10 + i) + "Z," +
              std::to_string(100 * field + i) + "," + fields[field] + "\n";
    }
  }
  const CsvTable table = ParseCsv(text, "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("_time", "x_mm", "t1_degC", "error_um"));
  EXPECT_EQ(table.num_rows, 12U);
  EXPECT_EQ(table.columns[3].values[5], 205.0);
}

TEST(TableShape, TakesAStateForNoUnit) {
  std::string text = "Millitm,TagName,Value,Status\n";
  for (int i = 0; i < 24; ++i) {
    text += std::to_string(i / 2) + (i % 2 == 0 ? ",X_Pos," : ",X_Err,") +
            std::to_string(i) + ".5,U\n";
  }
  EXPECT_THAT(NamesIn(ParseCsv(text, "f.csv")),
              ElementsAre("Millitm", "Status", "X_Pos", "X_Err"));
}

// Names two blanks apart, and rows whose columns stand closer.
TEST(TableShape, KeepsColumnsOneBlankApart) {
  const CsvTable table = ParseCsv(
      "# JD  LST  Alt(deg)  error(arcsec)\n"
      "2460374.5 13:35:27  20.00  -1.26\n"
      "2460375.5 13:36:27  25.00   0.74\n"
      "2460376.5 13:37:27  30.00   1.74\n",
      "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("JD", "LST", "Alt(deg)", "error(arcsec)"));
  EXPECT_THAT(table.columns[3].values, ElementsAre(-1.26, 0.74, 1.74));
}

TEST(TableShape, TurnsTheSheetOfAStandard) {
  const CsvTable table = ParseCsv(
      "Deviations in um\ni,1,2,3,4,5\nPosition Pi (mm),0,50,100,150,200\n"
      "j=1 up,1.5,2.5,3.5,4.5,5.5\nj=1 down,-1,-2,-3,-4,-5\n"
      "j=2 up,1.6,2.6,3.6,4.6,5.6\nj=2 down,-1.1,-2.1,-3.1,-4.1,-5.1\n",
      "f.csv");
  ASSERT_GE(table.Find("error [um]"), 0);
  const CsvColumn& error = table.At(table.Find("error [um]"));
  EXPECT_EQ(table.num_rows, 20U);
  EXPECT_EQ(error.values[4], 5.5);
  EXPECT_EQ(error.values[5], -5.0);  // down begins where up ended
  EXPECT_EQ(table.At(table.Find("Position Pi (mm)")).values[5], 200.0);
}

TEST(TableShape, NumbersBlocksBetweenBlankLinesOrEmptyRows) {
  const auto text_with = [](const std::string& between) {
    std::string text = "x_mm,t_degC,error_um\n";
    for (int i = 0; i < 12; ++i) {
      if (i == 4 || i == 8) text += between;
      text +=
          std::to_string(50 * (i % 4)) + ",20.5," + std::to_string(i) + ".5\n";
      if (i % 2 == 1 && i % 4 != 3 && between == "\n\n") text += "\n";
    }
    return text;
  };
  for (const std::string between : {"\n", ",,\n", "\n\n"}) {
    const CsvTable table = ParseCsv(text_with(between), "f.csv");
    ASSERT_EQ(table.num_rows, 12U);
    EXPECT_THAT(table.At(table.Find("block")).values,
                ElementsAre(1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3));
  }
  std::string one = text_with("");
  one.insert(one.find("0,20.5,4.5"), "\n");
  EXPECT_LT(ParseCsv(one, "f.csv").Find("block"), 0);
}

// With the separators of a sheet behind them.
TEST(TableShape, TakesDatesAmongTheRowsForDays) {
  const CsvTable table = ParseCsv(
      "Cycle,X [mm],Error [um]\n04.03.2024,,\n1,0,2.5\n1,50,3.5\n"
      "05.03.2024,,\n1,0,2.6\n1,50,3.6\n",
      "f.csv");
  EXPECT_EQ(table.num_rows, 4U);
  EXPECT_EQ(table.CellText(table.At(table.Find("date")), 3), "05.03.2024");
}

TEST(ParseCsv, RefusesMoreColumnsThanMemoryShouldBeKeptFor) {
  std::string names = "a";
  std::string row = "1";
  for (int i = 0; i < 100000; ++i) {
    names += ",n" + std::to_string(i);
    row += ",1";
  }
  EXPECT_THAT(RefusalOf(names + "\n" + row + "\n", OddRows::kRefuse),
              HasSubstr("f.csv: line 1: more than 65536 columns"));
}

}  // namespace
}  // namespace errmap::data
