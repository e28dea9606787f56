#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/shell/help_text.h"

namespace errmap::cli {
namespace {

using ::testing::Contains;

std::string Shown(const char* page, std::size_t width = 30) {
  return TopicText({.name = "page", .page = page}, width);
}

TEST(Topics, AreThePagesOfTheManual) {
  EXPECT_THAT(TopicNames(), Contains("tutorial"));
  EXPECT_THAT(TopicNames(), Contains("words"));
  for (const Topic& topic : Topics()) {
    EXPECT_TRUE(topic.page.starts_with("# ")) << topic.name;
    EXPECT_FALSE(TitleOf(topic).empty()) << topic.name;
  }
}

TEST(TopicText, WrapsParagraphsAndItemsAndUnderlinesHeadings) {
  EXPECT_EQ(Shown("# A title\n\nOne line\nand another that is long.\n\n"
                  "- an item that goes on and on\n  and on\n- another\n"),
            "A title\n=======\n\nOne line and another that is\nlong.\n\n"
            "- an item that goes on and on\n  and on\n- another\n");
}

TEST(TopicText, KeepsCodeAsItIsDropsMarksAndNamesPictures) {
  EXPECT_EQ(Shown("## Run [it](run.md)\n\n![A map](map.svg)\n\n"
                  "Say `fit` and **wait**.\n\n"
                  "<!-- For the test. -->\n\n```sh\na `b` [c](d)\n\ne\n```\n"),
            "Run it\n------\n\n[Picture: A map]\n\nSay fit and wait.\n\n    a "
            "`b` [c](d)\n\n"
            "    e\n");
}

TEST(TopicText, ShowsTablesWithoutTheirRule) {
  EXPECT_EQ(Shown("| a | b |\n|---|---|\n| `1` | 2 |\n"),
            "| a | b |\n| 1 | 2 |\n");
}

}  // namespace
}  // namespace errmap::cli
