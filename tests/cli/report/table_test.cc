#include "cli/report/table.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/numbers.h"

namespace errmap::report {
namespace {

using ::testing::HasSubstr;

// Every kind of cell, once known and once not.
Table EveryKind() {
  Table table;
  table.error = ErrorText(
      {.symbol = "mm", .display_scale = 1000.0, .display_symbol = "um"}, 0.001);
  table.columns = {{.name = "name", .is_number = false},
                   {.name = "n"},
                   {.name = "digits"},
                   {.name = "decimals"},
                   {.name = "error", .above = "in um"},
                   {.name = "95 %", .group = "every:3"},
                   {.name = "p", .group = "every:3"},
                   {.name = "F (p)"},
                   {.name = "word", .is_number = false}};
  table.rows = {{"a|b, c",
                 std::int64_t{17},
                 Number{1234.56},
                 Fixed{-0.00001, 2},
                 Error{0.0015},
                 Interval{{0.001, 0.002}, 0.0015},
                 P{0.012345, ", so"},
                 Statistic{2.5, 1e-7},
                 Word{"after re-zeroing", "sd", "met_by_sd"}},
                {"",
                 Cell(),
                 Number{kNaN},
                 Fixed{kNaN, 2},
                 Error{kNaN},
                 Interval{{kNaN, kNaN}},
                 P{kNaN},
                 Statistic{kNaN, 0.5},
                 Cell()}};
  return table;
}

TEST(Table, ShowsEveryKindOfCellAndWhatIsNotKnown) {
  const Table table = EveryKind();
  std::vector<std::vector<std::string>> shown;
  for (const auto& row : table.rows) {
    auto& line = shown.emplace_back();
    for (const Cell& cell : row) line.push_back(table.Shown(cell));
  }
  EXPECT_THAT(shown[0],
              ::testing::ElementsAre("a|b, c",
                                     "17",
                                     "1235",
                                     "0.00",
                                     "1.50",
                                     "1.50 (1.00 to 2.00)",
                                     "0.0123, so",
                                     "2.5 (1.0e-07)",
                                     "after re-zeroing"));
  EXPECT_THAT(
      shown[1],
      ::testing::ElementsAre("", "-", "-", "-", "-", "-", "-", "-", "-"));
}

TEST(TerminalTable, AlignsAndCentresWhatColumnsShare) {
  Table table;
  table.columns = {{.name = "model", .is_number = false},
                   {.name = "train", .group = "every:3", .width = 7},
                   {.name = "test", .group = "every:3", .gap = 1},
                   {.name = "ns", .above = "predict", .width = 8}};
  table.rows = {{"µ", Fixed{1.0, 1}, Fixed{10.25, 2}, std::int64_t{5}},
                {"poly", Word{"failed", "fail", "x"}, Cell(), Cell()}};
  EXPECT_EQ(TerminalTable(table),
            "          every:3      predict\n"
            "model    train  test        ns\n"
            "µ          1.0 10.25         5\n"
            "poly      fail     -         -\n");
}

TEST(CsvTable, HasNumbersInFullAndQuotesText) {
  EXPECT_EQ(CsvTable(EveryKind()),
            "name,n,digits,decimals,error,95 %,p,F (p),word\n"
            "\"a|b, c\",17,1234.56,-1e-05,0.0015,1.50 (1.00 to 2.00),0.012345,"
            "2.5,met_by_sd\n"
            ",-,,,,-,,,-\n");
}

TEST(MarkdownTable, EscapesAndMarks) {
  Table table = EveryKind();
  table.title = "What is it?";
  table.note = "A note.";
  table.marked = 0;
  const std::string text = MarkdownTable(table, "###");
  EXPECT_THAT(text, HasSubstr("### What is it?\n\n| name | n |"));
  EXPECT_THAT(text, HasSubstr("| **a\\|b, c** | **17** |"));
  EXPECT_THAT(text, HasSubstr("\n\nA note.\n\n"));
  table.missing = "There is none.";
  EXPECT_EQ(MarkdownTable(table, "###"),
            "### What is it?\n\nThere is none.\n\n");
}

TEST(TableText, WritesEveryFormatThereIsAndNoOther) {
  const Table table = EveryKind();
  EXPECT_EQ(TableText(table, "csv"), CsvTable(table));
  EXPECT_EQ(TableText(table, "md"), MarkdownTable(table));
  for (const TableFormat& format : TableFormats()) {
    EXPECT_THAT(TableText(table, format.name), Optional(HasSubstr("name")));
  }
  EXPECT_EQ(TableText(table, "table"), std::nullopt);
}

TEST(HtmlTable, EscapesAndMarks) {
  Table table = EveryKind();
  table.rows[0][0] = "<b>";
  table.marked = 0;
  EXPECT_THAT(HtmlTable(table),
              HasSubstr("<tr class=\"mark\"><td class=\"t\"><bdi>&lt;b&gt;"
                        "</bdi></td><td>17</td>"));
}

}  // namespace
}  // namespace errmap::report
