#include "cli/report/documents/report_html.h"

#include <chrono>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/report.h"
#include "cli/report/tables/report_tables.h"
#include "tests/cli/report/report_document.h"

namespace errmap::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string Write(const Json& document) {
  const models::StudyRecord record = Recorded(document);
  return ReportHtml(record, MakeFigures(record));
}

std::size_t CountOf(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos;
       at = text.find(word, at + word.size())) {
    ++count;
  }
  return count;
}

// What is shown: the text without tags and style.
std::string VisibleText(const std::string& html) {
  const std::size_t body = html.find("<body>");
  std::string text;
  bool inside = false;
  for (std::size_t i = body; i < html.size(); ++i) {
    if (html[i] == '<') inside = true;
    if (!inside) text += html[i];
    if (html[i] == '>') {
      inside = false;
      text += ' ';
    }
  }
  return text;
}

void ExpectNoHoles(const std::string& html) {
  const std::string text = VisibleText(html);
  for (const char* word : {"nan", "NaN", "null", "inf"}) {
    EXPECT_FALSE(std::regex_search(
        text,
        std::regex(std::string("(^|[^a-zA-Z])") + word + "($|[^a-zA-Z])")))
        << word;
  }
  EXPECT_EQ(html.find("<figure></figure>"), std::string::npos);
  EXPECT_EQ(html.find("<tbody>\n</tbody>"), std::string::npos);
}

TEST(ReportHtml, OpensWithTheAnswer) {
  const std::string html = Write(MakeReportDocument());
  const std::string text = VisibleText(html);
  for (const char* words : {"Use poly:eq8.",
                            "1.900 µm",
                            "(95\u00a0%: 1.520 to 2.470)",
                            "not reached",
                            "errmap check map.json NEW_READINGS.csv",
                            "the compensation is minus the predicted error",
                            "Cost: 1 sensor (t12_degC); ",
                            "Not converged: its fit ended by "}) {
    EXPECT_THAT(text, HasSubstr(words));
  }
  EXPECT_LT(text.find("Use poly:eq8"), text.find("What was measured"));
}

TEST(ReportHtml, OrdersTheModelsByUnseenError) {
  const models::StudyRecord record = Recorded(MakeReportDocument());
  const Table table = PageLeaderboard(ViewOf(record.components[0]));
  const auto shown = [&](std::size_t row, std::size_t column) {
    return table.Shown(table.rows[row][column]);
  };
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(shown(0, 0), "mean");
  EXPECT_EQ(shown(1, 0), "poly:eq8");
  EXPECT_EQ(table.marked, 1U);
  EXPECT_EQ(shown(1, 1), "1.900 (1.520 to 2.470)");
}

TEST(ReportHtml, TurnsADifferenceTheWayItIsRead) {
  Json document = MakeReportDocument();
  Json& component = document["components"][0];
  const auto difference = [&] {
    const models::StudyRecord record = Recorded(document);
    const Table table =
        ComparisonTable(ViewOf(record.components[0]), "groups:5");
    return table.Shown(table.rows.at(0).at(1));
  };
  const std::string expected = difference();
  EXPECT_EQ(expected, "1.900 (0.950 to 2.850)");
  Json& pair = component["comparisons"][0];
  std::swap(pair["a"], pair["b"]);
  std::swap(pair["rmse_a"], pair["rmse_b"]);
  pair["difference"] = -pair["difference"].get<double>();
  pair["ci95"] = {-pair["ci95"][1].get<double>(),
                  -pair["ci95"][0].get<double>()};
  EXPECT_EQ(difference(), expected);
}

TEST(ReportHtml, HasNoScriptNoLinkOutAndNoHole) {
  const std::string html = Write(MakeReportDocument());
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("http://")));
  EXPECT_THAT(html, Not(HasSubstr("https://")));
  EXPECT_THAT(html, Not(HasSubstr("url(")));
  ExpectNoHoles(html);
}

TEST(ReportHtml, LeavesOutWhatIsMissingAndHasNoHoles) {
  Json bare = MakeReportDocument();
  Json& component = bare["components"][0];
  for (const char* key : {"figures",
                          "gap",
                          "comparisons",
                          "tiers",
                          "verdict",
                          "recommendation",
                          "display",
                          "goal",
                          "stability"}) {
    component.erase(key);
  }
  for (Json& model : component["models"]) {
    for (const char* key : {"final",
                            "regression",
                            "sensors",
                            "inputs_used",
                            "predict_ns",
                            "parameters"}) {
      model[key] = nullptr;
    }
  }
  const std::string html = Write(bare);
  EXPECT_THAT(html, HasSubstr("No map can be recommended"));
  EXPECT_THAT(html, Not(HasSubstr("were not tested")));
  EXPECT_THAT(html, Not(HasSubstr("were not kept")));
  EXPECT_THAT(html, Not(HasSubstr("class=\"absent\"")));
  ExpectNoHoles(html);
}

TEST(ReportHtml, ReportsARunInWhichEverythingFailed) {
  Json document = MakeReportDocument();
  Json& component = document["components"][0];
  component["recommendation"] = nullptr;
  for (Json& model : component["models"]) {
    model["status"] = "failed";
    model["why"] = "too few rows";
    model["results"] = Json::object();
    model["final"] = nullptr;
  }
  document["interrupted"] = true;
  const std::string html = Write(document);
  EXPECT_THAT(html, HasSubstr("The run was interrupted"));
  EXPECT_THAT(html, HasSubstr("too few rows"));
  ExpectNoHoles(html);
}

TEST(ReportHtml, NeverThrowsOnADocumentOfAnotherShape) {
  for (const Json& odd :
       {Json(),
        Json(3),
        Json::array({1, 2}),
        Json::object(),
        Json{{"components", 5}},
        Json{{"components", {1, "x", nullptr}}},
        Json{{"components", {{{"models", "x"}, {"holdouts", 3}}}}}}) {
    EXPECT_THAT(Write(odd), HasSubstr("</html>")) << odd;
    EXPECT_THAT(ReportMarkdown(Recorded(odd)), HasSubstr("# Error maps"))
        << odd;
  }
}

TEST(ReportHtml, ShowsHostileNamesAsText) {
  for (const std::string& name : HostileNames()) {
    DocumentSpec spec;
    spec.name = name;
    spec.file = name;
    spec.position = "position" + name;
    spec.temperature = name;
    spec.group = name;
    spec.group_prefix = name;
    spec.target = name;
    spec.unit = name;
    spec.models = {"mean", "poly:" + name, "net:" + name};
    // As it would come out of the file.
    const Json document = Json::parse(FileText(MakeReportDocument(spec)));
    const std::string html = Write(document);
    EXPECT_THAT(html, Not(HasSubstr("<script"))) << name;
    EXPECT_THAT(html, Not(HasSubstr("<img"))) << name;
    EXPECT_THAT(html, Not(HasSubstr("\" onload"))) << name;
    EXPECT_EQ(CountOf(html, "</title>"), CountOf(html, "<title")) << name;
    const std::string text = ReportMarkdown(Recorded(document));
    EXPECT_FALSE(std::regex_search(text, std::regex("(^|[^\\\\])<"))) << name;
  }
}

// As large as a component's study commonly is.
DocumentSpec OfTwelveModels() {
  DocumentSpec spec;
  spec.rows = 600;
  spec.groups = 35;
  spec.models = {"zero",
                 "mean",
                 "poly:position",
                 "poly:eq7",
                 "poly:eq8",
                 "poly:eq9",
                 "poly:full",
                 "poly:stepwise",
                 "poly:ridge",
                 "net:scg",
                 "net:lm",
                 "blend"};
  return spec;
}

TEST(ReportHtml, OfTwelveModelsAndSixHundredRowsIsSmallAndQuick) {
  const DocumentSpec spec = OfTwelveModels();
  const Json document = MakeReportDocument(spec);
  const auto start = std::chrono::steady_clock::now();
  const std::string html = Write(document);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
  constexpr std::size_t kMostBytes = 1'500'000;
  EXPECT_LT(html.size(), kMostBytes);
  // Three seconds on a quiet machine; a test machine may be busy.
  constexpr double kMostSeconds = 12.0;
  EXPECT_LT(seconds, kMostSeconds);
  RecordProperty("seconds", std::to_string(seconds));
  RecordProperty("bytes", std::to_string(html.size()));
}

TEST(ReportHtml, OfManyComponentsBeginsWithAnIndexAndFoldsTheRest) {
  DocumentSpec spec;
  spec.components = 100;
  const std::string html = Write(MakeReportDocument(spec));
  EXPECT_EQ(CountOf(html, "<details class=\"component\">"), 100U);
  EXPECT_THAT(html, HasSubstr("<a href=\"#c100\">"));
  EXPECT_THAT(html, HasSubstr("id=\"c100\""));
  EXPECT_LT(html.find("<nav"), html.find("<details"));
  // Of each its error with interval, and how it does on one unit after another.
  EXPECT_EQ(CountOf(html, ">1.900 µm</td><td class=\"t\">1.520-2.470</td>"),
            100U);
  EXPECT_EQ(CountOf(html, "aria-label=\"RMSE by cycle: "), 100U);
  constexpr std::size_t kMostBytes = 5'000'000;
  EXPECT_LT(html.size(), kMostBytes);
}

TEST(ReportHtml, OfSixComponentsIsBelowTwoMegabytes) {
  DocumentSpec spec = OfTwelveModels();
  spec.components = 6;
  constexpr std::size_t kMostBytes = 2'000'000;
  EXPECT_LT(Write(MakeReportDocument(spec)).size(), kMostBytes);
}

TEST(ReportHtml, HasOneUnitOfLengthOnly) {
  Json document = MakeReportDocument();
  // With these its words can be written anew.
  document["components"][0]["tiers"] = {
      {"groups:5", {{"poly:eq8"}, {"net:scg"}, {"mean"}}}};
  const std::string text = VisibleText(Write(document));
  EXPECT_THAT(text, HasSubstr("0.5\u00a0µm: not reached"));
  EXPECT_FALSE(std::regex_search(text, std::regex("[0-9] um")));
}

TEST(ReportHtml, IsTheSameForTheSameDocument) {
  const Json document = MakeReportDocument();
  EXPECT_EQ(Write(document), Write(Json::parse(FileText(document))));
}

TEST(ReportMarkdown, HoldsTheAnswerAndTheTables) {
  const std::string text = ReportMarkdown(Recorded(MakeReportDocument()));
  EXPECT_THAT(text, HasSubstr("**Use poly:eq8.**"));
  EXPECT_THAT(text, HasSubstr("| **poly:eq8** |"));
  EXPECT_THAT(text, HasSubstr("### Every model"));
  EXPECT_THAT(text, HasSubstr("1.900 um"));
  EXPECT_THAT(text, Not(HasSubstr("µm")));
  EXPECT_THAT(text, HasSubstr("## Provenance"));
}

}  // namespace
}  // namespace errmap::report
