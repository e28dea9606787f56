#include "cli/report/html.h"

#include <gtest/gtest.h>

#include "tests/cli/report/report_document.h"

namespace errmap::report {
namespace {

TEST(HtmlText, EscapesWhatHasAMeaningInTextAndAttributes) {
  EXPECT_EQ(HtmlText("a < b & c > \"d\" 'e'"),
            "a &lt; b &amp; c &gt; &quot;d&quot; &#39;e&#39;");
}

TEST(HtmlText, TurnsControlCharactersIntoBlanks) {
  EXPECT_EQ(HtmlText(std::string("a\nb\tc\0d\x7f", 8)), "a b c d ");
}

TEST(HtmlText, IsAlwaysUtf8) {
  EXPECT_EQ(HtmlText("\xb5m"), "\xc2\xb5m");
  EXPECT_EQ(HtmlText("µm"), "µm");
}

TEST(HtmlText, KeepsEmptyTextEmpty) { EXPECT_EQ(HtmlText(""), ""); }

TEST(HtmlSentence, KeepsAFigureAndItsUnitInOneLine) {
  EXPECT_EQ(HtmlSentence("5 µm (95 % 4 to 6) on 6 days, a % of 20 °C"),
            "5\u00a0µm (95\u00a0% 4 to 6) on 6 days, a % of 20\u00a0°C");
}

TEST(HtmlName, KeepsANameFromTurningTheTextAroundIt) {
  EXPECT_EQ(HtmlName("\u202e<b>"), "<bdi>\u202e&lt;b&gt;</bdi>");
}

TEST(MarkdownText, LeavesNoHostileNameAMeaning) {
  for (const std::string& name : HostileNames()) {
    const std::string text = MarkdownText(name);
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '<' || text[i] == '`' || text[i] == '|') {
        ASSERT_GT(i, 0U);
        EXPECT_EQ(text[i - 1], '\\') << text;
      }
    }
  }
}

}  // namespace
}  // namespace errmap::report
