// How tables stand in files of laboratories, and what is read of each.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"

namespace errmap::data {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<std::string> NamesIn(const CsvTable& table) {
  std::vector<std::string> names;
  for (const CsvColumn& column : table.columns) names.push_back(column.name);
  return names;
}

std::string RefusalOf(const std::string& text, OddRows odd) {
  try {
    ParseCsv(text, "f.csv", odd);
  } catch (const InputError& error) {
    return error.what();
  }
  return "read";
}

// Eight rows of three readings, a cell more at the end of each.
std::string Rows(const std::string& end = "") {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    text += std::to_string(20 * i - 200) + ",20." + std::to_string(i) + ",-" +
            std::to_string(i) + ".95" + end + "\n";
  }
  return text;
}

void ExpectRows(const CsvTable& table) {
  ASSERT_EQ(table.num_rows, 8U);
  ASSERT_GE(table.columns.size(), 3U);
  for (int i = 0; i < 8; ++i) {
    const auto row = static_cast<std::size_t>(i);
    EXPECT_EQ(table.columns[0].values[row], 20 * i - 200);
    EXPECT_DOUBLE_EQ(table.columns[1].values[row], 20 + 0.1 * i);
    EXPECT_DOUBLE_EQ(table.columns[2].values[row], -(i + 0.95));
  }
}

const std::string kNames = "position_mm,t1_degC,error_um";

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

TEST(TableShape, FindsNamesBelowTitlesWhateverTheRowsEndWith) {
  std::string titles = "Linear test of slide X\nDate: 04.03.2024\n\n";
  for (int i = 0; i < 2; ++i) {
    const CsvTable table =
        ParseCsv(titles + kNames + "\n" + Rows(","), "f.csv");
    EXPECT_THAT(NamesIn(table),
                ElementsAre("position_mm", "t1_degC", "error_um"));
    ExpectRows(table);
    EXPECT_EQ(
        NamesIn(ParseCsv(titles + kNames + ",remark\n" + Rows(), "f.csv")),
        (std::vector<std::string>{
            "position_mm", "t1_degC", "error_um", "remark"}));
    // More lines above than rows below.
    for (int k = 0; k < 12; ++k) titles += "of the header block\n";
  }
}

// Lines of a name and a number above rows that begin with a date.
TEST(TableShape, FindsNamesBelowLinesOfTwoCells) {
  std::string text =
      "Machine,Lathe 3\nTargets,17\nRuns,10\n\nDate/Time," + kNames + "\n";
  for (int i = 0; i < 8; ++i) {
    text += "2024-03-04 08:00:0" + std::to_string(i) + "," +
            std::to_string(20 * i) + ",20.5,-1.5\n";
  }
  const CsvTable table = ParseCsv(text, "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("Date/Time", "position_mm", "t1_degC", "error_um"));
  EXPECT_EQ(table.num_rows, 8U);
  EXPECT_THAT(table.titles, SizeIs(3));
}

TEST(TableShape, FindsNamesInCommentsAndBehindDollars) {
  for (const std::string& head : {"# a test stand\n# " + kNames + "\n",
                                  "##Instrument A\n##\n##" + kNames + "\n",
                                  "$$file[3]\n$$" + kNames + "\n",
                                  "#" + kNames + "\n# units: mm\n"}) {
    const CsvTable table = ParseCsv(head + Rows(), "f.csv");
    EXPECT_THAT(NamesIn(table),
                ElementsAre("position_mm", "t1_degC", "error_um"));
    ExpectRows(table);
    EXPECT_THAT(table.remarks, SizeIs(1));
  }
}

// As numpy.savetxt writes it: "# x y", blanks between the numbers.
TEST(TableShape, FindsNamesInACommentWhereBlanksPartTheColumns) {
  std::string text = Rows();
  std::ranges::replace(text, ',', ' ');
  const CsvTable table =
      ParseCsv("# position_mm t1_degC error_um\n" + text, "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("position_mm", "t1_degC", "error_um"));
  ExpectRows(table);
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

TEST(TableShape, NamesColumnsByNumberWhereThereAreNoNames) {
  const CsvTable table = ParseCsv(Rows(), "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("column_1", "column_2", "column_3"));
  ExpectRows(table);
  EXPECT_EQ(table.LineOfRow(0), 1U);
  EXPECT_THAT(table.remarks,
              ElementsAre("f.csv: no line of names: the columns are called "
                          "column_1 to column_3"));
  // A row whose first reading is not a number is no header.
  EXPECT_EQ(ParseCsv("1,OPEN\n2,3\n4,5\n", "f.csv").num_rows, 3U);
}

TEST(TableShape, TellsColumnsOfOneNameApart) {
  const CsvTable table = ParseCsv("x,x,x_2\n" + Rows(), "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("x", "x_3", "x_2"));
  EXPECT_THAT(table.remarks, ElementsAre(HasSubstr("'x_3'")));
}

TEST(TableShape, TakesTheLowerOfTwoRowsOfNames) {
  const CsvTable table =
      ParseCsv("slide,,spindle\n" + kNames + "\n" + Rows(), "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("position_mm", "t1_degC", "error_um"));
  ExpectRows(table);
  EXPECT_THAT(table.remarks, ElementsAre(HasSubstr("second row of names")));
  EXPECT_THAT(NamesIn(ParseCsv("x,bed,spindle\n,t,t\n" + Rows(), "f.csv")),
              ElementsAre("x", "bed t", "spindle t"));
  // Units below names are none.
  EXPECT_THAT(NamesIn(ParseCsv("x,t,e\nmm,degC,um\n" + Rows(), "f.csv")),
              ElementsAre("x [mm]", "t [degC]", "e [um]"));
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
                          HasSubstr("names stand between the rows again")));
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
  // What is no session and no date, or comes once.
  for (const std::vector<std::string>& titles :
       std::vector<std::vector<std::string>>{{"# zero 1", "# zero 2"},
                                             {"# day 1", "# oil changed"},
                                             {"# day 1"}}) {
    EXPECT_THAT(ParseCsv(Blocks(titles, ""), "f.csv").columns, SizeIs(3));
  }
}

// ---- Names in other places.

TEST(TableShape, FindsNamesAboveUnitsAndAnotherRow) {
  const CsvTable table = ParseCsv(
      "position,t1,error\nmm,degC,um\nSmp,Avg,Smp\n" + Rows(), "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("position [mm]", "t1 [degC]", "error [um]"));
  ExpectRows(table);
}

TEST(TableShape, FindsNamesAndUnitsAboveChannels) {
  const CsvTable table = ParseCsv(
      "Meas Ch,0001,0002\nTag,X pos,bed,X error\nUnit,mm,C,um\n"
      "Time,CH1,CH2,CH3\n08:00:01,0,20.5,1.5\n08:00:02,50,20.6,2.5\n"
      "08:00:03,100,20.7,3.5\n",
      "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("Time", "X pos [mm]", "bed [C]", "X error [um]"));
  EXPECT_THAT(NamesIn(ParseCsv("CH1,position,DC\nCH2,bed,TC\nCH3,error,DC\n"
                               "CH1,CH2,CH3\nmm,degC,um\n" +
                                   Rows(),
                               "f.csv")),
              ElementsAre("position [mm]", "bed [degC]", "error [um]"));
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

TEST(TableShape, FindsNamesBetweenBlanksBelowABlockOfWords) {
  std::string text = Rows();
  std::ranges::replace(text, ',', ' ');
  const CsvTable table =
      ParseCsv("Laser 5 linear measurement\nMachine: Lathe 2  Axis: Z\n\n" +
                   std::string("position(mm)  t1(C)  error(um)\n"
                               "------------------------\n") +
                   text,
               "f.txt");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("position(mm)", "t1(C)", "error(um)"));
  ExpectRows(table);
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

TEST(TableShape, TakesLabelsOfCellsForNames) {
  const CsvTable table = ParseCsv(
      "2024/05/13,X50.000,DEV-2.91UM,T1=21.42\n"
      "2024/05/13,X90.000,DEV-1.17UM,T1=21.52\n"
      "2024/05/14,X50.000,DEV0.19UM,T1=21.54\n",
      "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("column_1", "X", "DEV [UM]", "T1"));
  EXPECT_THAT(table.columns[1].values, ElementsAre(50, 90, 50));
  EXPECT_THAT(table.columns[2].values, ElementsAre(-2.91, -1.17, 0.19));
  EXPECT_THAT(table.columns[3].values, ElementsAre(21.42, 21.52, 21.54));
  for (const char* name : {"run-1", "D1C1", "X1"}) {
    const std::string cell = std::string(name) + ",1\n";
    EXPECT_TRUE(
        ParseCsv("id,error_um\n" + cell + cell, "f.csv").columns[0].is_text())
        << name;
  }
}

TEST(TableShape, TakesNamesOfAnIndexBelowTheOthers) {
  const CsvTable table = ParseCsv(
      ",,x_mm,error_um\nday,cycle,,\n1,1,0,2.5\n1,1,50,3.5\n", "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("day", "cycle", "x_mm", "error_um"));
  EXPECT_EQ(table.num_rows, 2U);
}

TEST(TableShape, TakesTheUnitOfALineAbove) {
  for (const std::string note : {"Units: um\n",
                                 "# Alle Ma\u00dfe in \u00b5m\n",
                                 "All deviations in micrometres\n"}) {
    const CsvTable table =
        ParseCsv(note + "X,T1,Deviation\n" + Rows(), "f.csv");
    EXPECT_THAT(table.columns[2].name, ::testing::StartsWith("Deviation ["))
        << note;
    EXPECT_EQ(table.columns[0].name, "X");
  }
  EXPECT_EQ(ParseCsv("Stroke: 500 mm\nX,T1,Deviation\n" + Rows(), "f.csv")
                .Find("Deviation"),
            2);
}

TEST(TableShape, TakesTheUnitsOfPositionsAndTemperaturesToo) {
  const auto names_under = [](const std::string& note) {
    return NamesIn(ParseCsv(note + "\nPosition,T1,Error\n" + Rows(), "f.csv"));
  };
  EXPECT_THAT(names_under("# position in m"),
              ElementsAre("Position [m]", "T1", "Error"));
  EXPECT_THAT(names_under("# temperatures in degrees Fahrenheit"),
              ElementsAre("Position", "T1 [degF]", "Error"));
  EXPECT_THAT(names_under("Units: inch, deg F"),
              ElementsAre("Position [in]", "T1 [degF]", "Error [in]"));
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

// ---- Numbers.

TEST(TableShape, ReadsOneColumnOfDecimalCommas) {
  const CsvTable table =
      ParseCsv("residual_um\n1,25\n0,40\n-0,75\n2\n", "f.csv");
  ASSERT_THAT(table.columns, SizeIs(1));
  EXPECT_THAT(table.columns[0].values, ElementsAre(1.25, 0.4, -0.75, 2.0));
}

TEST(ThousandsPoint, IsReadWhereTheOthersAreWholeNumbersOfThreeDigits) {
  for (const char mark : {'.', ','}) {
    const std::string text = std::string("x;e\n0;1\n450;2\n-900;3\n1") + mark +
                             "050;4\n12" + mark + "600;5\n";
    const CsvTable table = ParseCsv(text, "f.csv");
    EXPECT_THAT(table.columns[0].values,
                ElementsAre(0.0, 450.0, -900.0, 1050.0, 12600.0));
    EXPECT_EQ(table.columns[0].first_decimal_point, -1);
    EXPECT_EQ(table.columns[0].first_decimal_comma, -1);
    EXPECT_THAT(table.remarks,
                ElementsAre(AllOf(HasSubstr("1050"), HasSubstr("line 5"))));
  }
}

TEST(ThousandsPoint, IsAskedAboutWhereItIsUnclear) {
  const CsvTable table = ParseCsv("x;e\n0;1\n50;2\n1.050;3\n", "f.csv");
  EXPECT_DOUBLE_EQ(table.columns[0].values[2], 1.05);
  EXPECT_THAT(table.remarks, ElementsAre(HasSubstr("write 1050")));
}

TEST(ThousandsPoint, IsNoneWhereDecimalsDiffer) {
  for (const std::string cells : {"-215.900;1\n-203.200;2\n",
                                  "1500;1\n1.050;2\n150;3\n0.5;4\n",
                                  "150;1\n0.125;2\n",
                                  "1.125;1\n1.5;2\n200;3\n"}) {
    const CsvTable table = ParseCsv("x;e\n" + cells, "f.csv");
    EXPECT_THAT(table.remarks, IsEmpty()) << cells;
  }
}

TEST(CutLine, IsLeftOutAndNamed) {
  const std::string whole = kNames + "\n" + Rows();
  const CsvTable table = ParseCsv(whole + "-40,20.8,-9.", "f.csv");
  ExpectRows(table);
  EXPECT_THAT(table.remarks, ElementsAre(HasSubstr("'-9.'")));
  // With a line end, or as many decimals, it is whole.
  EXPECT_EQ(ParseCsv(whole + "-40,20.8,-9\n", "f.csv").num_rows, 9U);
  EXPECT_EQ(ParseCsv(whole + "-40,20.8,-9.25", "f.csv").num_rows, 9U);
  EXPECT_EQ(ParseCsv("a,b\n1,2.5\n3,4", "f.csv").num_rows, 2U);
}

// ---- A column for each position.

TEST(FoldedPositions, BecomeARowForEachReading) {
  const CsvTable table = ParseCsv(
      "day,e@-215.9mm_um,e@-203.2mm_um,e@+10mm_um,t_degC\n"
      "1,2.5,NA,4,20\n2,5,6,7,21\n",
      "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("day", "t_degC", "position_mm", "error_um"));
  EXPECT_THAT(table.columns[0].values, ElementsAre(1, 1, 1, 2, 2, 2));
  EXPECT_THAT(table.columns[2].values,
              ElementsAre(-215.9, -203.2, 10, -215.9, -203.2, 10));
  EXPECT_THAT(table.columns[3].exceptions, ElementsAre(::testing::Pair(1, 0)));
  EXPECT_EQ(table.columns[3].values[5], 7.0);
  EXPECT_EQ(table.Where(4, "error_um"),
            "f.csv: line 3 (data row 4), column 'error_um'");
  EXPECT_THAT(table.remarks,
              ElementsAre(HasSubstr("2 rows with a column for each of 3 "
                                    "positions (-215.9 to 10 mm) are read as 6 "
                                    "rows, of 'error_um'")));
}

TEST(FoldedPositions, AreSeveralQuantitiesOrNoneByTheirPositions) {
  EXPECT_THAT(
      NamesIn(ParseCsv("ex@1 mm [um],ex@2 mm [um],ex@3 mm [um],ey@1 mm [um],"
                       "ey@2 mm [um],ey@3 mm [um]\n1,2,3,4,5,6\n",
                       "f.csv")),
      ElementsAre("position_mm", "ex [um]", "ey [um]"));
  EXPECT_THAT(ParseCsv("a@1,a@2,b@1\n1,2,3\n", "f.csv").columns, SizeIs(3));
  EXPECT_THAT(ParseCsv("t01_degC,t02_degC,t03_degC\n1,2,3\n", "f").columns,
              SizeIs(3));
}

TEST(FoldedPositions, MayStandInParenthesesOrBehindAnAxis) {
  for (const std::string names : {"err_um(0),err_um(50),err_um(100)",
                                  "X0 [um],X50 [um],X100 [um]",
                                  "X=0 (um),X=50 (um),X=100 (um)"}) {
    const CsvTable table = ParseCsv("T1," + names + "\n20,1,2,3\n", "f.csv");
    EXPECT_THAT(table.At(table.Find("position_mm")).values,
                ElementsAre(0, 50, 100));
    EXPECT_THAT(table.columns[2].values, ElementsAre(1, 2, 3));
  }
}

TEST(FoldedPositions, AreThoseOfErrors) {
  EXPECT_THAT(
      ParseCsv("X [mm],Error [um],T@100mm [degC],T@200mm [degC],T@300mm "
               "[degC]\n1,2,20,21,22\n",
               "f.csv")
          .columns,
      SizeIs(5));
}

TEST(FoldedPositions, GoBlockByBlockInRunsAndWays) {
  const CsvTable table = ParseCsv(
      "cycle,X [mm],Error up [um],Error down [um]\n1,0,1,6\n1,50,2,5\n"
      "1,100,3,4\n2,0,7,12\n2,50,8,11\n2,100,9,10\n",
      "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("cycle", "X [mm]", "direction", "error [um]"));
  EXPECT_THAT(table.columns[3].values,
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
  EXPECT_EQ(table.CellText(table.columns[2], 3), "down");
}

// One after the other, in whatever order their columns stand.
TEST(FoldedPositions, GoRunByRunInBothWays) {
  for (const std::string names :
       {"Lauf 1 hin,Lauf 2 hin,Lauf 1 her,Lauf 2 her",
        "x1\u2191 [um],x2\u2191 [um],x1\u2193 [um],x2\u2193 [um]",
        "1+ (um),2+ (um),1- (um),2- (um)",
        "Test 1 Fwd,Test 2 Fwd,Test 1 Bwd,Test 2 Bwd",
        "Series 1 up,Series 2 up,Series 1 down,Series 2 down"}) {
    const CsvTable table =
        ParseCsv("X [mm]," + names + "\n0,1,5,4,8\n50,2,6,3,7\n", "f.csv");
    EXPECT_THAT(table.At(table.Find("cycle")).values,
                ElementsAre(1, 1, 1, 1, 2, 2, 2, 2))
        << names;
    EXPECT_THAT(table.columns.back().values,
                ElementsAre(1, 2, 3, 4, 5, 6, 7, 8))
        << names;
  }
}

TEST(FoldedPositions, MayBeOfSessionsAndTheirRuns) {
  const CsvTable table = ParseCsv(
      "X [mm],Day 1 Run 1 [um],Day 1 Run 2 [um],Day 2 Run 1 [um],"
      "Day 2 Run 2 [um]\n0,1,2,3,4\n50,5,6,7,8\n",
      "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("X [mm]", "session", "cycle", "error [um]"));
  EXPECT_THAT(table.columns[1].values, ElementsAre(1, 1, 1, 1, 2, 2, 2, 2));
  EXPECT_THAT(table.columns[2].values, ElementsAre(1, 1, 2, 2, 1, 1, 2, 2));
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
