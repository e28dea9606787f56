// Where the names and units of columns may stand, and what they become.

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "tests/data/tables/small_tables.h"

namespace errmap::data {
namespace {

using namespace small_tables;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(TableNames, FindsNamesBelowTitlesWhateverTheRowsEndWith) {
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
TEST(TableNames, FindsNamesBelowLinesOfTwoCells) {
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

TEST(TableNames, FindsNamesInCommentsAndBehindDollars) {
  for (const std::string& head : {"# a test stand\n# " + kNames + "\n",
                                  "##Instrument A\n##\n##" + kNames + "\n",
                                  "// Logger 2\n// " + kNames + "\n",
                                  "$$file[3]\n$$" + kNames + "\n",
                                  "#" + kNames + "\n# units: mm\n"}) {
    const CsvTable table = ParseCsv(head + Rows(), "f.csv");
    EXPECT_THAT(NamesIn(table),
                ElementsAre("position_mm", "t1_degC", "error_um"));
    ExpectRows(table);
    EXPECT_THAT(table.remarks, SizeIs(1));
  }
}

TEST(TableNames, FindsNamesAboveTheRulesOfMarkdown) {
  const CsvTable table = ParseCsv(
      "| Place | x_mm | error_um |\n|:------|-----:|---------:|\n"
      "| a     |  0.5 |      1.5 |\n| b     |  1.0 |     -2.5 |\n",
      "f.md");
  EXPECT_THAT(NamesIn(table), Contains("x_mm"));
  EXPECT_THAT(table.At(table.Find("error_um")).values, ElementsAre(1.5, -2.5));
  EXPECT_THAT(table.remarks, IsEmpty());
}

TEST(TableNames, FindsNamesBelowYearsOfGroups) {
  const CsvTable table = ParseCsv(
      "Households,,,,\n,2010,,2020,Change\nCounty,Owner,Renter,Owner,\n"
      ",(number),(number),(number),(percent)\nA,4291,6103,374,4.2\n"
      "B,9085,1097,5699,5.8\nC,5105,3856,5677,1.2\n",
      "f.csv");
  EXPECT_THAT(table.columns[1].values, ElementsAre(4291, 9085, 5105));
  EXPECT_THAT(table.titles, Contains(HasSubstr("2010")));
}

TEST(TableNames, AreNotALineOfADate) {
  const CsvTable table = ParseCsv(
      "Machine,HMC,,\nDate,2024-04-18,,\n" + kNames + ",n\n" + Rows(",1"),
      "f.csv");
  ExpectRows(table);
  EXPECT_THAT(table.remarks, ElementsAre(HasSubstr("2 lines above the table")));
}

// As numpy.savetxt writes it: "# x y", blanks between the numbers.
TEST(TableNames, FindsNamesInACommentWhereBlanksPartTheColumns) {
  std::string text = Rows();
  std::ranges::replace(text, ',', ' ');
  const CsvTable table =
      ParseCsv("# position_mm t1_degC error_um\n" + text, "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("position_mm", "t1_degC", "error_um"));
  ExpectRows(table);
}

TEST(TableNames, NamesColumnsByNumberWhereThereAreNoNames) {
  const CsvTable table = ParseCsv(Rows(), "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("column_1", "column_2", "column_3"));
  ExpectRows(table);
  EXPECT_EQ(table.LineOfRow(0), 1U);
  EXPECT_THAT(table.remarks,
              ElementsAre("f.csv: no line of names: the columns are called "
                          "column_1 to column_3"));
  // A row whose first reading is not a number is not a header.
  EXPECT_EQ(ParseCsv("1,OPEN\n2,3\n4,5\n", "f.csv").num_rows, 3U);
}

TEST(TableNames, TellsColumnsOfOneNameApart) {
  const CsvTable table = ParseCsv("x,x,x_2\n" + Rows(), "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("x", "x_3", "x_2"));
  EXPECT_THAT(table.remarks, ElementsAre(HasSubstr("'x_3'")));
}

TEST(TableNames, TakesTheLowerOfTwoRowsOfNames) {
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

TEST(TableNames, FindsNamesAboveUnitsAndAnotherRow) {
  const CsvTable table = ParseCsv(
      "position,t1,error\nmm,degC,um\nSmp,Avg,Smp\n" + Rows(), "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("position [mm]", "t1 [degC]", "error [um]"));
  ExpectRows(table);
}

TEST(TableNames, FindsNamesAndUnitsAboveChannels) {
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

TEST(TableNames, TakesALetterForANameWhereTheUnitBelowIsAnother) {
  EXPECT_THAT(NamesIn(ParseCsv("Temp_A,Temp_B,error\ndegC,degC,um\n" + Rows(),
                               "f.csv")),
              ElementsAre("Temp_A [degC]", "Temp_B [degC]", "error [um]"));
}

TEST(TableNames, FindsNamesBetweenBlanksAboveALineOfDashes) {
  std::string text = Rows();
  std::ranges::replace(text, ',', ' ');
  const CsvTable table =
      ParseCsv("position  t1  error\n--------------------\n" + text, "f.txt");
  EXPECT_THAT(NamesIn(table), ElementsAre("position", "t1", "error"));
  ExpectRows(table);
}

TEST(TableNames, FindsNamesBetweenBlanksBelowABlockOfWords) {
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

TEST(TableNames, TakesLabelsOfCellsForNames) {
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

TEST(TableNames, TakesNamesOfAnIndexBelowTheOthers) {
  const CsvTable table = ParseCsv(
      ",,x_mm,error_um\nday,cycle,,\n1,1,0,2.5\n1,1,50,3.5\n", "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("day", "cycle", "x_mm", "error_um"));
  EXPECT_EQ(table.num_rows, 2U);
}

TEST(TableNames, TakesTheUnitOfALineAbove) {
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

TEST(TableNames, TakesTheUnitsOfPositionsAndTemperaturesToo) {
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

}  // namespace
}  // namespace errmap::data
