#include "data/csv.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data/tables/small_tables.h"

namespace errmap::data {
namespace {

using small_tables::NamesIn;
using small_tables::RefusalOf;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Pair;

// ---- Numbers and texts.

TEST(ParseCsv, ReadsNumbersIntoNamedColumns) {
  const CsvTable table = ParseCsv("a,b\n1,-2.5\n3e2,4.5E-3\n", "f.csv");
  EXPECT_EQ(table.file, "f.csv");
  EXPECT_EQ(table.num_rows, 2U);
  EXPECT_THAT(NamesIn(table), ElementsAre("a", "b"));
  EXPECT_THAT(table.columns[0].values, ElementsAre(1.0, 300.0));
  EXPECT_THAT(table.columns[1].values, ElementsAre(-2.5, 4.5e-3));
  EXPECT_THAT(table.columns[0].exceptions, IsEmpty());
}

TEST(ParseCsv, TrimsBlanksAndTakesALeadingPlusAndQuotedNumbers) {
  const CsvTable table =
      ParseCsv(" a ,\tb, c\n 1 ,\t+2.5\t, \" 3 \" \n", "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("a", "b", "c"));
  EXPECT_THAT(table.columns[0].values, ElementsAre(1.0));
  EXPECT_THAT(table.columns[1].values, ElementsAre(2.5));
  EXPECT_THAT(table.columns[2].values, ElementsAre(3.0));
}

TEST(ParseCsv, ReadsEveryDoubleToTheLastBit) {
  std::mt19937_64 random(20240501);
  std::string text = "x\n";
  std::vector<double> expected;
  while (expected.size() < 1000) {
    const std::uint64_t bits = random();
    const double value = std::bit_cast<double>(bits);
    if (!std::isfinite(value)) continue;
    expected.push_back(value);
    text += CsvNumber(value) + "\n";
  }
  EXPECT_EQ(ParseCsv(text, "f.csv").columns[0].values, expected);
}

TEST(ParseCsv, KeepsWhatIsNoFiniteNumberAsTextOnce) {
  const CsvTable table =
      ParseCsv("x,y\nNA,1\n2,1\n,1\ninf,1\nNA,1\n -nan ,1\n", "f.csv");
  const CsvColumn& x = table.columns[0];
  EXPECT_THAT(x.texts, ElementsAre("NA", "", "inf", "-nan"));
  EXPECT_THAT(
      x.exceptions,
      ElementsAre(Pair(0, 0), Pair(2, 1), Pair(3, 2), Pair(4, 0), Pair(5, 3)));
  EXPECT_TRUE(std::isnan(x.values[0]));
  EXPECT_EQ(x.values[1], 2.0);
  EXPECT_FALSE(x.is_text());
  EXPECT_EQ(table.CellText(x, 0), "NA");
  EXPECT_EQ(table.CellText(x, 1), "2");
  EXPECT_EQ(table.CellText(x, 2), "");
}

TEST(ParseCsv, TakesNoOtherSpellingForANumber) {
  for (const std::string cell :
       {"0x10",   "e",      "e5",       "1e",     "1e+", ".",     "-",
        "+",      "+-1",    "-+1",      "1.2.3",  "1 2", "1_000", "1e999",
        "-1e999", "1e-999", "infinity", "nan(1)", "1d3", "12xy",  "\xC2\xB5"}) {
    const CsvTable table = ParseCsv("x,y\n" + cell + ",1\n", "f.csv");
    EXPECT_THAT(table.columns[0].texts, ElementsAre(cell)) << cell;
    EXPECT_TRUE(table.columns[0].is_text()) << cell;
  }
}

TEST(ParseCsv, CodesManyDistinctTexts) {
  std::string text = "id;x\n";
  constexpr int kRows = 5000;
  for (int i = 0; i < kRows; ++i) {
    text += "row" + std::to_string(i % 1000) + ";1\n";
  }
  const CsvTable table = ParseCsv(text, "f.csv");
  EXPECT_TRUE(table.columns[0].is_text());
  EXPECT_EQ(table.columns[0].texts.size(), 1000U);
  EXPECT_EQ(table.CellText(table.columns[0], 4321), "row321");
}

TEST(ParseCsv, ReadsTextThatIsNoUtf8AsThatOfWindows) {
  const CsvTable table = ParseCsv(
      "T_\xB0"
      "C,n\n\xE4,1\n",
      "f.csv");
  EXPECT_EQ(table.columns[0].name, "T_\u00b0C");
  EXPECT_EQ(table.columns[0].texts[0], "\u00e4");
  EXPECT_EQ(ParseCsv("T_\u00b0C,n\n1,1\n", "f.csv").columns[0].name,
            "T_\u00b0C");
  // What stands for no character can be typed all the same.
  EXPECT_THAT(NamesIn(ParseCsv("Quantit\x8E,n\x96\x9D\n1,1\n", "f.csv")),
              ElementsAre("Quantit\u017D", "n\u2013\uFFFD"));
}

// ---- Delimiters and decimals.

TEST(ParseCsv, FindsSemicolonAndTab) {
  for (const char* text : {"a;b\n1;2\n", "a\tb\n1\t2\n", "a,b\n1,2\n"}) {
    const CsvTable table = ParseCsv(text, "f.csv");
    EXPECT_THAT(NamesIn(table), ElementsAre("a", "b"));
    EXPECT_THAT(table.columns[1].values, ElementsAre(2.0));
  }
}

TEST(ParseCsv, ReadsDecimalCommasBetweenSemicolonsAndTabs) {
  const CsvTable table = ParseCsv("a;b\n1;-2,5\n,5;+1,5e-1\n", "f.csv");
  EXPECT_THAT(table.columns[0].values, ElementsAre(1.0, 0.5));
  EXPECT_THAT(table.columns[1].values, ElementsAre(-2.5, 0.15));
  EXPECT_EQ(table.columns[0].first_decimal_comma, 1);
  EXPECT_EQ(table.columns[1].first_decimal_comma, 0);
  EXPECT_EQ(table.columns[1].first_decimal_point, -1);
  EXPECT_THAT(ParseCsv("a\tb\n1,5\t2\n", "f").columns[0].values,
              ElementsAre(1.5));
}

TEST(ParseCsv, TakesDecimalCommasInQuotesWhereNoNumberHasAPoint) {
  EXPECT_THAT(ParseCsv("a,b\n\"1,5\",2\n", "f.csv").columns[0].values,
              ElementsAre(1.5));
  const CsvTable table = ParseCsv("a,b\n\"1,5\",2.5\n", "f.csv");
  EXPECT_THAT(table.columns[0].texts, ElementsAre("1,5"));
}

TEST(ParseCsv, TakesNumbersAsPeopleWriteThem) {
  const CsvTable table = ParseCsv(
      "a;b;c;d;e\n1.234,5;25 000;25'000,5;\xE2\x88\x92"
      "2,5;3,5 # a door\n"
      "1.234.567;1 000;0;2,5-;-4\n",
      "f.csv");
  EXPECT_THAT(table.columns[0].values, ElementsAre(1234.5, 1234567.0));
  EXPECT_THAT(table.columns[1].values, ElementsAre(25000.0, 1000.0));
  EXPECT_THAT(table.columns[2].values, ElementsAre(25000.5, 0.0));
  EXPECT_THAT(table.columns[3].values, ElementsAre(-2.5, -2.5));
  EXPECT_THAT(table.columns[4].values, ElementsAre(3.5, -4.0));
  EXPECT_THAT(table.remarks,
              Contains(HasSubstr("5 cells are read as numbers without marks")));
  // With points in other numbers a comma is none.
  EXPECT_THAT(ParseCsv("a,b\n\"25,000\",2.5\n", "f.csv").columns[0].values,
              ElementsAre(25000.0));
}

TEST(ParseCsv, TakesNoNumberWithMarksInOtherPlaces) {
  const CsvTable table = ParseCsv(
      "a;b;c;d;e;f;g\n1;1;1;1;1;1;1\n1,234,5;1.234.5;1 2;2;2;2;2\n", "f.csv");
  EXPECT_THAT(table.columns[0].texts, ElementsAre("1,234,5"));
  EXPECT_THAT(table.columns[1].texts, ElementsAre("1.234.5"));
  EXPECT_THAT(table.columns[2].texts, ElementsAre("1 2"));
}

TEST(ParseCsv, TakesTheUnitOfAllCellsForTheColumns) {
  const CsvTable table = ParseCsv(
      "Error;x\n1,5 \xC2\xB5m;12mm\nNaN;13mm\n-2 \xC2\xB5m;4 in\n", "f");
  EXPECT_EQ(table.columns[0].name, "Error [\xC2\xB5m]");
  EXPECT_EQ(table.columns[0].values[2], -2.0);
  EXPECT_THAT(table.columns[0].texts[table.columns[0].exceptions[0].second],
              "NaN");
  EXPECT_TRUE(table.columns[1].is_text());
}

TEST(ParseCsv, ReadsCellsInSingleQuotesAndColumnsSetApartByBlanks) {
  EXPECT_THAT(NamesIn(ParseCsv("'a';'b'\n'1';'2,5'\n", "f")),
              ElementsAre("a", "b"));
  const CsvTable table = ParseCsv(
      "  Time [s]   Error [um]\n       1.0         -2.5\n      12.0          3"
      ".5\n",
      "f");
  EXPECT_THAT(NamesIn(table), ElementsAre("Time [s]", "Error [um]"));
  EXPECT_THAT(table.columns[1].values, ElementsAre(-2.5, 3.5));
}

TEST(ParseCsv, FoldsAColumnForEachRunAndForEachPosition) {
  const CsvTable runs = ParseCsv(
      "X [mm],Run 1 up [um],Run 1 down [um],Run 2 up [um],Run 2 down [um]\n"
      "0,1,2,3,4\n50,5,6,7,8\n",
      "f");
  EXPECT_THAT(NamesIn(runs),
              ElementsAre("X [mm]", "cycle", "direction", "error [um]"));
  EXPECT_THAT(runs.columns[0].values, ElementsAre(0, 50, 50, 0, 0, 50, 50, 0));
  EXPECT_THAT(runs.columns[1].values, ElementsAre(1, 1, 1, 1, 2, 2, 2, 2));
  EXPECT_THAT(runs.columns[3].values, ElementsAre(1, 5, 6, 2, 3, 7, 8, 4));
  const CsvTable places =
      ParseCsv("cycle,X=0 mm,X=50 mm,X=100 mm\n1,1,2,3\n2,4,5,6\n", "f");
  EXPECT_THAT(NamesIn(places), ElementsAre("cycle", "position_mm", "error"));
  EXPECT_THAT(places.columns[2].values, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(ParseCsv, PassesOverLinesOfWordsAmongTheRows) {
  const CsvTable table = ParseCsv(
      "a,b,c\n1,2,3\n\nDay 2: cold start\na,b,c\nmm,um,\n4,5,6\n\nEnd of "
      "test\n",
      "f");
  EXPECT_THAT(table.columns[2].values, ElementsAre(3, 6));
  EXPECT_THAT(table.remarks,
              Contains(HasSubstr("2 lines of words among the rows: 'Day 2")));
}

// Excel shows a date as ######## where the column is narrow.
TEST(ParseCsv, CountsRowsThatAreComments) {
  const CsvTable table = ParseCsv(
      "time,x_mm,e_um\n# time,x_mm,e_um\n8:00,1,2\n# a cold start\n"
      "########,3,4\n#8:02,5,6\n",
      "f.csv");
  EXPECT_EQ(table.num_rows, 1);
  EXPECT_THAT(table.remarks,
              ElementsAre("f.csv: rows behind # are passed over: 2"));
}

TEST(ParseCsv, NotesFirstDecimalPointAndComma) {
  const CsvTable table = ParseCsv("a;b\n1;2\n3,5;2\n1.234;2\n", "f.csv");
  EXPECT_EQ(table.columns[0].first_decimal_comma, 1);
  EXPECT_EQ(table.columns[0].first_decimal_point, 2);
  EXPECT_EQ(table.columns[1].first_decimal_point, -1);
}

TEST(ParseCsv, PrefersTheDelimiterThatAgreesWithTheFirstRow) {
  const CsvTable names = ParseCsv("a, in mm;b\n1,5;2,5\n", "f.csv");
  EXPECT_THAT(NamesIn(names), ElementsAre("a, in mm", "b"));
  const CsvTable quoted = ParseCsv("\"a;b;c;d\",e\n1,2\n", "f.csv");
  EXPECT_THAT(NamesIn(quoted), ElementsAre("a;b;c;d", "e"));
  const CsvTable comments =
      ParseCsv("a, b;c\n# one, two; three; four\n1,5;2\n", "f.csv");
  EXPECT_EQ(comments.num_rows, 1U);
}

TEST(ParseCsv, ReadsASingleColumn) {
  const CsvTable table = ParseCsv("error_mm\n1\n2.5\n", "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("error_mm"));
  EXPECT_THAT(table.columns[0].values, ElementsAre(1.0, 2.5));
}

// ---- Lines, comments, quotes.

TEST(ParseCsv, PassesOverByteOrderMarkCommentsAndBlankLinesAtTheEnds) {
  const CsvTable table = ParseCsv(
      "\xEF\xBB\xBF# made by hand\n\na,b\n# unit: mm\n1,2\n#\n3,4\n\n  \n"
      "# end\n\t\n",
      "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("a", "b"));
  EXPECT_THAT(table.columns[0].values, ElementsAre(1.0, 3.0));
  EXPECT_EQ(table.LineOfRow(0), 5U);
  EXPECT_EQ(table.LineOfRow(1), 7U);
}

TEST(ParseCsv, TakesAllLineEndsAndALastLineWithout) {
  for (const char* text : {"a,b\n1,2\n#x\n3,4\n",
                           "a,b\r\n1,2\r\n#x\r\n3,4\r\n",
                           "a,b\r1,2\r#x\r3,4\r",
                           "a,b\n1,2\n#x\n3,4",
                           "a,b\r\n1,2\r\n#x\r\n3,4",
                           "a,b\r1,2\r#x\r3,4"}) {
    const CsvTable table = ParseCsv(text, "f.csv");
    EXPECT_THAT(table.columns[1].values, ElementsAre(2.0, 4.0)) << text;
    EXPECT_EQ(table.LineOfRow(1), 4U) << text;
  }
}

TEST(ParseCsv, TakesASpacesOnlyLastLineWithoutLineEnd) {
  EXPECT_EQ(ParseCsv("a,b\n1,2\n   ", "f.csv").num_rows, 1U);
  EXPECT_EQ(ParseCsv("a\tb\n1\t2\n  \n", "f.csv").num_rows, 1U);
}

TEST(ParseCsv, ReadsAnEmptyLastCell) {
  const CsvTable table = ParseCsv("a,b\n1,\n2,", "f.csv");
  EXPECT_EQ(table.num_rows, 2U);
  EXPECT_TRUE(table.columns[1].is_text());
}

TEST(ParseCsv, ReadsQuotesAsRfc4180) {
  const CsvTable table = ParseCsv(
      "\"a,1\",\"say \"\"x\"\"\"\n\"p,q\",\"r\"\"\"\n , \"s\" \n", "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("a,1", "say \"x\""));
  EXPECT_EQ(table.CellText(table.columns[0], 0), "p,q");
  EXPECT_EQ(table.CellText(table.columns[1], 0), "r\"");
  EXPECT_EQ(table.CellText(table.columns[1], 1), "s");
}

TEST(ParseCsv, LeavesAQuoteInsideACellAlone) {
  const CsvTable table = ParseCsv("pipe,x\n5\" bore,1\n6\" bore,2\n", "f.csv");
  EXPECT_EQ(table.CellText(table.columns[0], 1), "6\" bore");
}

TEST(ParseCsv, CountsLinesAcrossQuotedLineBreaks) {
  const CsvTable table = ParseCsv(
      "a,note\n1,\"x\n# no comment\ny\"\n2,b\n3,\"p\r\nq\rr\"\n4,d\n", "f.csv");
  EXPECT_EQ(table.num_rows, 4U);
  EXPECT_EQ(table.CellText(table.columns[1], 0), "x\n# no comment\ny");
  EXPECT_EQ(table.CellText(table.columns[1], 2), "p\r\nq\rr");
  EXPECT_EQ(table.LineOfRow(0), 2U);
  EXPECT_EQ(table.LineOfRow(1), 5U);
  EXPECT_EQ(table.LineOfRow(2), 6U);
  EXPECT_EQ(table.LineOfRow(3), 9U);
  EXPECT_EQ(table.Where(3, "a"), "f.csv: line 9 (data row 3), column 'a'");
}

TEST(ParseCsv, CountsLinesWithACommentBetween) {
  const CsvTable table = ParseCsv("a\n1\n2\n#\n#\n3\n4\n", "f.csv");
  EXPECT_THAT(table.line_runs, ElementsAre(Pair(0, 2), Pair(2, 6)));
  EXPECT_EQ(table.LineOfRow(3), 7U);
}

TEST(ParseCsv, NamesUnnamedColumnsByNumber) {
  const CsvTable table = ParseCsv("a,,\"\",b\n1,2,3,4\n", "f.csv");
  EXPECT_THAT(NamesIn(table), ElementsAre("a", "column_2", "column_3", "b"));
}

TEST(ParseCsv, TakesNanAsAName) {
  EXPECT_THAT(NamesIn(ParseCsv("nan,inf\n1,2\n", "f.csv")),
              ElementsAre("nan", "inf"));
}

TEST(CsvTable, FindsColumnsByName) {
  const CsvTable table = ParseCsv("a,b\n1,2\n", "f.csv");
  EXPECT_EQ(table.Find("b"), 1);
  EXPECT_EQ(table.Find("c"), -1);
}

// ---- Errors.

TEST(ParseCsvError, EmptyFile) {
  const std::string message =
      "f.csv: the file is empty; it needs a line of column names and rows of "
      "numbers below";
  EXPECT_EQ(RefusalOf(""), message);
  EXPECT_EQ(RefusalOf("\xEF\xBB\xBF"), message);
}

TEST(ParseCsvError, OnlyCommentsOrBlankLines) {
  for (const char* text : {"# a\n# b", "\n\n", "  ", "\xEF\xBB\xBF#\n"}) {
    EXPECT_THAT(RefusalOf(text), HasSubstr("f.csv: no header, only comments"))
        << text;
  }
}

TEST(ParseCsvError, HeaderAlone) {
  EXPECT_EQ(RefusalOf("# x\na,b\n\n# nothing\n"),
            "f.csv: line 2: a header without data; put rows of numbers below "
            "it");
  EXPECT_THAT(RefusalOf("a,b"), HasSubstr("a header without data"));
}

TEST(ParseCsvError, NumberWhereANameShouldBe) {
  EXPECT_EQ(RefusalOf("a;1,5\n1;2\n"),
            "f.csv: line 1: no header: cell 2 is the number '1,5' where a "
            "column name should be; write a name in its place (of "
            "errors at a position: error_um@1,5mm; of a run: Run 1,5 [um])");
}

TEST(ParseCsvError, RaggedRows) {
  EXPECT_EQ(RefusalOf("a;b;c\n1;2;3\n4;5\n"),
            "f.csv: line 3 (data row 1): 2 fields where the header has 3; "
            "complete the row or remove it");
  EXPECT_THAT(RefusalOf("a;b\n1;2;3;4\n"),
              AllOf(HasSubstr("4 fields where"), Not(HasSubstr("decimal"))));
  EXPECT_THAT(RefusalOf("a;b\n1\n"), HasSubstr("1 field where"));
}

TEST(ParseCsvError, RaggedRowsHintAtDecimalCommas) {
  EXPECT_THAT(RefusalOf("a,b\n1,5,2,5\n"),
              AllOf(HasSubstr("line 2 (data row 0): 4 fields where the header "
                              "has 2"),
                    HasSubstr("if these are decimal commas")));
}

TEST(ParseCsvError, BlankLineInsideTheData) {
  EXPECT_EQ(RefusalOf("a\n1\n \n\n3\n"),
            "f.csv: line 3: blank line inside the data; remove it, or start it "
            "with #");
}

TEST(ParseCsvError, QuoteNeverClosed) {
  EXPECT_EQ(RefusalOf("a,b\n1,2\n3,\"open\n4,5\n6,7\n"),
            "f.csv: line 3 (data row 1), column 'b': the quote that opens here "
            "is never closed; close it, or remove it");
  EXPECT_THAT(RefusalOf("a,\"b\n1,2\n"), HasSubstr("f.csv: line 1: the quote"));
  EXPECT_THAT(RefusalOf("a,b\n1,\""), HasSubstr("line 2 (data row 0)"));
}

TEST(ParseCsvError, TextAfterAClosingQuoteOfSeveralLines) {
  EXPECT_EQ(RefusalOf("a,b\n1,2\n3,\"x\ny\" z\"\n"),
            "f.csv: line 3 (data row 1), column 'b': the quote that opens here "
            "is never closed; close it, or remove it");
}

TEST(ParseCsvError, NulByte) {
  EXPECT_THAT(RefusalOf(std::string_view("a,b\n1,2\n3,\0\n", 12)),
              HasSubstr("f.csv: line 3: NUL byte"));
}

TEST(ParseCsvError, Utf16ThatBreaksOff) {
  EXPECT_EQ(RefusalOf(std::string_view("\xFF\xFE"
                                       "a\0b",
                                       5)),
            "f.csv: UTF-16 that breaks off at byte 4; save it as CSV in UTF-8");
  EXPECT_THAT(RefusalOf(std::string_view("\xFE\xFF\xDC\x00", 4)),
              HasSubstr("breaks off at byte 2"));
}

TEST(ParseCsvError, StaysOnOneReadableLine) {
  const auto with_name = [](const std::string& name) {
    return RefusalOf(name + ",b\n1,2\n\"3,4\n");
  };
  const std::string error = with_name(std::string(200, 'n'));
  EXPECT_THAT(error, HasSubstr("nnn...'"));
  EXPECT_LT(error.size(), 250U);
  EXPECT_THAT(with_name("\"a\nb\x1b[2J\x7f\""),
              HasSubstr("'a\\nb\\x1b[2J\\x7f'"));
  EXPECT_THAT(with_name("\xC2\x9B"), HasSubstr("'\\x9b'"));
}

TEST(ParseCsvError, DoesNotCutACharacterInTwo) {
  std::string name;
  for (int i = 0; i < 100; ++i) name += "\u00e4";
  EXPECT_THAT(RefusalOf(name + ",b\n1,2\n\"3,4\n"), HasSubstr("\u00e4...'"));
}

TEST(ReadCsv, NamesAFileThatCannotBeRead) {
  EXPECT_THAT([] { ReadCsv("/nonexistent/f.csv"); },
              ::testing::ThrowsMessage<InputError>(
                  HasSubstr("/nonexistent/f.csv: cannot be read: No such "
                            "file or directory")));
  EXPECT_THROW(ReadCsv("/"), InputError);
}

// ---- Hostile input.

TEST(ParseCsv, ReadsLongNamesAndManyColumns) {
  std::string header;
  std::string row;
  constexpr int kColumns = 20000;
  for (int i = 0; i < kColumns; ++i) {
    header += (i > 0 ? "," : "") + std::string(200, 'n') + std::to_string(i);
    row += (i > 0 ? ",1" : "1");
  }
  const CsvTable table = ParseCsv(header + "\n" + row + "\n", "f.csv");
  EXPECT_EQ(table.columns.size(), static_cast<std::size_t>(kColumns));
  EXPECT_EQ(table.columns.back().name.size(), 205U);
}

TEST(ParseCsv, ReadsAVeryLongCell) {
  const std::string digits(1'000'000, '7');
  const CsvTable table =
      ParseCsv("a,b\n0." + digits + "," + digits + "\n", "f");
  EXPECT_NEAR(table.columns[0].values[0], 7.0 / 9.0, 1e-15);
  EXPECT_EQ(table.columns[1].texts[0], digits);  // beyond any double
}

// Every table that comes out is well-formed, and nothing but InputError comes
// instead, with a message of one line.
void ExpectTableOrInputError(const std::string& text) {
  try {
    const CsvTable table = ParseCsv(text, "f.csv");
    ASSERT_GT(table.num_rows, 0U);
    std::size_t line = 0;  // there may be no names
    for (std::size_t row = 0; row < table.num_rows; ++row) {
      ASSERT_GT(table.LineOfRow(row), line);
      line = table.LineOfRow(row);
    }
    for (const CsvColumn& column : table.columns) {
      ASSERT_EQ(column.values.size(), table.num_rows);
      std::size_t num_nan = 0;
      for (const double value : column.values) {
        if (std::isnan(value)) ++num_nan;
        ASSERT_FALSE(std::isinf(value));
      }
      ASSERT_EQ(num_nan, column.exceptions.size());
      for (const auto& [row, index] : column.exceptions) {
        ASSERT_TRUE(std::isnan(column.values[row]));
        ASSERT_LT(index, column.texts.size());
      }
    }
  } catch (const InputError& error) {
    const std::string message = error.what();
    ASSERT_THAT(message, ::testing::StartsWith("f.csv: "));
    ASSERT_THAT(message, Not(HasSubstr("\n")));
    ASSERT_LT(message.size(), 500U);
  }
}

TEST(ParseCsv, SurvivesRandomBytes) {
  std::mt19937_64 random(42);
  constexpr int kTrials = 3000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string text(random() % 200, ' ');
    for (char& c : text) c = static_cast<char>(random() & 0xFFU);
    ASSERT_NO_FATAL_FAILURE(ExpectTableOrInputError(text)) << trial;
  }
}

TEST(ParseCsv, SurvivesRandomPiecesOfCsv) {
  const std::vector<std::string> pieces = {
      "1",  "2.5", "-3e4", "1,5",  "NA",   ",",  ";",     "\t",     "\n",
      "\n", ",",   ",",    "\r\n", "\r",   "\"", "\"\"",  " ",      "#",
      "a",  "b",   "inf",  "x y",  "\xE4", "+",  "1e999", "\n1,2\n"};
  std::mt19937_64 random(43);
  constexpr int kTrials = 20000;
  int tables = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string text = "p,q\n";
    if (trial % 2 == 0) text = "p;q\n1;2\n";
    const std::size_t length = random() % 20;
    for (std::size_t i = 0; i < length; ++i) {
      text += pieces[random() % pieces.size()];
    }
    ASSERT_NO_FATAL_FAILURE(ExpectTableOrInputError(text)) << text;
    if (RefusalOf(text) == "read") ++tables;
  }
  EXPECT_GT(tables, kTrials / 20);  // the test sees both outcomes
}

// ---- Writing.

// The delimiter is what both lines have as many of.
TEST(ParseCsv, TakesCommasInNamesForNoDelimiter) {
  const CsvTable table = ParseCsv("t1, bed, front;error_mm\n20;0.001\n", "a");
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(table.columns[0].name, "t1, bed, front");
}

}  // namespace
}  // namespace errmap::data
