// Which rows, and what may stand in them: data/measurements/column_checks.h by
// MakeDataset.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/text.h"
#include "tests/data/measurements/make_dataset_test_data.h"

namespace errmap::data {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::string_view kBothWays =
    "direction,day,cycle,x,error_mm\n"
    "down,1,1,1,0.1\n"
    "up,1,1,2,\n"
    "down,2,2,3,0.2\n"
    "up,2,2,4,0.4\n"
    "down,2,3,5,0.5\n";

TEST(ColumnChecks, TextCannotBeATargetAnInputOrAWeight) {
  constexpr std::string_view kText = "a,note,error\n1,x,3\n2,y,4\n";
  EXPECT_EQ(ErrorOf(kText, {.inputs = {"note"}}),
            "f.csv: column 'note' holds no numbers (data row 0 is 'x') and "
            "cannot be an input; leave it out of inputs");
  EXPECT_THAT(
      ErrorOf(kText, {.target = "note"}),
      AllOf(HasSubstr("'note' holds no numbers"), HasSubstr("with target")));
  EXPECT_THAT(
      ErrorOf(kText, {.weight = "note"}),
      AllOf(HasSubstr("'note' holds no numbers"), HasSubstr("with weight")));
}

TEST(ColumnChecks, BadCellsAreNamedWithTheirPlaceAndRemedy) {
  EXPECT_EQ(ErrorOf("t3_degC,error\n1,1\n# gap\n,2\n3,3\n"),
            "f.csv: line 4 (data row 1), column 't3_degC': empty cell; fill it "
            "in, or drop such rows with missing = drop-rows");
  // The row may be shifted: to leave the column out advises wrong numbers.
  EXPECT_THAT(ErrorOf("t3_degC,error\n1,1\n,2\n,3\n"),
              HasSubstr("or leave the column out with exclude = t3_degC"));
  EXPECT_EQ(ErrorOf("a,error\n1,NA\n2,nan\n3,4\n"),
            "f.csv: line 2 (data row 0), column 'error': 'NA' is a missing "
            "value; fill it in, or drop such rows with missing = drop-rows "
            "(the columns in use have 2 such cells)");
  EXPECT_EQ(
      ErrorOf("a,error\n1,1\n-Inf,2\n"),
      "f.csv: line 3 (data row 1), column 'a': '-Inf' is not finite; "
      "correct it, or leave the column out with exclude = a, or drop such "
      "rows with missing = drop-rows");
  EXPECT_THAT(ErrorOf("a,error\n1,1\n1e999,2\n"),
              HasSubstr("'1e999' is beyond the range of a double"));
  EXPECT_THAT(ErrorOf("a,error\n1,1\nbroken,2\n"),
              HasSubstr("'broken' is not a number; fill it in"));
  EXPECT_THAT(ErrorOf("a,error\n1,1\n1o5,2\n"),
              HasSubstr("'1o5' is not a number; correct it"));
  EXPECT_THAT(ErrorOf("a,error\n1.5,1\n\"1,5\",2\n"),
              HasSubstr("'1,5' is not a number here; write a decimal point, or "
                        "separate the columns with ; or tab"));
}

TEST(ColumnChecks, TheFirstBadCellOfTheFileIsNamed) {
  EXPECT_THAT(ErrorOf("a,b,error\n1,1,1\n2,x,2\n,2,3\n"),
              HasSubstr("line 3 (data row 1), column 'b'"));
  EXPECT_THAT(ErrorOf("a,b,error\n1,1,1\n,2,2\n2,x,3\n"),
              HasSubstr("line 3 (data row 1), column 'a'"));
}

TEST(ColumnChecks, LongAndStrangeCellsStayOnOneLine) {
  const std::string error =
      ErrorOf("a,error\n1,1\n\"" + std::string(500, 'x') + "\",2\n");
  EXPECT_THAT(error, HasSubstr(std::string(40, 'x') + "...'"));
  EXPECT_LT(error.size(), 200U);
  EXPECT_THAT(ErrorOf("a,error\n1,1\n\"p\nq\",2\n"),
              AllOf(HasSubstr("'p\\nq'"), Not(HasSubstr("\n"))));
}

TEST(ColumnChecks, DropsRowsWithMissingCellsWhereAsked) {
  const PreparedDataset prepared = Make(
      "cycle,a,error_um\n1,1,1\n1,NA,2\n2,3,\n2,4,4\n,5,5\n3,nAn,6\n3,7,8\n",
      {.missing = MissingPolicy::kDropRows});
  EXPECT_THAT(prepared.dataset.rows(), ElementsAre(0, 3, 6));
  EXPECT_THAT(Column(prepared.dataset, 0), ElementsAre(1, 4, 7));
  EXPECT_THAT(prepared.dataset.groups().labels, ElementsAre("1", "2", "3"));
  EXPECT_THAT(prepared.remarks,
              ElementsAre("4 of 7 rows are dropped for missing cells; the "
                          "first: f.csv: line 3 (data row 1), column 'a'"));
}

TEST(ColumnChecks, DropRowsDropsNothingButMissingCellsAndWords) {
  const DatasetSelection drop{.missing = MissingPolicy::kDropRows};
  EXPECT_THAT(ErrorOf("a,error\n1,1\n1e999,2\n,3\n", drop),
              HasSubstr("line 3 (data row 1), column 'a': '1e999' is beyond"));
  EXPECT_THAT(ErrorOf("a,error\n1,1\n,2\n1o5,3\n", drop),
              HasSubstr("'1o5' is not a number"));
  EXPECT_THAT(Make("a,error_um\n1,1\n--.--,2\nwarm,3\n<0.05,3\n2,4\n", drop)
                  .dataset.rows(),
              ElementsAre(0, 4));
}

TEST(ColumnChecks, RoundsWithoutAnExponentWhatPeopleCount) {
  EXPECT_EQ(Rounded(9999.0), "9999");
  EXPECT_EQ(Rounded(-1440.4), "-1440");
  EXPECT_EQ(Rounded(0.31194), "0.312");
  EXPECT_EQ(Rounded(99.96), "100");
  EXPECT_EQ(Rounded(2.5e7), "2.5e+07");
}

TEST(ColumnChecks, NoRowIsLeft) {
  EXPECT_EQ(ErrorOf("a,b,error\n,1,1\n,2,2\n3,,3\n",
                    {.missing = MissingPolicy::kDropRows}),
            "f.csv: no row is left: each has a missing cell in the columns in "
            "use ('a' lacks 2 of 3); fill them in, or leave such columns out "
            "with exclude");
}

TEST(ColumnChecks, DecimalCommasAndPointsAreNotMixed) {
  EXPECT_EQ(ErrorOf("a;error\n1,5;2\n1.234;3\n"),
            "f.csv: line 3 (data row 1), column 'a': decimal point (1.234), "
            "but decimal comma (1,5) at line 2 (data row 0), column 'a'; write "
            "all numbers one way, without thousands separators");
  EXPECT_THAT(ErrorOf("a;error\n1.5;2\n2;3,5\n"),
              AllOf(HasSubstr("column 'a'"), HasSubstr("column 'error'")));
  // Whole numbers are neither, and columns not in use may be of any kind.
  EXPECT_EQ(ErrorOf("time;a;error\n1.5;1;2\n2.5;2;3,5\n"), "no error");
  // A day of the month is a label and not a number in error.
  EXPECT_EQ(ErrorOf("d;a;error\n03.05;1,5;2\n04.05;2;3,5\n", {.group = "d"}),
            "no error");
}

TEST(ColumnChecks, MissingGroup) {
  EXPECT_EQ(ErrorOf("cycle,a,error\n1,1,1\n,2,2\n"),
            "f.csv: line 3 (data row 1), column 'cycle': empty cell; fill it "
            "in, or drop such rows with missing = drop-rows");
}

TEST(ColumnChecks, KeepsTheRowsOfOneTextUnderTheirNumbersInTheFile) {
  // The empty cell is in a row that nobody asked for.
  const auto prepared = Make(kBothWays, {.where = {{"direction", "down"}}});
  EXPECT_THAT(prepared.dataset.rows(), ElementsAre(0, 2, 4));
  EXPECT_THAT(prepared.dataset.groups().labels, ElementsAre("1", "2", "3"));
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("x"));
  EXPECT_THAT(prepared.remarks, IsEmpty());
}

TEST(ColumnChecks, TakesNumbersAndSeveralColumnsAtOnce) {
  const auto prepared =
      Make(kBothWays, {.where = {{"direction", "down"}, {"day", 2.0}}});
  EXPECT_THAT(prepared.dataset.rows(), ElementsAre(2, 4));
  EXPECT_THAT(Make(kBothWays, {.where = {{"direction", "down"}, {"day", "2"}}})
                  .dataset.rows(),
              ElementsAre(2, 4));
}

TEST(ColumnChecks, UnknownColumnAndAbsentValueAreNamed) {
  EXPECT_THAT(ErrorOf(kBothWays, {.where = {{"directon", "down"}}}),
              AllOf(HasSubstr("no column 'directon' (where)"),
                    HasSubstr("did you mean 'direction'?")));
  EXPECT_THAT(ErrorOf(kBothWays, {.where = {{"direction", "left"}}}),
              HasSubstr("f.csv: no row is left where 'direction' is 'left'; "
                        "the column has 'down', 'up'"));
  EXPECT_THAT(
      ErrorOf(kBothWays, {.where = {{"direction", "up"}, {"day", 7.0}}}),
      HasSubstr("no row is left where 'day' is '7' and the columns before it "
                "are as asked; the column has '1', '2'"));
}

TEST(ColumnChecks, MissingCellsAreCountedAmongTheRowsAskedFor) {
  const auto prepared = Make(
      std::string(kBothWays) + "up,3,3,6,0.6\n",
      {.missing = MissingPolicy::kDropRows, .where = {{"direction", "up"}}});
  EXPECT_THAT(prepared.dataset.rows(), ElementsAre(3, 5));
  EXPECT_THAT(prepared.remarks, Contains(HasSubstr("1 of 3 rows is dropped")));
  EXPECT_EQ(prepared.reading.rows, 2);
  EXPECT_EQ(prepared.reading.rows_filtered, 3);
}

TEST(ColumnChecks, RefusesUnknownUnitsInBracketsAndOnTheTarget) {
  EXPECT_THAT(
      ErrorOf("a,error [furlong]\n1,2\n2,3\n"),
      HasSubstr("f.csv: column 'error [furlong]': 'furlong' is not a unit "
                "known here; add one to the name: target = error [furlong] "
                "[um] (or mm, in, arcsec, urad, deg)"));
  EXPECT_THAT(
      ErrorOf("a,error_m\n1,2\n2,3\n"),
      HasSubstr("'m' counts as a unit in brackets or parentheses only; add one "
                "to the name: target = error_m [m] "));
}

TEST(ColumnChecks, TakesInputsInUnitsThatItDoesNotKnow) {
  const PreparedDataset prepared =
      Make("a (left),b [brix],error_mm\n1,1,2\n2,0,3\n");
  EXPECT_EQ(prepared.dataset.num_inputs(), 2);
  EXPECT_THAT(prepared.remarks,
              Contains("no unit is read from 'a (left)', 'b [brix]': 'left' is "
                       "not a unit known here"));
}

TEST(ColumnChecks, TakesTargetsInUnitsOfTheirOwn) {
  for (const char* unit : {"steps", "mg", "Hz", "counts", "uV", "\u03a9"}) {
    EXPECT_EQ(Make("a,error [" + std::string(unit) + "]\n1,2\n2,3\n")
                  .dataset.target()
                  .unit.quantity,
              Quantity::kOther)
        << unit;
  }
}

// Twelve rows of a counter and a sensor: "..., 3, 20.3, CELL, error".
PreparedDataset WithCells(const std::function<std::string(int)>& cell) {
  std::string text = "a_mm,t1_degC,t2_degC,error_mm\n";
  for (int i = 0; i < 12; ++i) {
    text += std::to_string(i % 4) + "," + std::to_string(20 + i * i % 7) + "," +
            cell(i) + "," + std::to_string(i % 5) + "\n";
  }
  return Make(text, {.missing = MissingPolicy::kDropRows});
}

TEST(ColumnChecks, DropsNoRowsForAColumnThatSaysNothing) {
  const auto numbers = [](int i) { return std::to_string(21 + i * i % 5); };
  const struct {
    const char* what;
    std::function<std::string(int)> cell;
    std::size_t rows;
    Eigen::Index inputs;
  } kCases[] = {
      {"an infinite cell is dropped",
       [&](int i) {
         return i == 3 ? "inf" : i == 4 ? "-Infinity" : numbers(i);
       },
       10,
       3},
      {"hardly a number",
       [&](int i) { return i == 3   ? "21"
                           : i == 4 ? "broken"
                                    : ""; },
       12,
       2},
      {"one value throughout",
       [&](int i) { return i % 2 == 0 ? "21.5" : "OPEN"; },
       12,
       2},
      {"half of the numbers",
       [&](int i) { return i % 2 == 0 ? numbers(i) : "OPEN"; },
       6,
       3},
  };
  for (const auto& [what, cell, rows, inputs] : kCases) {
    const PreparedDataset prepared = WithCells(cell);
    EXPECT_EQ(prepared.dataset.rows().size(), rows) << what;
    EXPECT_EQ(prepared.dataset.num_inputs(), inputs) << what;
  }
}

TEST(ColumnChecks, RefusesNumbersThatStandThereAsText) {
  EXPECT_THAT(ErrorOf("position_mm,a,error_mm\n12.7 mm,1,2\n25 in,4,3\n"),
              HasSubstr("f.csv: line 2 (data row 0), column 'position_mm': "
                        "'12.7 mm' is not a plain number; write it without its "
                        "unit and without thousands separators"));
  EXPECT_THAT(ErrorOf("position,a,error_mm\nleft,1,2\nright,4,3\n"),
              HasSubstr("column 'position': 'left' is not a number"));
  EXPECT_THAT(ErrorOf("position_mm,a,error_mm\n,1,2\n,4,3\n"),
              HasSubstr("column 'position_mm': empty cell"));
  EXPECT_EQ(Make("when,a,error_mm\n2024-01-01,1,2\n2024-01-02,4,3\n")
                .dataset.num_inputs(),
            1);
}

}  // namespace
}  // namespace errmap::data
