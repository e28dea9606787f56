#include "data/tables/cells/loose_numbers.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
      ElementsAre(HasSubstr("1 cell is read as a number with a dash for the "
                            "minus (the first on line 5)"),
                  HasSubstr("1 cell is read as a number less marks between "
                            "thousands (the first on line 4)"),
                  HasSubstr("1 cell is read as a number less a remark behind"),
                  HasSubstr("2 cells are read as numbers with the minus that "
                            "stands behind, which changes the sign (the first "
                            "on line 2)")));
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

TEST(UnitsOfCells, BecomePartOfANameThatIsFree) {
  const CsvTable table = ParseCsv(
      "T1,T1 [degF],error [um]\n68.5 degF,70,1\n69.5 degF,71,2\n", "f.csv");
  EXPECT_EQ(table.columns[0].name, "T1_2 [degF]");
  EXPECT_THAT(table.columns[0].values, ElementsAre(68.5, 69.5));
  EXPECT_THAT(table.remarks, ElementsAre(HasSubstr("'T1_2 [degF]' carry")));
}

}  // namespace
}  // namespace errmap::data
