#include "cli/report/documents/report_html.h"
#include "cli/report/figures/figures.h"
#include "cli/report/html.h"
#include "cli/report/report.h"
#include "cli/report/tables/report_tables.h"
#include "cli/report/text/answers/data_words.h"

namespace errmap::report {
namespace {

std::string MarkdownParagraph(const std::string& text) {
  return text.empty() ? "" : MarkdownText(text) + "\n\n";
}

std::string Bullets(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += "- " + MarkdownText(line) + "\n";
  }
  return text.empty() ? text : text + "\n";
}

std::string Answer(const ReportView& view) {
  const Headline line = HeadlineOf(view);
  std::string text = "**" + MarkdownText(line.answer.use) + "**\n\n";
  std::vector<std::string> facts;
  for (const Remark& row : line.answer.lines) {
    facts.push_back(row.label + ": " + row.text);
  }
  text += Bullets(facts) + MarkdownParagraph(kSignConvention) +
          "### Every model\n\n" + MarkdownTable(PageLeaderboard(view)) + "\n";
  if (!line.reasons.empty()) text += "### Reasons\n\n" + Bullets(line.reasons);
  if (!line.caveats.empty()) text += "### Caveats\n\n" + Bullets(line.caveats);
  return text;
}

std::string Polynomials(const ReportView& view) {
  std::string text;
  for (const ModelRecord* model : PolynomialsOf(view)) {
    const auto regression =
        model->regression.value_or(models::RegressionRecord());
    text += "#### " + MarkdownText(model->name) + "\n\n" +
            MarkdownParagraph(model->equation.value_or("")) +
            MarkdownParagraph(RegressionSummary(regression, ErrorTextOf(view)));
    if (model->name == view.recommended) {
      text += MarkdownTable(CoefficientTable(regression), "####");
    }
  }
  return text.empty() ? text : "### Equations\n\n" + text;
}

std::string Component(const ReportView& view) {
  std::string text = "## " + MarkdownText(view.name) + "\n\n" + Answer(view);
  text += MarkdownTable(ComparisonTable(view, view.decisive), "###");
  text += MarkdownTable(GapTable(view), "###");
  if (const Table since = SinceStartTable(view); !since.rows.empty()) {
    text += MarkdownTable(since, "###");
  }
  for (const std::string& holdout : view.holdouts) {
    text += MarkdownTable(ResidualTable(view, holdout), "###");
  }
  text += MarkdownTable(RunTable(view), "###") + Polynomials(view);
  text += MarkdownTable(DroppedTable(view), "###");
  return text + MarkdownTable(HoldoutTable(view), "###");
}

}  // namespace

std::string ReportMarkdown(const models::StudyRecord& record) {
  std::string text = "# Error maps\n\n";
  if (record.interrupted) {
    text += "The run was interrupted: only finished results are shown.\n\n";
  }
  if (record.doubt) text += DoubtText(record) + "\n\n";
  if (record.components.empty()) {
    text += "results.json holds no component: there is nothing to report.\n\n";
  }
  for (const ComponentRecord& component : record.components) {
    ReportView view = ViewOf(component);
    view.shown_unit = component.display.unit;  // as in every file
    text += Component(view);
  }
  for (const RecordPart& part : PartsOf(record)) {
    text += part.answer + "\n\n";
    for (const Table& table : part.tables) text += MarkdownTable(table, "##");
  }
  return text + MarkdownTable(ProvenanceTable(record), "##");
}

}  // namespace errmap::report
