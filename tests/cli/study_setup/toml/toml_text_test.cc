#include "cli/study_setup/toml/toml_text.h"

#include <string>

#include <gtest/gtest.h>

#include "cli/study_setup/toml/toml_keys.h"
#include "data/input_error.h"

namespace errmap::study_setup {
namespace {

TEST(TomlText, EscapesWhatWouldEndOrBreakTheString) {
  EXPECT_EQ(TomlText(""), "\"\"");
  EXPECT_EQ(TomlText("a\"b\\c"), "\"a\\\"b\\\\c\"");
  EXPECT_EQ(TomlText("a\nb\x7F"), "\"a\\u000Ab\\u007F\"");
  EXPECT_EQ(TomlText("\xC2\xB5m"), "\"\xC2\xB5m\"");
}

TEST(TomlText, QuotesKeysThatAreNotBare) {
  EXPECT_EQ(TomlKey("t12_degC"), "t12_degC");
  EXPECT_EQ(TomlKey("x, down"), "\"x, down\"");
  EXPECT_EQ(TomlKey(""), "\"\"");
}

TEST(TomlText, GivesEachItemOfALongListALine) {
  EXPECT_EQ(TomlList({}), "[]");
  EXPECT_EQ(TomlList({"a", "b"}), "[\"a\", \"b\"]");
  const std::string item(40, 'x');
  EXPECT_EQ(TomlList({item, item}),
            "[\n  \"" + item + "\",\n  \"" + item + "\",\n]");
}

TEST(TomlText, FindsKeysOfTooManyPartsOutsideOfStringsAndComments) {
  std::string parts = "a";
  for (std::size_t i = 1; i < kMostKeyParts; ++i) parts += ".a";
  EXPECT_EQ(LineOfLongKey(parts + " = 1"), 0U);
  const std::string longer = parts + ".a";
  EXPECT_EQ(LineOfLongKey(longer + " = 1"), 1U);
  EXPECT_EQ(LineOfLongKey("x = 1.5\n\n[" + longer + "]"), 3U);
  EXPECT_EQ(LineOfLongKey("x = {" + longer + " = 1}"), 1U);
  EXPECT_EQ(LineOfLongKey("x = \"" + longer + "\""), 0U);
  EXPECT_EQ(LineOfLongKey("x = '" + longer + "' # " + longer), 0U);
  EXPECT_EQ(LineOfLongKey("x = \"\"\"\n" + longer + "\n\"\"\""), 0U);
  EXPECT_EQ(LineOfLongKey("x = \"\\\"\"\n" + longer + " = 1"), 2U);
  // A string that never ends does not hide what follows its line.
  EXPECT_EQ(LineOfLongKey("x = \"\n" + longer + " = 1"), 2U);
}

// Found by the fuzzer: the parser held some of these for impossible.
TEST(ParseToml, RefusesLettersBeyondAsciiOutsideOfQuotes) {
  for (const std::string text : {"x = 1\ny = \u07c7",
                                 "gr\u00f6sse = 1",
                                 "x = 1'\u0492",
                                 "x = true.'\u2c60'",
                                 "x = 1 \u00a7"}) {
    EXPECT_THROW(ParseToml(text, "study.toml"), data::InputError) << text;
  }
}

TEST(ParseToml, ReadsLettersBeyondAsciiInQuotes) {
  const toml::table table = ParseToml(
      "\"gr\u00f6sse\" = '\u00b5m' # \u00b5\n"
      "text = \"\"\"a\\\n  \u00a7\"\"\"",
      "study.toml");
  EXPECT_EQ(table["gr\u00f6sse"].value_or(std::string()), "\u00b5m");
  EXPECT_EQ(table["text"].value_or(std::string()), "a\u00a7");
}

}  // namespace
}  // namespace errmap::study_setup
