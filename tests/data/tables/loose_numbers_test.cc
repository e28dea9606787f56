#include "data/tables/cells/loose_numbers.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "tests/data/tables/small_tables.h"

namespace errmap::data {
namespace {

using namespace small_tables;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Eq;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pointee;

// Thousands go on from the whole numbers beside them; thirds do not.
TEST(LooseNumbers, TellsThirdsFromThousands) {
  const auto values = [](const char* text) {
    return std::vector<double>(ParseCsv(text, "f.csv").columns[0].values);
  };
  EXPECT_THAT(values("x_mm;e\n0;1\n133.333;2\n266.667;3\n400;4\n"),
              ElementsAre(0.0, 133.333, 266.667, 400.0));
  EXPECT_THAT(values("x_mm;e\n500;1\n950;2\n1.050;3\n1.200;4\n"),
              ElementsAre(500.0, 950.0, 1050.0, 1200.0));
}

TEST(LooseNumbers, AreNamedByWhatIsDoneToThem) {
  const CsvTable table = ParseCsv(
      "x_mm,t_degC,error_um\n1,20.5,1.5-\n2,21.5,2.5-\n\"25 000\",22.5,3\n"
      "4,22.5 # door,\xE2\x88\x92"
      "4.5\n",
      "f.csv");
  EXPECT_THAT(table.At(table.Find("error_um")).values,
              ElementsAre(-1.5, -2.5, 3, -4.5));
  EXPECT_THAT(
      table.remarks,
      ElementsAre(
          HasSubstr("1 cell is read as a number with a dash for the "
                    "minus (the first on line 5)"),
          HasSubstr("1 cell is read as a number without marks between "
                    "thousands (the first on line 4)"),
          HasSubstr("1 cell is read as a number without the remark after it"),
          HasSubstr("2 cells are read as numbers with a minus after the "
                    "number, which changes the sign (the first "
                    "on line 2)")));
}

TEST(LooseNumbers, StandBeforeTheirUncertainty) {
  for (const char* behind :
       {" ± 0.20", "±0.2", " +/- 0.20", "(20)", " \xB1 0.2"}) {
    SCOPED_TRACE(behind);
    const CsvTable table =
        ParseCsv("x_mm,error_um\n1,-1.50" + std::string(behind) + "\n2,2.25" +
                     behind + "\n",
                 "f.csv");
    EXPECT_THAT(table.columns[1].values, ElementsAre(-1.5, 2.25));
    EXPECT_THAT(table.remarks,
                ElementsAre(HasSubstr("2 cells are read as numbers without the "
                                      "uncertainty behind them")));
  }
  for (const char* label : {"1(2)", "1.5 ± x", "± 0.2"}) {
    const CsvTable table =
        ParseCsv("x_mm,label\n1," + std::string(label) + "\n", "f.csv");
    EXPECT_TRUE(table.columns[1].is_text()) << label;
  }
}

TEST(LooseNumbers, AreNegativeInParenthesesWithDecimals) {
  const CsvTable table =
      ParseCsv("x_mm,error_um\n1,(1.97)\n2,2.25\n3,(0.10)\n", "f.csv");
  EXPECT_THAT(table.columns[1].values, ElementsAre(-1.97, 2.25, -0.1));
  EXPECT_THAT(table.remarks,
              ElementsAre(HasSubstr("2 cells are read as numbers whose "
                                    "parentheses are a minus")));
  EXPECT_TRUE(
      ParseCsv("x_mm,no\n1,(1)\n2,(2)\n", "f.csv").columns[1].is_text());
}

TEST(LooseNumbers, HaveSignsOfMoney) {
  const CsvTable table = ParseCsv(
      "what,Amount,Balance,Preis,rest\na,$5.30,\"$5,615.30\",\xE2\x82\xAC 2,7 "
      "$\n"
      "b,($849.06),-$3,.5 \xC2\xA3,$x\n",
      "f.csv");
  EXPECT_THAT(table.columns[1].values, ElementsAre(5.3, -849.06));
  EXPECT_THAT(table.columns[2].values, ElementsAre(5615.3, -3.0));
  EXPECT_THAT(table.columns[3].values, ElementsAre(2.0, 0.5));
  EXPECT_THAT(table.columns[4].TextAt(1), Pointee(Eq("$x")));
  EXPECT_THAT(table.remarks,
              Contains(HasSubstr("6 cells are read as numbers without their "
                                 "sign of money (the first on line 2)")));
  // As Windows writes euros.
  EXPECT_THAT(ParseCsv("Preis (\x80);n\n\x80 1.854,25;1\n", "f.csv").columns[0],
              AllOf(Field(&CsvColumn::name, "Preis (\u20AC)"),
                    Field(&CsvColumn::values, ElementsAre(1854.25))));
}

TEST(LooseNumbers, HaveThousandsAsInIndia) {
  const CsvTable table = ParseCsv(
      "n,a\n1.5,\"16,17,375\"\n2.5,\"4,40,12,648\"\n3.5,\"91,666\"\n"
      "4.5,\"1,23,45\"\n",
      "f.csv");
  EXPECT_EQ(table.columns[1].values[0], 1617375.0);
  EXPECT_EQ(table.columns[1].values[1], 44012648.0);
  EXPECT_EQ(table.columns[1].values[2], 91666.0);
  EXPECT_THAT(table.columns[1].TextAt(3), Pointee(Eq("1,23,45")));
}

// No number is written with three zeros for decimals.
TEST(LooseNumbers, HaveThousandsWhereAllEndInThreeZeros) {
  const CsvTable table = ParseCsv(
      "age,Income\n49,\"71,000\"\n74,refused\n62,\"28,000\"\n", "f.csv");
  EXPECT_EQ(table.columns[1].values[0], 71000.0);
  EXPECT_THAT(table.columns[1].TextAt(1), Pointee(Eq("refused")));
  EXPECT_TRUE(ParseCsv("n,x\n1,\"71,000\"\n2,\"71,125\"\n", "f.csv")
                  .columns[1]
                  .is_text());
  EXPECT_THAT(
      ParseCsv("n,x\n1,\"71,000\"\n2,\"0,500\"\n", "f.csv").columns[1].values,
      ElementsAre(71.0, 0.5));
}

TEST(LooseNumbers, HaveFullWidthDigits) {
  const CsvTable table = ParseCsv(
      "x_mm,error_um\n\uFF11\uFF10,-\uFF11\uFF0E\uFF19\n"
      "\uFF12\uFF10,\uFF0D\uFF12\uFF0E\uFF10\n",
      "f.csv");
  EXPECT_THAT(table.columns[0].values, ElementsAre(10.0, 20.0));
  EXPECT_THAT(table.columns[1].values, ElementsAre(-1.9, -2.0));
}

TEST(LooseNumbers, HaveThousandsWhereOthersHaveTwoMarks) {
  const CsvTable table =
      ParseCsv("x_um;t_degC\n0;20,5\n250.000;20,6\n1.000.000;20,7\n", "f.csv");
  EXPECT_THAT(table.columns[0].values, ElementsAre(0, 250000, 1000000));
  EXPECT_THAT(table.remarks, Contains(HasSubstr("as others have two: 250000")));
  // Another mark between the thousands leaves the point to the decimals.
  EXPECT_THAT(
      ParseCsv("x_um;e\n250.125;1\n1,000,000;2\n", "f.csv").columns[0].values,
      ElementsAre(250.125, 1e6));
}

TEST(AngleCells, AreDegrees) {
  const CsvTable table = ParseCsv(
      "Angle;error_arcsec\n"
      "0°00'00.0\";1\n-0° 30' 36\";2\n27°30′;3\n12° 34.5';4\n---;5\n"
      "359°59’59.1”;6\n",
      "f.csv");
  EXPECT_EQ(table.columns[0].name, "Angle [deg]");
  const std::vector<double> wanted = {0.0, -0.51, 27.5, 12.575, NAN, 359.99975};
  for (std::size_t row = 0; row < wanted.size(); ++row) {
    const double read = table.columns[0].values[row];
    if (std::isnan(wanted[row])) {
      EXPECT_TRUE(std::isnan(read));
    } else {
      EXPECT_DOUBLE_EQ(read, wanted[row]);
    }
  }
  EXPECT_THAT(table.remarks,
              ElementsAre(HasSubstr("'Angle [deg]' are angles in degrees")));
}

std::string ColonColumn(const std::string& name,
                        const std::vector<std::string>& cells) {
  std::string text = name + ";error_arcsec\n";
  for (int pass = 0; pass < 3; ++pass) {
    for (const std::string& cell : cells) text += cell + ";1\n";
  }
  return text;
}

TEST(AngleCells, AreDegreesBetweenColonsWhereNoTimeIsLikeThat) {
  for (const std::string name : {"B", "Table"}) {
    const CsvTable negative = ParseCsv(
        ColonColumn(name, {"-27:30:00", "0:00:00", "27:30:36.5"}), "f.csv");
    EXPECT_EQ(negative.columns[0].name, name + " [deg]");
    EXPECT_DOUBLE_EQ(negative.columns[0].values[0], -27.5);
    EXPECT_DOUBLE_EQ(negative.columns[0].values[2], 27.5 + 36.5 / 3600.0);
    const CsvTable wide = ParseCsv(
        ColonColumn(name, {"0:00:00", "90:00:00", "180:00:00"}), "f.csv");
    EXPECT_EQ(wide.columns[0].name, name + " [deg]");
  }
  // The unit says it of fewer.
  const CsvTable named = ParseCsv("B [deg];e_um\n1:30:00;1\n2:15;2\n", "f.csv");
  EXPECT_THAT(named.columns[0].values, ElementsAre(1.5, 2.25));
}

TEST(AngleCells, AreTimesBetweenColonsElsewhere) {
  std::string elapsed = "Elapsed;error_um\n";
  for (int hour = 40; hour < 60; ++hour) {
    elapsed += std::to_string(hour) + ":30:00;1\n";
  }
  for (const std::string& text :
       {elapsed,
        ColonColumn("time", {"08:00:00", "12:00:00", "23:59:00", "24:30:00"}),
        ColonColumn("time", {"8:00", "9:00"})}) {
    const CsvTable table = ParseCsv(text, "f.csv");
    EXPECT_TRUE(table.columns[0].is_text()) << text;
    EXPECT_THAT(table.remarks, IsEmpty());
  }
}

// One that is mistyped does not make a column of words of them.
TEST(AngleCells, AreAnglesInMostRowsOrText) {
  for (const char* cell : {"27°60'00\"", "north", "27°30'10\" x", "27'30°"}) {
    const std::string text =
        "Angle;error_arcsec\n10°00'00\";1\n" + std::string(cell) + ";2\n";
    const CsvTable half = ParseCsv(text, "f.csv");
    EXPECT_EQ(half.columns[0].name, "Angle") << cell;
    EXPECT_TRUE(half.columns[0].is_text()) << cell;
    const CsvTable most = ParseCsv(text + "11°00'00\";3\n", "f.csv");
    EXPECT_EQ(most.columns[0].name, "Angle [deg]") << cell;
    EXPECT_THAT(most.columns[0].TextAt(1), Pointee(Eq(cell)));
  }
}

TEST(UnitsOfCells, CountAmongMixedDecimalMarks) {
  const CsvTable table = ParseCsv(
      "x;t_degC;error_um\n1.000 mm;20,01;1,5\n1.100 mm;20,02;2,5\n1.200 mm;"
      "20,03;3,5\n",
      "f.csv");
  try {
    MakeDataset(table, {});
    FAIL() << "read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("decimal point (1), but decimal comma"));
  }
}

TEST(UnitsOfCells, StandBesideCellsWithoutAReading) {
  const CsvTable table = ParseCsv(
      "Sample,Lead,pH\n1,0.82 mg/l,6\n2,<0.05 mg/l,7\n3,n.d.,6\n4,0.9 mg/l,7\n"
      "5,.5 mg/l,7\n",
      "f.csv");
  EXPECT_EQ(table.columns[1].name, "Lead [mg/l]");
  EXPECT_EQ(table.columns[1].values[3], 0.9);
  EXPECT_EQ(table.columns[1].values[4], 0.5);
  EXPECT_THAT(table.columns[1].TextAt(1), Pointee(Eq("<0.05 mg/l")));
  EXPECT_THAT(table.columns[1].TextAt(2), Pointee(Eq("n.d.")));
}

TEST(UnitsOfCells, MayBeAnyWordBehindMostNumbers) {
  const CsvTable table = ParseCsv(
      "weight,pressure,rate\n96.0kg,198 mmHg,66.8\xC2\xA0%\n"
      "68.4 Kg,1 014 mmHg,-5 %\n",
      "f.csv");
  EXPECT_THAT(NamesIn(table),
              ElementsAre("weight [kg]", "pressure [mmHg]", "rate [%]"));
  EXPECT_THAT(table.columns[0].values, ElementsAre(96.0, 68.4));
  EXPECT_THAT(table.columns[1].values, ElementsAre(198.0, 1014.0));
  EXPECT_THAT(table.columns[2].values, ElementsAre(66.8, -5.0));
  for (const char* labels : {"Run,n\n1 Lauf,1\n2 Lauf,2\n",
                             "p,n\n3 mPa,1\n2 MPa,2\n",
                             "way,n\n1 up,1\n2 down,2\n",
                             "note,n\n5 retries,1\nok,2\nok,3\n",
                             "note,n\n5 retries,1\n,2\n,3\n"}) {
    EXPECT_TRUE(ParseCsv(labels, "f.csv").columns[0].is_text()) << labels;
  }
}

TEST(UnitsOfCells, BecomePartOfANameThatIsFree) {
  const CsvTable table = ParseCsv(
      "T1,T1 [degF],error [um]\n68.5 degF,70,1\n69.5 degF,71,2\n", "f.csv");
  EXPECT_EQ(table.columns[0].name, "T1_2 [degF]");
  EXPECT_THAT(table.columns[0].values, ElementsAre(68.5, 69.5));
  EXPECT_THAT(table.remarks, ElementsAre(HasSubstr("'T1_2 [degF]' carry")));
}

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

// Blanks part Fortran's numbers, too.
TEST(LooseNumbers, StandBetweenBlanks) {
  const CsvTable table = ParseCsv(
      "pos_mm  err_um\n0.0D+00  -1.6D-01\n5.0D+01  1.1D+00\n1.0D+02  "
      "2.1D+00\n",
      "f.csv");
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(table.columns[1].values[0], -0.16);
}

// As spreadsheets save a sheet that has all in its first column.
TEST(LooseNumbers, StandInLinesThatAreQuotedWhole) {
  const CsvTable table = ParseCsv(
      "\"pos_mm;\"\"err_um\"\"\"\r\n\"0;-1,5\"\r\n\"50;2,5\"\r\n", "f.csv");
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(table.columns[1].name, "err_um");
  EXPECT_EQ(table.columns[1].values[1], 2.5);
  // One column of decimal commas.
  EXPECT_EQ(ParseCsv("\"err_um\"\n\"1,5\"\n\"2,5\"\n", "f.csv").columns.size(),
            1U);
}

}  // namespace
}  // namespace errmap::data
