#include "cli/report/report_markdown.h"

#include <fmt/format.h>

#include "cli/report/fit_tables.h"
#include "cli/report/html.h"
#include "cli/report/report_headline.h"
#include "cli/report/report_tables.h"

namespace errmap::cli {
namespace {

std::string Paragraph(const std::string& text) {
  return text.empty() ? "" : MarkdownText(text) + "\n\n";
}

std::string List(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines)
    text += "- " + MarkdownText(line) + "\n";
  return text.empty() ? text : text + "\n";
}

std::string TableText(const ReportTable& table, const std::string& level) {
  std::string text =
      table.title.empty()
          ? ""
          : fmt::format("{} {}\n\n", level, MarkdownText(table.title));
  if (!table.missing.empty()) return text + Paragraph(table.missing);
  text += "|";
  std::string rule = "|";
  for (const ReportTable::Column& column : table.columns) {
    text += " " + MarkdownText(column.name) + " |";
    rule += column.is_number ? "---:|" : "---|";
  }
  text += "\n" + rule + "\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    text += "|";
    for (const std::string& cell : table.rows[i]) {
      const std::string shown = MarkdownText(cell);
      const bool strong = i == table.marked && !shown.empty();
      text += strong ? " **" + shown + "** |" : " " + shown + " |";
    }
    text += "\n";
  }
  return text + "\n" + Paragraph(table.note);
}

std::string Answer(const ReportView& view) {
  const Headline line = HeadlineOf(view);
  std::string text = "**" + MarkdownText(line.sentence) + "**\n\n";
  std::vector<std::string> facts;
  if (!line.error.empty()) {
    facts.push_back(line.error + " " + line.where +
                    (line.interval.empty() ? "" : "; " + line.interval));
  }
  for (const std::string& fact : {line.goal, line.beside, line.cost}) {
    if (!fact.empty()) facts.push_back(fact);
  }
  if (!line.sensors.empty()) facts.push_back("Sensors: " + line.sensors);
  text += List(facts) + Paragraph(line.why) + Paragraph(kSignConvention);
  text += TableText(LeaderboardTable(view), "###");
  if (!line.reasons.empty()) text += "### Reasons\n\n" + List(line.reasons);
  if (!line.caveats.empty()) text += "### Caveats\n\n" + List(line.caveats);
  return text;
}

std::string Polynomials(const ReportView& view) {
  std::string text;
  for (const PolynomialTables& model : PolynomialTablesOf(view)) {
    text += "#### " + MarkdownText(model.model) + "\n\n" +
            Paragraph(model.equation) + Paragraph(model.summary);
    if (model.model == view.recommended) {
      text += TableText(model.coefficients, "####");
    }
  }
  return text.empty() ? text : "### Equations\n\n" + text;
}

std::string Component(const ReportView& view) {
  std::string text = "## " + MarkdownText(view.name) + "\n\n" + Answer(view);
  text += TableText(ComparisonTable(view, view.decisive), "###");
  text += TableText(GapTable(view), "###");
  for (const std::string& holdout : view.holdouts) {
    text += TableText(ResidualTable(view, holdout), "###");
  }
  text += TableText(RunTable(view), "###") + Polynomials(view);
  text += TableText(DroppedTable(view), "###");
  return text + TableText(HoldoutTable(view), "###");
}

}  // namespace

std::string ReportMarkdown(const models::StudyRecord& record) {
  std::string text = "# Error maps\n\n";
  if (record.interrupted) {
    text += "The run was interrupted: only what was finished is shown.\n\n";
  }
  if (record.components.empty()) {
    text += "results.json holds no component: there is nothing to report.\n\n";
  }
  for (const ComponentRecord& component : record.components) {
    text += Component(ViewOf(component));
  }
  return text + TableText(ProvenanceTable(record), "##");
}

}  // namespace errmap::cli
