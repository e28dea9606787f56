#include "data/tables/shapes/folded_positions.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"
#include "tests/data/tables/small_tables.h"

namespace errmap::data {
namespace {

using small_tables::NamesIn;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::vector<std::string> ColumnsOf(const std::string& text) {
  return NamesIn(ParseCsv(text, "f.csv"));
}

Reading ReadingOfSheet(const std::string& text) {
  return MakeDataset(ParseCsv(text, "f.csv"), {}).reading;
}

// Three runs each way over six targets, listed in either order.
std::string SheetOfRuns(bool descending,
                        const std::string& up = " up",
                        const std::string& down = " down") {
  std::string text = "x [mm]";
  for (int run = 1; run <= 3; ++run) {
    for (const std::string& way : {up, down}) {
      text += ",Pass " + std::to_string(run) + way + " [um]";
    }
  }
  for (int i = 0; i < 6; ++i) {
    const int at = descending ? 5 - i : i;
    text += "\n" + std::to_string(100 * at);
    for (int column = 0; column < 6; ++column) {
      const double error =
          2.0 * at + (column % 2 == 0 ? 3.0 : -3.0) + 0.1 * (column / 2);
      text += "," + CsvNumber(error + 0.01 * ((7 * i + column) % 5));
    }
  }
  return text + "\n";
}

TEST(FoldedRuns, GoTheirWayWhateverTheOrderOfTheTargets) {
  for (const bool descending : {false, true}) {
    const CsvTable table = ParseCsv(SheetOfRuns(descending), "f.csv");
    const CsvColumn& x = table.At(table.Find("x [mm]"));
    EXPECT_LT(x.values[0], x.values[5]) << descending;  // the first goes up
    EXPECT_GT(x.values[6], x.values[11]) << descending;
    const Reading reading = ReadingOfSheet(SheetOfRuns(descending));
    EXPECT_THAT(reading.direction.labels, ElementsAre("up", "down"));
    EXPECT_TRUE(reading.direction.sure);
    EXPECT_EQ(reading.cycles.count, 3);
  }
}

TEST(FoldedPositions, HaveTheTemperaturesOfTheRowsBelow) {
  const std::string heads = "Run,0 mm,50 mm,125 mm\n";
  const CsvTable each = ParseCsv(
      heads + "1,1,2,3\nT1,20.1,20.2,20.3\n2,4,5,6\nT1,21.1,21.2,21.3\n",
      "f.csv");
  EXPECT_THAT(NamesIn(each), ElementsAre("Run", "position_mm", "T1", "error"));
  EXPECT_THAT(each.columns[0].values, ElementsAre(1, 1, 1, 2, 2, 2));
  EXPECT_THAT(each.columns[2].values,
              ElementsAre(20.1, 20.2, 20.3, 21.1, 21.2, 21.3));
  EXPECT_THAT(each.columns[3].values, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(each.remarks,
              ElementsAre(HasSubstr("2 rows with a column for each of 3 "
                                    "positions (0 to 125 mm) are read as 6 "
                                    "rows, of 'T1', 'error'")));
  const CsvTable once = ParseCsv(
      heads + "1,1,2,3\n2,4,5,6\nAir [degC],20.1,20.2,20.3\n", "f.csv");
  EXPECT_THAT(once.At(once.Find("Air [degC]")).values,
              ElementsAre(20.1, 20.2, 20.3, 20.1, 20.2, 20.3));
  const CsvTable above = ParseCsv(
      "x [mm],Run 1 [um],Run 2 [um],Run 3 [um]\nT1 [degC],20,21,22\n"
      "0,1,2,3\n50,4,5,6\n",
      "f.csv");
  EXPECT_THAT(above.At(above.Find("T1 [degC]")).values,
              ElementsAre(20, 20, 21, 21, 22, 22));
}

TEST(FoldedRuns, OrderOfOursDoesNotOverruleTheWords) {
  // Targets in no order: of each run as many steps go up as down.
  const CsvTable table = ParseCsv(
      "t_degC,x [mm],Run 1 up [um],Run 1 down [um],Run 2 up [um],Run 2 down "
      "[um]\n20,300,1,2,3,4\n21,100,5,6,7,8\n22,500,1,2,4,3\n23,0,7,6,5,4\n",
      "f.csv");
  EXPECT_THAT(MakeDataset(table, {}).reading.direction.labels,
              ElementsAre("up", "down"));
}

TEST(FoldedRuns, HaveTheirWayFromASignBehindTheNumber) {
  EXPECT_THAT(ColumnsOf(SheetOfRuns(false, " +", " -")),
              ElementsAre("x [mm]", "cycle", "direction", "error [um]"));
  // The dash before a bare unit parts name and unit.
  EXPECT_THAT(
      ColumnsOf("x [mm],Run 1-um,Run 2-um,Run 3-um\n1,2,3,4\n2,3,4,5\n"),
      ElementsAre("x [mm]", "cycle", "error [um]"));
}

TEST(FoldedRuns, AreCyclesOfOneSessionHoweverMany) {
  for (int runs = 2; runs <= 4; ++runs) {
    std::string text = "x [mm]";
    for (int run = 1; run <= runs; ++run) {
      for (const char* way : {"up", "down"}) {
        text += ",Run " + std::to_string(run) + " " + way + " [um]";
      }
    }
    for (int i = 0; i < 20; ++i) {
      text += "\n" + std::to_string(50 * i);
      for (int column = 0; column < 2 * runs; ++column) {
        text += "," + CsvNumber(0.5 * i + (column % 2 == 0 ? 2.0 : -2.0) +
                                0.01 * ((7 * i + 3 * column) % 11));
      }
    }
    const Reading reading = ReadingOfSheet(text + "\n");
    EXPECT_EQ(reading.sessions.count, 1) << runs;
    EXPECT_EQ(reading.cycles.count, runs);
    EXPECT_EQ(reading.cycles.column, "cycle");
  }
}

TEST(FoldedRuns, OfDaysHaveAllRowsOfADayTogether) {
  for (const std::string names : {"Day 1 (um),Day 2 (um),Day 3 (um)",
                                  "2.3.26 [um],3.3.26 [um],4.3.26 [um]"}) {
    std::string text = "x [mm],Run," + names + "\n";
    for (int row = 0; row < 12; ++row) {
      text +=
          std::to_string(100 * (row % 6)) + "," + std::to_string(row / 6 + 1);
      for (int day = 0; day < 3; ++day) {
        text += "," + CsvNumber(0.3 * (row % 6) + day + 0.01 * (row % 5));
      }
      text += "\n";
    }
    const Reading reading = ReadingOfSheet(text);
    EXPECT_EQ(reading.sessions.count, 3) << names;
    EXPECT_EQ(reading.cycles.count, 6) << names;
  }
}

TEST(FoldedPositions, AreNoneOfColumnsThatAreNumbered) {
  for (const char* names : {"A1 deg,A2 deg,A3 deg",
                            "fan 1,fan 2,fan 3",
                            "1.2.3,1.2.4,1.2.5",
                            "U1 in,U2 in,U3 in",
                            "X1 mm,X2 mm,X3 mm",
                            "Run 1 [mm],Run 2 [mm],Run 3 [mm]"}) {
    const std::string text =
        "x [mm]," + std::string(names) + ",error [um]\n1,2,3,4,5\n2,3,4,5,6\n";
    EXPECT_EQ(ColumnsOf(text).size(), 5U) << names;
  }
  EXPECT_EQ(ColumnsOf("A1 deg,A2 deg,A3 deg\n1,2,3\n2,3,4\n").size(), 3U);
}

TEST(FoldedPositions, NeedAMarkWhereAnotherColumnSaysError) {
  EXPECT_EQ(ColumnsOf("x 1 mm,x 2 mm,x 3 mm,error [um]\n1,2,3,4\n").size(), 4U);
  EXPECT_THAT(ColumnsOf("x 1 mm,x 2 mm,x 3 mm\n1,2,3\n"),
              ElementsAre("position_mm", "error"));
  EXPECT_EQ(ColumnsOf("x=1 mm,x=2 mm,x=3 mm,error [um]\n1,2,3,4\n").size(), 3U);
}

// A row of readings at 0, 50 and 120 below three names.
CsvTable Sheet(const std::string& names) {
  return ParseCsv("t1_degC;" + names + "\n20.5;1;2;3\n21;2;3;4\n", "f.csv");
}

TEST(FoldedPositions, AreNamedInManyWays) {
  const struct {
    const char* names;
    const char* error;
    std::vector<double> positions = {0.0, 50.0, 120.0};
  } kCases[] = {
      {"Error at 0 mm (um);Error at 50 mm (um);Error at 120 mm (um)",
       "Error (um)"},
      {"err_um@x=0;err_um@x=50;err_um@x=120", "err_um"},
      {"e_0mm_um;e_50mm_um;e_120mm_um", "error_um"},
      {"err_0;err_50;err_120", "error"},
      {"err_0_um;err_50_um;err_120_um", "error_um"},
      {"err_um_0;err_um_50;err_um_120", "err_um"},
      {"Abweichung bei 0 mm [um];Abweichung bei 50 mm [um];Abweichung bei 120 "
       "mm [um]",
       "Abweichung [um]"},
      {"0;50;120", "error"},
      {"-12,5;50;120", "error", {-12.5, 50.0, 120.0}},
      {"120;50;0", "error", {120.0, 50.0, 0.0}},
  };
  for (const auto& [names, error, positions] : kCases) {
    const CsvTable table = Sheet(names);
    ASSERT_EQ(table.num_rows, 6U) << names;
    EXPECT_GE(table.Find(error), 0) << names;
    const CsvColumn& position = table.At(table.Find("position_mm"));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(position.values[i], positions[i]) << names;
    }
  }
}

TEST(FoldedPositions, AreNoneOfWhatMayBeSomethingElse) {
  for (const char* names : {"err_1;err_2;err_3",
                            "x_50;x_100;x_150",
                            "t_50;t_100;t_150",
                            "err_50;err_20;err_70",
                            "position;err_50;err_70"}) {
    EXPECT_EQ(Sheet(names).columns.size(), 4U) << names;
  }
}

TEST(FoldedPositions, AreAskedForInTheFormThatWorks) {
  EXPECT_THAT(
      Sheet("err_1;err_2;err_3").remarks,
      ElementsAre("f.csv: 'err_1' to 'err_3' stay separate columns; a column "
                  "for each position is called error_um@50mm, one for "
                  "each run 'Run 1 [um]'"));
  EXPECT_THAT(Sheet("t_1;t_2;t_3").remarks, ::testing::IsEmpty());
}

TEST(FoldedPositions, RefuseNumbersThatMayBeRuns) {
  try {
    Sheet("1;2;3");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                ::testing::HasSubstr("error_um@1mm; of a run: Run 1 [um]"));
  }
}

// Each row has the thermometer of its own run.
TEST(FoldedRuns, TakeWhatEachRunHasBesideItsErrors) {
  for (const std::string run : {"Run ", "R"}) {
    std::string names = "x [mm]";
    for (const char* number : {"1", "2", "3"}) {
      names += "," + run + number + " err [um]," + run + number + " T [degC]";
    }
    const CsvTable table =
        ParseCsv(names + "\n0,1,20,2,21,3,22\n50,4,20,5,21,6,22\n", "f.csv");
    EXPECT_THAT(NamesIn(table),
                ElementsAre("x [mm]", "cycle", "T [degC]", "error [um]"));
    const ColumnValues& warm = table.columns[2].values;
    EXPECT_THAT(std::vector<double>(warm), ElementsAre(20, 20, 21, 21, 22, 22));
  }
  // Three thermometers of every run.
  EXPECT_THAT(ColumnsOf("x [mm],Run 1 [um],Run 2 [um],Run 3 [um],T1 [degC],"
                        "T2 [degC],T3 [degC]\n0,1,2,3,20,21,22\n"),
              SizeIs(6));
  // Places along the axis, of which the file says no more.
  EXPECT_THAT(
      ColumnsOf("T [degC],Pos 1 [um],Pos 2 [um],Pos 3 [um]\n20,1,2,3\n"),
      SizeIs(4));
}

TEST(FoldedRuns, AreNamedInManyWays) {
  const struct {
    const char* names;
    std::vector<std::string> columns;
  } kCases[] = {
      {"Lauf 1 vorw\u00e4rts [\u00b5m];Lauf 1 r\u00fcckw\u00e4rts "
       "[\u00b5m];Lauf 2 vorw\u00e4rts [\u00b5m]",
       {"t1_degC", "cycle", "direction", "error [\u00b5m]"}},
      {"1\u2191 (um);1\u2193 (um);2\u2191 (um)",
       {"t1_degC", "cycle", "direction", "error [um]"}},
      {"1 fwd;1 rev;2 fwd", {"t1_degC", "cycle", "direction", "error"}},
      {"Deviation run 1 (um);Deviation run 2 (um);Deviation run 3 (um)",
       {"t1_degC", "cycle", "error [um]"}},
      {"Day 1 (um);Day 2 (um);Day 3 (um)",
       {"t1_degC", "session", "error [um]"}},
      {"2026-03-02;2026-03-03;2026-03-04", {"t1_degC", "date", "error"}},
      {"2.3.26 [um];3.3.26 [um];4.3.26 [um]",
       {"t1_degC", "date", "error [um]"}},
  };
  for (const auto& [names, columns] : kCases) {
    std::vector<std::string> found;
    for (const CsvColumn& column : Sheet(names).columns) {
      found.push_back(column.name);
    }
    EXPECT_EQ(found, columns) << names;
  }
}

TEST(FoldedRuns, AreTwoWaysByTheirWords) {
  for (const std::string names :
       {"+ (um),- (um)",
        "err_plus_um,err_minus_um",
        "err_vor_um,err_rueck_um",
        "Hinweg [um],R\u00fcckweg [um]",
        "\u00c9cart aller [um],\u00c9cart retour [um]"}) {
    EXPECT_THAT(ColumnsOf("x [mm]," + names + "\n0,1,2\n50,2,4\n"),
                ElementsAre("x [mm]", "direction", "error [um]"))
        << names;
  }
}

TEST(FoldedRuns, LeaveOutWhatASheetMakesOfThem) {
  const std::string text =
      "x [mm],Run 1 [um],Run 2 [um],Run 3 [um],Mean,Range,s,t1_degC\n"
      "0,1,2,3.1,2.03,2.1,1.05,20\n50,4,5,7,5.33,3,1.53,21\n"
      "90,2,2,5,3,3,1.73,20.5\n";
  EXPECT_THAT(ColumnsOf(text),
              ElementsAre("x [mm]", "t1_degC", "cycle", "error [um]"));
  EXPECT_THAT(ParseCsv(text, "f.csv").remarks,
              ::testing::Contains(::testing::HasSubstr(
                  "; 'Mean', 'Range', 's' made of these left out")));
}

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

TEST(FoldedPositions, MayBeOneOnlyWhereTheNameSaysErrorAndPlace) {
  const CsvTable table = ParseCsv("day,error_um@-50mm,t_degC\n1,2,20\n", "f");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("day", "t_degC", "position_mm", "error_um"));
  EXPECT_EQ(table.columns[2].values[0], -50.0);
  EXPECT_THAT(table.remarks,
              ElementsAre(HasSubstr("each of 1 position (-50 mm)")));
  for (const std::string alone : {"t@50mm,error_um",
                                  "err_50,day",
                                  "position_mm,error_um@50mm",
                                  "error_um@50mm,error_um"}) {
    const std::vector<std::string> names =
        NamesIn(ParseCsv(alone + "\n1,2\n", "f"));
    EXPECT_EQ(names.size(), 2U) << alone;
  }
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

}  // namespace
}  // namespace errmap::data
