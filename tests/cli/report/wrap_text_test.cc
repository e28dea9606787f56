#include "cli/report/wrap_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/shell_word.h"

namespace errmap::report {
namespace {

using ::testing::ElementsAre;

TEST(WrapLines, BreaksAtBlanksAndLongWordsAnywhere) {
  EXPECT_THAT(WrapLines("one two  three", 7), ElementsAre("one two", "three"));
  EXPECT_THAT(WrapLines("a abcdefgh b", 4),
              ElementsAre("a", "abcd", "efgh", "b"));
  EXPECT_THAT(WrapLines("a abcdefgh b", 4, LongWords::kWhole),
              ElementsAre("a", "abcdefgh", "b"));
  EXPECT_THAT(WrapLines("", 7), ElementsAre());
  EXPECT_THAT(WrapLines("ab c", 0), ElementsAre("a", "b", "c"));
}

TEST(WrapLines, KeepsANumberAndItsUnitTogether) {
  EXPECT_THAT(WrapLines("it removes 92 % of 11.4 um.", 13),
              ElementsAre("it removes", "92 % of", "11.4 um."));
  EXPECT_THAT(WrapLines("10 cycles", 5), ElementsAre("10", "cycle", "s"));
  EXPECT_THAT(WrapLines("11.481 um", 5), ElementsAre("11.48", "1 um"));
}

TEST(WrapLines, CountsCharactersNotBytes) {
  EXPECT_THAT(WrapLines("µµ µµ", 5), ElementsAre("µµ µµ"));
  EXPECT_THAT(WrapLines("µµµµ", 2), ElementsAre("µµ", "µµ"));
}

TEST(Squeezed, TakesFromTheMiddle) {
  EXPECT_EQ(Squeezed("poly:full:degree=3", 11), "poly...ee=3");
  EXPECT_EQ(Squeezed("mean", 4), "mean");
}

TEST(ShellWord, IsReadBackByAShell) {
  EXPECT_EQ(ShellWord("--x=1"), "--x=1");
  EXPECT_EQ(ShellWord("b c"), "'b c'");
  EXPECT_EQ(ShellWord("d'e"), "'d'\\''e'");
  EXPECT_EQ(ShellWord(""), "''");
}

TEST(ShellCommand, GoesOnInTheNextLine) {
  EXPECT_EQ(ShellCommand({"errmap", "fit", "a b.csv", "-o", "map.json"}, 22, 2),
            "errmap fit \\\n      'a b.csv' \\\n      -o map.json");
}

TEST(ShellCommand, KeepsAnOptionAndItsValueOnOneLine) {
  EXPECT_EQ(ShellCommand({"errmap", "fit", "--model", "blend"}, 24, 2),
            "errmap fit \\\n      --model blend");
  EXPECT_EQ(
      ShellCommand({"errmap", "--model", "of-many-characters-alone"}, 24, 2),
      "errmap --model \\\n    of-many-characters-alone");
}

}  // namespace
}  // namespace errmap::report
