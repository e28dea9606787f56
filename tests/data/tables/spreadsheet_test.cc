#include "data/tables/text/spreadsheet.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/input_error.h"
#include "data/tables/text/gzip.h"
#include "data/tables/text/zip_archive.h"
#include "tests/data/packed_parts.h"
#include "tests/places.h"

namespace errmap::data {
namespace {

using errmap::testing::XlsxOf;
using errmap::testing::ZipOf;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr const char* kHeaderRow =
    R"(<row r="1"><c r="A1" t="s"><v>0</v></c><c r="B1" t="s"><v>1</v></c></row>)";

std::string TextOf(const std::string& rows, const std::string& more = "") {
  return SheetText(XlsxOf({{"Day 1", rows}}, more), "").value();
}

TEST(SheetText, HasALinePerRowAndTabsBetweenCells) {
  EXPECT_EQ(TextOf(std::string(kHeaderRow) +
                   R"(<row r="2"><c r="A2"><v>1.5</v></c>)"
                   R"(<c r="B2" s="4"><v>0.1</v></c></row>)"),
            "error_um\tposition_mm\n1.5\t0.1\n");
}

TEST(SheetText, LeavesCellsAndRowsThatAreNotThereEmpty) {
  EXPECT_EQ(TextOf(R"(<row r="2"><c r="C2"><v>3</v></c></row>)"
                   R"(<row r="4"><c r="A4"><v>1</v></c></row>)"),
            "\n\t\t3\n\n1\t\t\n");
}

TEST(SheetText, CountsRowsAndCellsWithoutPlaces) {
  EXPECT_EQ(TextOf("<row><c><v>1</v></c><c><v>2</v></c></row>"
                   "<row><c><v>3</v></c></row>"),
            "1\t2\n3\t\n");
}

TEST(SheetText, ShowsDatesAndTimesByTheFormatOfTheCell) {
  // 45351.5 is noon of 2024-02-29 where 25569 is 1970-01-01.
  EXPECT_EQ(TextOf(R"(<row><c s="1"><v>45351.5</v></c>)"
                   R"(<c s="2"><v>45351.5</v></c><c s="3"><v>0.25</v></c>)"
                   R"(<c s="2"><v>25569.000001</v></c><c s="1"><v>59</v></c>)"
                   R"(<c s="1"><v>61</v></c><c><v>45351.5</v></c></row>)"),
            "2024-02-29\t2024-02-29 12:00:00\t06:00:00\t"
            "1970-01-01 00:00:00.086\t1900-02-28\t1900-03-01\t45351.5\n");
}

TEST(SheetText, CountsDaysFrom1904WhereTheWorkbookDoes) {
  EXPECT_EQ(TextOf(R"(<row><c s="1"><v>43889</v></c></row>)",
                   R"(<workbookPr date1904="1"/>)"),
            "2024-02-29\n");
}

TEST(SheetText, TakesTextsFlagsAndErrorsAsTheyAreShown) {
  EXPECT_EQ(TextOf(R"(<row><c t="inlineStr"><is><t>a &lt; &#x3bc;</t></is></c>)"
                   R"(<c t="b"><v>1</v></c><c t="e"><v>#N/A</v></c>)"
                   R"(<c t="str"><f>A1</f><v>"x" )"
                   "\n"
                   R"(y</v></c></row>)"),
            "a < \xCE\xBC\tTRUE\t\"#N/A\"\t\"\"\"x\"\"  y\"\n");
}

TEST(SheetText, ReadsOtherPrefixesAndLiteralText) {
  EXPECT_EQ(TextOf("<x:row><x:c t=\"inlineStr\"><x:is><x:t><![CDATA[a&b]]>"
                   "</x:t></x:is></x:c></x:row><!-- <row/> -->"),
            "a&b\n");
}

TEST(SheetText, AsksWhichWhereSeveralSheetsHaveCells) {
  const std::string cell = "<row><c><v>1</v></c></row>";
  const std::string book =
      XlsxOf({{"Day 1", cell}, {"Empty", ""}, {"Day &amp; 2", cell}});
  EXPECT_THAT(
      [&] { SheetText(book, ""); },
      ThrowsMessage<InputError>(
          "has the sheets 'Day 1', 'Day & 2'; name one after a colon, or "
          "several as files: 'FILE.xlsx:Day 1'"));
  EXPECT_EQ(SheetText(book, "day & 2"), "1\n");
  EXPECT_THAT([&] { SheetText(book, "Day 3"); },
              ThrowsMessage<InputError>(
                  "has no sheet 'Day 3'; it has 'Day 1', 'Empty', 'Day & 2'"));
}

TEST(SheetText, RefusesAFormulaWithoutAValue) {
  EXPECT_THAT(
      [] { TextOf(R"(<row><c r="A1"><f>B1*2</f></c></row>)"); },
      ThrowsMessage<InputError>(HasSubstr("cell A1 has a formula without a")));
}

TEST(SheetText, RefusesWhatIsBeyondAnySheet) {
  for (const char* rows : {R"(<row r="1048577"><c><v>1</v></c></row>)",
                           R"(<row r="0"><c><v>1</v></c></row>)",
                           R"(<row><c r="ZZZZZZZZZZZZZ1"><v>1</v></c></row>)",
                           R"(<row><c t="s"><v>2</v></c></row>)",
                           "<row><c><v>1",
                           "<!DOCTYPE a [<!ENTITY b \"c\">]><row/>"}) {
    EXPECT_THROW(TextOf(rows), InputError) << rows;
  }
}

// Six thousand rows with a cell in the last column: a file of some kB whose
// table would be of a hundred million cells.
TEST(SheetText, RefusesATableOfEmptyCellsBeforeItTakesMemory) {
  std::string rows;
  for (int row = 1; row <= 6000; ++row) {
    rows += "<row r=\"" + std::to_string(row) + "\"><c r=\"XFD" +
            std::to_string(row) + "\"><v>1</v></c></row>";
  }
  EXPECT_THAT([&] { TextOf(rows); },
              ThrowsMessage<InputError>(
                  HasSubstr("has 6000 rows and 16384 columns, more than")));
  // A stray cell alone does no harm.
  const std::string text = TextOf(
      R"(<row r="1"><c r="A1"><v>1</v></c><c r="D1"><v>2</v></c></row>)"
      R"(<row r="2"><c r="B2"><v>4</v></c><c r="A2"><v>3</v></c></row>)");
  EXPECT_EQ(text, "1\t\t\t2\n3\t4\t\t\n");
}

TEST(SheetText, RefusesWhatUnpacksToHundredsOfTimesItsSize) {
  const std::string padding(std::size_t{80} << 20U, ' ');
  EXPECT_THAT([&] { TextOf("<row><c><v>1</v></c></row>" + padding); },
              ThrowsMessage<InputError>(HasSubstr("too long when unpacked")));
  EXPECT_THAT(
      [] {
        ParseCsv(Gzip("a,b\n" + std::string(80 << 20U, '\n')), "x.csv.gz");
      },
      ThrowsMessage<InputError>(HasSubstr("too long when unpacked")));
}

TEST(SheetText, KnowsNoCharactersByNamesOfTheFilesOwn) {
  EXPECT_EQ(TextOf("<row><c><v>&unknown;</v></c></row>"), "&unknown;\n");
}

TEST(SheetText, LeavesOtherFilesAlone) {
  EXPECT_FALSE(SheetText("error_um\n1\n", "").has_value());
  EXPECT_FALSE(SheetText(ZipOf({{"mimetype", "x"}}), "").has_value());
}

TEST(SheetText, EveryTruncationAndFlippedByteIsOneLine) {
  const std::string book = XlsxOf(
      {{"Day 1", std::string(kHeaderRow) + "<row><c><v>1</v></c></row>"}});
  const auto read = [](const std::string& bytes) {
    try {
      ParseCsv(bytes, "book.xlsx");
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("book.xlsx: "));
    }
  };
  for (std::size_t i = 0; i < book.size(); ++i) {
    read(book.substr(0, i));
    std::string flipped = book;
    flipped[i] = static_cast<char>(flipped[i] ^ 0x55);
    read(flipped);
  }
}

TEST(ZipArchive, RefusesMoreThanWasAskedFor) {
  const std::string bytes = ZipOf({{"a", std::string(100'000, 'x')}});
  const ZipArchive archive(bytes);
  EXPECT_LT(bytes.size(), 1'000U);
  EXPECT_THAT([&] { archive.Read("a", 50'000); },
              ThrowsMessage<InputError>("is too long when unpacked"));
  EXPECT_EQ(archive.Read("a", 100'000).size(), 100'000U);
}

TEST(ReadCsvOfASpreadsheet, SaysPlacesAsTheSheetHasThem) {
  const CsvTable table = ParseCsv(
      XlsxOf({{"Day 1",
               std::string(kHeaderRow) +
                   R"(<row r="2"><c><v>1</v></c><c><v>2</v></c></row>)"
                   R"(<row r="3"><c t="inlineStr"><is><t>1,5</t></is></c>)"
                   R"(<c><v>23.100000000000001</v></c></row>)"}}),
      "book.xlsx:Day 1");
  ASSERT_EQ(table.num_rows, 2U);
  EXPECT_EQ(table.columns[0].values[1], 1.5);  // typed as text
  EXPECT_EQ(table.columns[1].values[1], 23.1);
  EXPECT_THAT(table.Where(1, "error_um"),
              AllOf(HasSubstr("book.xlsx:Day 1: line 3 "),
                    HasSubstr("column 'error_um'")));
}

TEST(ReadCsvOfASpreadsheet, ReadsWhatOtherProgramsWrote) {
  const std::string corpus = tests::SourceDir() + "/tests/fuzz/corpus/csv/";
  const CsvTable ours =
      ReadCsv(tests::SourceDir() + "/data/sets/nistir5367_xdisp_down.csv");
  const CsvTable theirs = ReadCsv(corpus + "openpyxl.xlsx:X down");
  ASSERT_EQ(theirs.num_rows, ours.num_rows);
  ASSERT_EQ(theirs.columns.size(), ours.columns.size());
  for (std::size_t i = 0; i < ours.columns.size(); ++i) {
    EXPECT_EQ(theirs.columns[i].name, ours.columns[i].name);
    for (std::size_t row = 0; row < ours.num_rows; ++row) {
      ASSERT_EQ(theirs.columns[i].values[row], ours.columns[i].values[row]);
    }
  }
  const CsvTable dated = ReadCsv(corpus + "xlsxwriter.xlsx");
  ASSERT_EQ(dated.num_rows, 60U);
  EXPECT_EQ(dated.At(dated.Find("time")).texts.front(), "2024-02-28 22:00:00");
  EXPECT_EQ(dated.At(dated.Find("time")).texts.back(),
            "2024-02-29 02:55:14.750");
  EXPECT_EQ(dated.At(dated.Find("day")).texts.back(), "2024-02-29");
  EXPECT_EQ(dated.At(dated.Find("sum")).values[59], 147.5);
}

}  // namespace
}  // namespace errmap::data
