#include "data/columns.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::data {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

TEST(TakeRows, KeepsCellsTextsAndTheFirstRowsOfTheirMarks) {
  const CsvTable table = ParseCsv("a;b\n1,5;x\n2;y\n3.5;x\nNA;z\n", "f.csv");
  const CsvColumn a = TakeRows(table.columns[0], {2, -1, 3, 0, 0});
  EXPECT_EQ(a.values[0], 3.5);
  EXPECT_EQ(a.values[4], 1.5);
  EXPECT_THAT(a.exceptions, ElementsAre(Pair(1, 0), Pair(2, 1)));
  EXPECT_THAT(a.texts, ElementsAre("", "NA"));
  EXPECT_EQ(a.first_decimal_point, 0);
  EXPECT_EQ(a.first_decimal_comma, 3);
  EXPECT_THAT(TakeRows(table.columns[1], {2, 0, 1}).texts,
              ElementsAre("x", "y"));
}

TEST(AppendCells, KeepsEachTextOnce) {
  const CsvTable one = ParseCsv("a,b\n1,x\n2,y\n", "f.csv");
  const CsvTable two = ParseCsv("a,b\n1,z\n2,y\n", "f.csv");
  CsvColumn column = one.columns[1];
  AppendCells(two.columns[1], &column);
  EXPECT_THAT(column.texts, ElementsAre("x", "y", "z"));
  EXPECT_THAT(column.exceptions,
              ElementsAre(Pair(0, 0), Pair(1, 1), Pair(2, 2), Pair(3, 1)));
  EXPECT_EQ(*column.TextAt(3), "y");
}

TEST(AppendCells, FindsTextsAmongVeryMany) {
  CsvColumn column{.name = "a"};
  CsvColumn more{.name = "a"};
  for (int i = 0; i < 100; ++i) {
    const CsvColumn one =
        WordColumn("a", {0}, {"text " + std::to_string(i % 60)});
    AppendCells(one, i < 50 ? &column : &more);
  }
  AppendCells(more, &column);
  EXPECT_EQ(column.texts.size(), 60U);
  EXPECT_EQ(*column.TextAt(99), "text 39");
}

TEST(LabelsOf, StopsWhereThereAreTooMany) {
  const CsvTable table = ParseCsv("a\nx\ny\nx\nz\nx\n", "f.csv");
  const LabelsOfRows few = LabelsOf(table, table.columns[0], AllRows(5), 2);
  EXPECT_THAT(few.labels, ElementsAre("x", "y", "z"));
  EXPECT_THAT(few.codes, ElementsAre(0, 1, 0, 2));
}

}  // namespace
}  // namespace errmap::data
