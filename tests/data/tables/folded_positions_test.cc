#include "data/tables/folded_positions.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"

namespace errmap::data {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> ColumnsOf(const std::string& text) {
  std::vector<std::string> names;
  for (const CsvColumn& column : ParseCsv(text, "f.csv").columns) {
    names.push_back(column.name);
  }
  return names;
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

TEST(FoldedPositions, AreNoneOfColumnsThatAreNumbered) {
  for (const char* names : {"A1 deg,A2 deg,A3 deg",
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

}  // namespace
}  // namespace errmap::data
