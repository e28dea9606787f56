#include "data/formats/pattern_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/input_error.h"

namespace errmap::data {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Two patterns of a position and ten thermocouples: 3 + 6 + 1.
constexpr const char* kStacked =
    "         2        11         1   1.000000\n"
    " POSITION  DIFF         0         1         2\n"
    "         1   -12.7000  -1.1631000E-03   22.58143   22.58286\n"
    "   22.61200\n"
    "         2   -25.4000  -3.2432000E-03   22.58286   22.58571\n"
    "   22.61400\n"
    "          3          4          5          6          7         16\n"
    "    0.00000    0.00000   22.06370   22.24411   22.37697   22.37017\n"
    "    0.00000    0.00000   22.06840   22.26209   22.40413   22.41098\n"
    "         39\n"
    "   22.36981\n"
    "   22.39948\n";

TEST(PatternFile, ReadsTheStackedFormOfTable2) {
  const PatternTable table = ParsePatterns(kStacked, "x.pat");
  EXPECT_EQ(table.scale, 1.0);
  ASSERT_EQ(table.inputs.size(), 11U);
  EXPECT_EQ(table.inputs.front(), "position_mm");
  EXPECT_EQ(table.inputs[9], "t16_degC");
  EXPECT_EQ(table.inputs.back(), "t39_degC");
  EXPECT_THAT(table.targets, ElementsAre("error_mm"));
  EXPECT_THAT(table.index, ElementsAre(1, 2));
  EXPECT_EQ(table.input_values(1, 0), -25.4);
  EXPECT_EQ(table.input_values(0, 3), 22.612);
  EXPECT_EQ(table.input_values(1, 9), 22.41098);
  EXPECT_EQ(table.input_values(1, 10), 22.39948);
  EXPECT_EQ(table.target_values(0, 0), -1.1631e-3);
}

TEST(PatternFile, KeepsEveryByteOnTheWayThroughCsv) {
  const std::string csv =
      PatternText(ParsePatterns(kStacked, "x.pat"), PatternForm::kCsv);
  EXPECT_THAT(csv,
              HasSubstr("# patterns for errmap netcg: targets 1, scale "
                        "1.000000\nindex,position_mm,t00_degC,"));
  EXPECT_EQ(PatternText(ParsePatterns(csv, "x.csv"), PatternForm::kStacked),
            kStacked);
  const std::string plain = "2 2 2 0.001\nx y1 z1 z2\n1 2.5 3 4\n1e-07 2 3 5\n";
  const std::string plain_csv =
      PatternText(ParsePatterns(plain, "x.tab"), PatternForm::kCsv);
  EXPECT_EQ(PatternText(ParsePatterns(plain_csv, "x.csv"), PatternForm::kPlain),
            "2 2 2 0.001000\nx y1 z1 z2\n1 2.5 3 4\n1e-07 2 3 5\n");
}

TEST(PatternFile, KeepsDigitsThatTheColumnsHaveNoRoomFor) {
  PatternTable table = ParsePatterns(kStacked, "x.pat");
  table.input_values(0, 1) = 22.123456789;
  table.target_values(1, 0) = 1.0 / 3.0;
  const PatternTable again =
      ParsePatterns(PatternText(table, PatternForm::kStacked), "x.pat");
  EXPECT_EQ(again.input_values, table.input_values);
  EXPECT_EQ(again.target_values, table.target_values);
}

TEST(PatternFile, TakesOtherCsvFilesAsCompareDoesWithThePositionFirst) {
  const PatternTable table = ParsePatterns(
      "record,day,t01_degC,t02_degC,position_mm,error_mm,time_s\n"
      "1,1,20.5,0,-12.7,0.001,5\n2,1,20.6,0,-25.4,0.002,10\n",
      "x.csv");
  EXPECT_THAT(table.inputs, ElementsAre("position_mm", "t01_degC", "t02_degC"));
  EXPECT_THAT(table.targets, ElementsAre("error_mm"));
  EXPECT_EQ(table.input_values(1, 0), -25.4);
}

void ExpectRefusal(const std::string& text,
                   const std::string& name,
                   const std::string& message) {
  EXPECT_THAT([&] { ParsePatterns(text, name); },
              ThrowsMessage<InputError>(HasSubstr(message)));
}

std::string Without(std::string text, const std::string& part) {
  text.erase(text.find(part), part.size());
  return text;
}

// Names of all columns come before their values: it took all memory.
TEST(PatternFile, RefusesMoreOutputsThanTheFileCanHold) {
  for (const char* name : {"x.pat", "x.tab"}) {
    EXPECT_THAT(
        [&] { ParsePatterns("12 3 299999999999 1.0\nx1 y1\n1 2\n", name); },
        ThrowsMessage<InputError>(
            HasSubstr("found more outputs than the file has characters")));
  }
}

TEST(PatternFile, NamesFileLineAndWhatWasExpected) {
  const std::string good = kStacked;
  ExpectRefusal("x\n", "x.pat", "x.pat: line 1: expected numbers of patterns");
  ExpectRefusal("0 11 1 1.0\n", "x.pat", "line 1: expected numbers of");
  ExpectRefusal("2 11 1\n", "x.pat", "line 2: expected numbers of patterns");
  // A block that is a row short is seen at the next line of numbers.
  ExpectRefusal(Without(good,
                        "    0.00000    0.00000   22.06840   22.26209   "
                        "22.40413   22.41098\n"),
                "x.pat",
                "line 12: expected 6 numbers in row 2 of 2 of block 2 from "
                "line 9 on, but the file ends");
  ExpectRefusal(
      Without(good, "   22.39948\n"), "x.pat", "line 12: expected 1 number ");
  ExpectRefusal(good + "   1.0\n", "x.pat", "line 13: expected the end");
  std::string bad = good;
  bad.replace(bad.find("22.61400"), 8, "x2.61400");
  ExpectRefusal(bad, "x.pat", "line 6: expected 6 numbers in row 2 of 2");
  ExpectRefusal("2 1 1 1\na b\n1 2\n", "x.tab", "x.tab: line 4: expected 2");
  ExpectRefusal("2 1 1 1\na b\n1 2\n1 2 3\n", "x.tab", "one more number: '3'");
  // Nothing is asked for that the text cannot hold.
  ExpectRefusal("999999999 999999999 1 1\n", "x.pat", "line 2: expected");
}

}  // namespace
}  // namespace errmap::data
