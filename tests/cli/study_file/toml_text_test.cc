#include "cli/study_file/toml_text.h"

#include <gtest/gtest.h>

namespace errmap::cli {
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

}  // namespace
}  // namespace errmap::cli
