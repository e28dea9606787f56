#include "data/files_in_memory.h"

#include <array>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "data/sha256.h"

namespace errmap::data {
namespace {

using ::testing::ElementsAre;

std::shared_ptr<const CsvTable> TableOf(double last) {
  auto table = std::make_shared<CsvTable>();
  table->file = "frame";
  table->num_rows = 2;
  CsvColumn& column = table->columns.emplace_back();
  column.name = "x";
  column.values = std::vector<double>{1.0, last};
  return table;
}

TEST(FilesInMemory, AreReadInPlaceOfFilesWhileTheyLive) {
  {
    const FilesInMemory files({{"frame", TableOf(2.0)}}, {{"map", "a text"}});
    EXPECT_THAT(ReadCsv("frame").columns[0].values, ElementsAre(1.0, 2.0));
    EXPECT_EQ(ReadFile("map"), "a text");
    EXPECT_EQ(Sha256OfFile("map"), Sha256("a text"));
    {
      const FilesInMemory inner({{"other", TableOf(3.0)}}, {});
      EXPECT_THROW(ReadCsv("frame"), InputError);
    }
    EXPECT_EQ(ReadCsv("frame").num_rows, 2U);
  }
  EXPECT_THROW(ReadCsv("frame"), InputError);
}

TEST(FilesInMemory, HaveTheHashOfTheirCells) {
  const FilesInMemory files(
      {{"a", TableOf(2.0)}, {"b", TableOf(2.0)}, {"c", TableOf(2.5)}}, {});
  EXPECT_EQ(Sha256OfFile("a"), Sha256OfFile("b"));
  EXPECT_NE(Sha256OfFile("a"), Sha256OfFile("c"));
  std::string sha256;
  ReadCsv("c", &sha256);
  EXPECT_EQ(sha256, Sha256OfFile("c"));
}

TEST(FilesInMemory, HaveRowsAndNoLines) {
  EXPECT_EQ(TableOf(2.0)->Where(1, "x"), "frame: row 1, column 'x'");
}

TEST(ColumnValues, ReadsACallersMemoryWhereItLies) {
  const auto block = std::make_shared<std::array<double, 6>>();
  *block = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0};
  ColumnValues column = ColumnValues::Borrowed(block->data() + 1, 2, 3, block);
  EXPECT_THAT(column, ElementsAre(1.0, 3.0, 5.0));
  EXPECT_THAT(ColumnValues::Borrowed(block->data() + 5, -2, 3, block),
              ElementsAre(5.0, 3.0, 1.0));
  (*block)[3] = 7.0;
  EXPECT_EQ(column[1], 7.0);
  // What is written to becomes the column's own.
  column.push_back(9.0);
  (*block)[3] = 8.0;
  EXPECT_THAT(column, ElementsAre(1.0, 7.0, 5.0, 9.0));
  EXPECT_EQ(column, ColumnValues(std::vector<double>{1.0, 7.0, 5.0, 9.0}));
}

}  // namespace
}  // namespace errmap::data
