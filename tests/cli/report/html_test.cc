#include "cli/report/html.h"

#include <gtest/gtest.h>

#include "cli/report/json_access.h"
#include "tests/cli/report_document.h"

namespace errmap::cli {
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

TEST(JsonAccess, ReadsNothingFromWhatIsMissingOrOfAnotherType) {
  const Json json = {{"a", {{"b", 2.5}}}, {"text", "x"}, {"none", nullptr}};
  EXPECT_DOUBLE_EQ(NumberOf(At(json, {"a", "b"})), 2.5);
  EXPECT_TRUE(std::isnan(NumberOf(At(json, {"a", "c", "d"}))));
  EXPECT_TRUE(std::isnan(NumberAt(json, "text")));
  EXPECT_EQ(TextAt(json, "none"), "");
  EXPECT_EQ(TextAt(json, "text"), "x");
  EXPECT_TRUE(At(json, std::size_t{0}).is_null());
  EXPECT_FALSE(IsTrue(json, "text"));
  EXPECT_TRUE(NumbersOf(At(json, "a")).empty());
}

TEST(JsonAccess, ReadsInfiniteNumbersAsNothing) {
  EXPECT_TRUE(std::isnan(NumberOf(Json(HUGE_VAL))));
  const std::vector<double> numbers = NumbersOf(Json{1.0, nullptr, "x"});
  ASSERT_EQ(numbers.size(), 3U);
  EXPECT_DOUBLE_EQ(numbers[0], 1.0);
  EXPECT_TRUE(std::isnan(numbers[1]));
  EXPECT_TRUE(std::isnan(numbers[2]));
}

TEST(JsonAccess, FindsAnEntryByItsName) {
  const Json list =
      Json::array({{{"name", "a"}}, 3, {{"name", "b"}, {"v", 1}}});
  EXPECT_DOUBLE_EQ(NumberAt(Find(list, "name", "b"), "v"), 1.0);
  EXPECT_TRUE(Find(list, "name", "c").is_null());
  EXPECT_TRUE(Find(Json(), "name", "c").is_null());
}

}  // namespace
}  // namespace errmap::cli
