#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/formula_text.h"

// What is written as CSV, and comes back.

namespace errmap::data {
namespace {

TEST(CsvField, TurnsFormulasOfSpreadsheetsIntoText) {
  EXPECT_EQ(CsvField("=1+1"), "'=1+1");
  EXPECT_EQ(CsvField("@SUM(A1,B1)"), "\"'@SUM(A1,B1)\"");
  EXPECT_EQ(CsvField("+cmd"), "'+cmd");
  EXPECT_EQ(CsvField("-down"), "'-down");
  // Numbers are what they are.
  EXPECT_EQ(CsvField("-1.5"), "-1.5");
  EXPECT_EQ(CsvField("+2e3"), "+2e3");
  EXPECT_EQ(CsvField("-"), "-");
  // Else it would be taken for ours.
  EXPECT_EQ(CsvField("'=1+1"), "''=1+1");
  EXPECT_EQ(CsvField("'down'"), "'down'");
}

std::string CsvOf(const std::vector<std::string>& texts) {
  std::string csv = "row,label\n";
  for (const std::string& text : texts) csv += "1," + CsvField(text) + "\n";
  return MarkedCsv(csv);
}

TEST(FormulaText, ComesBackFromFilesThatCarryTheMark) {
  const std::vector<std::string> texts = {
      "=1+1", "'=1+1", "@a,b", "-down", "'quoted'", "plain", "+x \"y\""};
  const CsvTable table = ParseCsv(CsvOf(texts), "a.csv");
  for (std::size_t row = 0; row < texts.size(); ++row) {
    EXPECT_EQ(table.CellText(table.columns[1], row), texts[row]);
  }
  EXPECT_EQ(ParseCsv(MarkedCsv(CsvField("=a") + ",b\n1,2\n"), "a.csv")
                .columns[0]
                .name,
            "=a");
}

TEST(FormulaText, LeavesOtherFilesAsTheyAre) {
  EXPECT_EQ(CsvOf({"plain", "'quoted'", "-1.5"}),
            "row,label\n1,plain\n1,'quoted'\n1,-1.5\n");
  const CsvTable table = ParseCsv("row,label\n1,'=1+1\n", "a.csv");
  EXPECT_EQ(table.CellText(table.columns[1], 0), "'=1+1");
}

TEST(CsvField, QuotesOnlyWhatNeedsQuotes) {
  EXPECT_EQ(CsvField("plain text_1"), "plain text_1");
  EXPECT_EQ(CsvField(""), "");
  EXPECT_EQ(CsvField("a,b"), "\"a,b\"");
  EXPECT_EQ(CsvField("a;b"), "\"a;b\"");
  EXPECT_EQ(CsvField("a\tb"), "\"a\tb\"");
  EXPECT_EQ(CsvField("a\nb"), "\"a\nb\"");
  EXPECT_EQ(CsvField("a\rb"), "\"a\rb\"");
  EXPECT_EQ(CsvField("say \"x\""), "\"say \"\"x\"\"\"");
  EXPECT_EQ(CsvField(" a"), "\" a\"");
  EXPECT_EQ(CsvField("a "), "\"a \"");
  EXPECT_EQ(CsvField("#1"), "\"#1\"");
  EXPECT_EQ(CsvField("n#1"), "n#1");
}

TEST(CsvField, ReadsBackTheSame) {
  for (const std::string name : {"a,b", "x\"y", "p\r\nq", "#1", "m;n"}) {
    const CsvTable table = ParseCsv(CsvField(name) + "," + "z\n1,2\n", "f.csv");
    EXPECT_EQ(table.columns[0].name, name);
  }
}

TEST(CsvNumber, WritesTheShortestTextThatReadsBack) {
  EXPECT_EQ(CsvNumber(0.1), "0.1");
  EXPECT_EQ(CsvNumber(3.0), "3");
  EXPECT_EQ(CsvNumber(-1.5e-7), "-1.5e-07");
  EXPECT_EQ(CsvNumber(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(CsvNumber(-std::numeric_limits<double>::min()),
            "-2.2250738585072014e-308");
}

}  // namespace
}  // namespace errmap::data
