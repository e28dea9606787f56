#include "data/measurements/column_match.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"

namespace errmap::data {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

ColumnInfo Column(const std::string& name) {
  return {name, UnitOfColumn(name)};
}

MatchedColumn Match(const std::string& header, const std::string& wanted) {
  return MatchColumn(ParseCsv(header + "\n1,2\n", "f.csv"), Column(wanted));
}

std::string Refusal(const std::string& header, const std::string& wanted) {
  try {
    Match(header, wanted);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MatchColumn, TakesTheColumnOfThatName) {
  const MatchedColumn match = Match("t1_degC,error_mm", "t1_degC");
  EXPECT_EQ(match.of_file, match.of_map);
  EXPECT_EQ(match.InMapUnit(20.0), 20.0);
  EXPECT_EQ(match.Remark(), "");
}

TEST(MatchColumn, FindsTheNameInAnotherUnitAndConverts) {
  const MatchedColumn kelvin = Match("T1 [K],error_mm", "t1_degC");
  EXPECT_DOUBLE_EQ(kelvin.InMapUnit(293.15), 20.0);
  EXPECT_EQ(kelvin.Remark(),
            "t1_degC is read from 'T1 [K]' and converted from K to degC");
  EXPECT_DOUBLE_EQ(Match("position [m],e", "position_mm").InMapUnit(0.25),
                   250.0);
  EXPECT_DOUBLE_EQ(Match("error_um,e", "error_mm").InMapUnit(2.0), 0.002);
  EXPECT_EQ(Match("error (mm),e", "error_mm").Remark(),
            "error_mm is read from 'error (mm)'");
}

TEST(MatchColumn, ConvertsFromTheUnitOfTheMap) {
  // A map whose file says metres, on a column that says millimetres.
  const MatchedColumn match = MatchColumn(ParseCsv("x_mm,b\n1,2\n", "f.csv"),
                                          {"x_mm", UnitOfSymbol("m")});
  EXPECT_DOUBLE_EQ(match.InMapUnit(250.0), 0.25);
  EXPECT_EQ(match.Remark(), "x_mm is converted from mm to m");
  // The very name, without a unit in it: as the map has it.
  EXPECT_EQ(
      MatchColumn(ParseCsv("x,b\n1,2\n", "f.csv"), {"x", UnitOfSymbol("V")})
          .Remark(),
      "");
}

TEST(MatchColumn, ReadsMapsThatHaveNoUnitOfANameThatHasOneNow) {
  const MatchedColumn match =
      MatchColumn(ParseCsv("T1_C,b\n1,2\n", "f.csv"), {"T1_C", Unit{}});
  EXPECT_EQ(match.InMapUnit(20.0), 20.0);
}

TEST(MatchColumn, RefusesAnotherQuantityAndWhatIsNotSure) {
  EXPECT_THAT(Refusal("t1_mm,e", "t1_degC"),
              HasSubstr("f.csv: column 't1_mm' is in mm, the map's 't1_degC' "
                        "in degC"));
  EXPECT_THAT(Refusal("speed,e", "speed_rpm"),
              HasSubstr("'speed' is in no unit, the map's 'speed_rpm' in rpm"));
  EXPECT_THAT(Refusal("t1 [K],T1_degF", "t1_degC"),
              HasSubstr("'t1 [K]' and 'T1_degF' both could be meant"));
  EXPECT_THAT(Refusal("position_m,e", "position_mm"),
              AllOf(HasSubstr("no column 'position_mm'"),
                    HasSubstr("rename it 'position [m]'")));
  EXPECT_THAT(Refusal("positoin_mm,e", "position_mm"),
              HasSubstr("did you mean 'positoin_mm'?"));
  EXPECT_THAT(Refusal("a,b", "t1_degC"), HasSubstr("add it or fit a map"));
}

TEST(InMapUnits, RenamesAndConvertsWhatTheMapReads) {
  const TableForMap read =
      InMapUnits(ParseCsv("T1 [K],b,error_um\n293.15,1,2\n,2,3\n", "f.csv"),
                 {Column("t1_degC"), Column("error_mm"), Column("b")});
  EXPECT_EQ(read.table.columns[0].name, "t1_degC");
  EXPECT_DOUBLE_EQ(read.table.columns[0].values[0], 20.0);
  EXPECT_EQ(read.table.CellText(read.table.columns[0], 1), "");
  EXPECT_EQ(read.table.columns[2].name, "error_mm");
  EXPECT_DOUBLE_EQ(read.table.columns[2].values[1], 0.003);
  EXPECT_THAT(read.remarks,
              ::testing::ElementsAre(
                  "t1_degC is read from 'T1 [K]' and converted from K to degC",
                  "error_mm is read from 'error_um' and converted from um to "
                  "mm"));
}

// As where the map was fitted: its clock and its sessions are these.
TEST(InMapUnits, WritesDatesAndFillsMergedCells) {
  const TableForMap read =
      InMapUnits(ParseCsv("Year,Month,Day,cycle,x\n2024,3,4,1,5\n2024,3,4,,6\n"
                          "2024,3,4,,7\n",
                          "f.csv"),
                 {Column("x")});
  ASSERT_EQ(read.table.columns.size(), 6U);
  EXPECT_EQ(read.table.columns[5].name, "Year + Month + Day");
  EXPECT_EQ(read.table.CellText(read.table.columns[5], 2), "2024-03-04");
  EXPECT_EQ(read.table.columns[3].values[2], 1.0);
}

TEST(InMapUnits, LeavesOutRowsOfTotals) {
  std::string text = "cycle,x,error_um\n";
  for (int i = 0; i < 12; ++i) text += std::to_string(i / 6 + 1) + ",5,6\n";
  const std::string total = "Mean,5,6\n";
  text.insert(text.find("2,5"), total);
  const TableForMap read =
      InMapUnits(ParseCsv(text + total, "f.csv"), {Column("x")});
  EXPECT_EQ(read.table.num_rows, 12U);
  EXPECT_EQ(read.table.LineOfRow(6), 9U);
  EXPECT_THAT(read.remarks,
              ::testing::ElementsAre("rows of totals or remarks are left out: "
                                     "2, the first on line 8"));
}

}  // namespace
}  // namespace errmap::data
