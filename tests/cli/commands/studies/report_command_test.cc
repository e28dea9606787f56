#include <set>

#include <sys/resource.h>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/report/report_document.h"

namespace errmap {
namespace {

using ::testing::HasSubstr;

class ReportCommand : public Cli {
 protected:
  void WriteStudy(const Json& document) const {
    std::filesystem::create_directory(scratch_ / "study");
    Write("study/results.json", FileText(document));
  }
};

TEST_F(ReportCommand, DrawsTheReportOfAComparisonTwiceAlike) {
  const Outcome compare = Run({"compare",
                               kDown,
                               "--models",
                               "mean,poly:eq8",
                               "--out",
                               "study",
                               "--quiet"});
  ASSERT_EQ(compare.status, 0) << compare.err;
  const std::string first = Read("study/report.html");
  const std::string markdown = Read("study/report.md");
  const Outcome drawn = Run({"report", "study"});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_EQ(drawn.out, "study/report.html\nstudy/report.md\n");
  EXPECT_EQ(Read("study/report.html"), first);
  EXPECT_EQ(Read("study/report.md"), markdown);
  EXPECT_THAT(first, HasSubstr("poly:eq8"));
  EXPECT_THAT(Read("study/report.md"), HasSubstr("poly:eq8"));
  EXPECT_THAT(first, HasSubstr("<svg"));
}

TEST_F(ReportCommand, SaysWhatWritesAStudyWhereThereIsNone) {
  for (const std::string& folder : {std::string("."), kDown}) {
    EXPECT_THAT(RefusalOf(Run({"report", folder}), kUnusable),
                HasSubstr("no folder with results.json; errmap compare "
                          "DATA.csv --out STUDY writes STUDY"));
  }
}

TEST_F(ReportCommand, KeepsInTheRecordAllThatWasJudged) {
  const Json document =
      RunJson({"compare",
               kDown,
               "--models",
               "poly:eq7,poly:full:degree=3,net:scg:iterations=5",
               "--format",
               "json"});
  const std::string text = FileText(document);
  EXPECT_EQ(models::ToJsonText(models::FromJsonText(text)), text);
  const Json& advice = document["components"][0]["recommendation"];
  EXPECT_THAT(advice["reasons"].dump(), HasSubstr("Without a map: "));
  EXPECT_THAT(advice["reasons"].dump(), HasSubstr("Cost: "));
  EXPECT_THAT(advice["caveats"].dump(), HasSubstr("this is one run"));
}

TEST_F(ReportCommand, FindsTheRowsOfTheFiguresInResultsJson) {
  const Json component = Compare({"--models", "mean,poly:eq8"});
  const Json& figures = component["figures"];
  const Json& table = figures["tables"][0];
  EXPECT_EQ(table["rows_total"], 397);
  EXPECT_EQ(table["target"].size(), 397U);
  EXPECT_EQ(table["labels"].size(), 35U);
  EXPECT_EQ(figures["position"], "position_mm");
  EXPECT_EQ(figures["inputs"][0]["name"], "position_mm");
  EXPECT_EQ(figures["inputs"][0]["unit"], "mm");
  // Under every:3 two rows of three are in no test.
  const Json& near = figures["holdouts"][0]["predictions"]["mean"];
  EXPECT_TRUE(near[0].is_null());
  EXPECT_TRUE(near[2].is_number());
  // The residuals of the figures are those of the table.
  const Json& far = figures["holdouts"][1]["predictions"]["poly:eq8"];
  double sum = 0.0;
  for (std::size_t i = 0; i < far.size(); ++i) {
    const double residual =
        table["target"][i].get<double>() - far[i].get<double>();
    sum += residual * residual;
  }
  const double rmse =
      Model(component, "poly:eq8")["results"]["groups:5"]["test"]["rmse"];
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(far.size())), rmse, 1e-9);
}

TEST_F(ReportCommand, ThinsMoreThanFiveThousandRowsEvenly) {
  std::string text = "position_mm,error_mm\n";
  constexpr int kRows = 6000;
  for (int i = 0; i < kRows; ++i) {
    text += std::to_string(i % 50) + "," +
            std::to_string(0.001 * (i % 50) + 0.0001 * (i % 7)) + "\n";
  }
  Write("many.csv", text);
  const Json document = RunJson({"compare",
                                 "many.csv",
                                 "--models",
                                 "mean,poly:position",
                                 "--format",
                                 "json"});
  const Json& table = document["components"][0]["figures"]["tables"][0];
  EXPECT_EQ(table["rows_total"], kRows);
  ASSERT_EQ(table["rows"].size(), 5000U);
  EXPECT_EQ(table["rows"][0], 0);
  EXPECT_EQ(table["rows"][4999], 5999);
}

TEST_F(ReportCommand, WritesFiguresForAPaper) {
  WriteStudy(MakeReportDocument());
  const Outcome outcome = Run({"report", "study", "--figures", "paper"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("figures as svg in paper"));
  EXPECT_TRUE(Read("paper/c1-gap.svg").starts_with("<svg "));
}

TEST_F(ReportCommand, PrintsHtmlOrMarkdownWhereAskedTo) {
  WriteStudy(MakeReportDocument());
  const Outcome html = Run({"report", "study", "--format", "html"});
  EXPECT_EQ(html.status, 0);
  EXPECT_TRUE(html.out.starts_with("<!DOCTYPE html>"));
  const Outcome markdown = Run({"report", "study", "--format", "md"});
  EXPECT_TRUE(markdown.out.starts_with("# Error maps"));
  EXPECT_FALSE(Exists("study/report.html"));
}

TEST_F(ReportCommand, NamesAFileThatIsMissingOrNoResults) {
  EXPECT_THAT(RefusalOf(Run({"report", "nowhere"}), kUnusable),
              HasSubstr("results.json"));
  std::filesystem::create_directory(scratch_ / "study");
  Write("study/results.json", "{ half");
  EXPECT_THAT(RefusalOf(Run({"report", "study"}), kUnusable),
              HasSubstr("is not JSON"));
  Write("study/results.json", "{\"schema\": \"errmap-fit-1\"}");
  EXPECT_THAT(RefusalOf(Run({"report", "study"}), kUnusable),
              HasSubstr("'errmap-fit-1'"));
}

TEST_F(ReportCommand, KeepsAGoodReportWhereItCannotWrite) {
  WriteStudy(MakeReportDocument());
  ASSERT_EQ(Run({"report", "study"}).status, 0);
  const std::string good = Read("study/report.html");
  // A file-size limit stands for a full disk; the program inherits it.
  signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  rlimit tight = old;
  tight.rlim_cur = 4096;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
  const Outcome outcome = Run({"report", "study"});
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
  EXPECT_EQ(outcome.status, kFailure);
  EXPECT_THAT(outcome.err, HasSubstr("report.html"));
  EXPECT_EQ(Read("study/report.html"), good);
}

TEST_F(ReportCommand, RefusesAnUnknownFormatOrImage) {
  EXPECT_EQ(Run({"report", "study", "--image", "gif"}).status,
            kWrongCommandLine);
  EXPECT_EQ(Run({"report"}).status, kWrongCommandLine);
}

}  // namespace
}  // namespace errmap
