#include "cli/report/documents/report_html.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/report/figures/figures.h"
#include "cli/report/html.h"
#include "cli/report/number_text.h"
#include "cli/report/shell_word.h"
#include "cli/report/tables/report_tables.h"
#include "cli/report/text/answers/data_words.h"
#include "cli/report/text/answers/next_steps.h"
#include "cli/report/text/answers/verdict_text.h"

namespace errmap::report {
namespace {

constexpr std::size_t kOpenComponents = 1;

std::string Paragraph(const std::string& text, const char* style = "") {
  if (text.empty()) return "";
  return fmt::format("<p{}>{}</p>\n",
                     *style != '\0' ? fmt::format(" class=\"{}\"", style) : "",
                     HtmlSentence(text));
}

std::string List(const std::string& title,
                 const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string html =
      title.empty() ? "<ul>" : fmt::format("<h4>{}</h4><ul>", HtmlText(title));
  for (const std::string& line : lines) {
    html += "<li>" + HtmlSentence(line) + "</li>";
  }
  return html + "</ul>\n";
}

// "" if there is nothing to unfold.
std::string Collapsed(const std::string& title,
                      const std::string& content,
                      const std::string& id = "") {
  if (content.empty()) return "";
  return fmt::format("<details{}><summary>{}</summary>\n{}</details>\n",
                     id.empty() ? "" : fmt::format(" id=\"{}\"", id),
                     HtmlText(title),
                     content);
}

// What does not apply is left out.
std::string FigureHtml(const Figure& figure) {
  if (!figure.missing.empty()) return "";
  return fmt::format(
      "<figure><figcaption><b>{}</b></figcaption>{}{}</figure>\n",
      HtmlName(figure.title),
      FigureSvg(figure),
      Paragraph(figure.note, "soft small"));
}

// The browser breaks lines, though not within an option, and what is copied is
// one line.
std::string HtmlCommand(const std::vector<std::string>& words) {
  std::string html;
  for (const std::string& word : words) {
    const std::string shown = HtmlText(ShellWord(word));
    html += html.empty() ? "<code>" : " ";
    html += word.starts_with('-') ? "<span>" + shown + "</span>" : shown;
  }
  return html + "</code>";
}

std::string Grid(const std::string& figures, const char* style) {
  if (figures.empty()) return "";
  return fmt::format("<div class=\"{}\">\n{}</div>\n", style, figures);
}

// Text and the figures of one place in three columns, of which the text takes
// those that the figures leave free.
std::string Columns(const std::string& text,
                    const ComponentFigures& figures,
                    FigurePlace place) {
  std::string html;
  std::size_t drawn = 0;
  for (const Figure& figure : figures.figures) {
    if (figure.place != place || !figure.missing.empty()) continue;
    html += FigureHtml(figure);
    ++drawn;
  }
  constexpr std::size_t kColumns = 3;
  if (!text.empty()) {
    html = fmt::format("<div class=\"span{}\">{}</div>\n{}",
                       drawn < kColumns ? kColumns - drawn : kColumns,
                       text,
                       html);
  }
  return Grid(html, "figures");
}

// How the recommended map does on one unit held out after another.
std::string ErrorByUnit(const ReportView& view) {
  const ResultRecord* result = ResultOf(view, view.recommended, view.decisive);
  const models::HoldoutRecord* holdout = HoldoutOf(view, view.decisive);
  if (result == nullptr || holdout == nullptr || result->unit_rmse.empty()) {
    return "";
  }
  const auto [least, most] = std::ranges::minmax(result->unit_rmse);
  const ErrorText error = ErrorTextOf(view);
  const std::string to = error.WithUnit(most);
  const std::string line = Sparkline(
      result->unit_rmse,
      fmt::format(
          "RMSE by {}: {} to {}", holdout->unit_of_analysis, error(least), to));
  return line.empty() ? "" : line + " to " + HtmlText(to);
}

// The first rows of a table; the others unfold.
std::string WithFirstRows(Table table, std::size_t most) {
  if (table.rows.size() <= most) return HtmlTable(table);
  Table more = table;
  table.rows.resize(most);
  more.rows.erase(more.rows.begin(),
                  more.rows.begin() + static_cast<std::ptrdiff_t>(most));
  more.title.clear();
  more.note.clear();
  more.marked = more.marked != std::string::npos && more.marked >= most
                    ? more.marked - most
                    : std::string::npos;
  const std::string title = Count(std::ssize(more.rows), "more model");
  return HtmlTable(table) + Collapsed(title, HtmlTable(more));
}

std::string Title(const models::StudyRecord& record) {
  const std::size_t n = record.components.size();
  if (n == 1) {
    return "Error map of " + ViewOf(record.components.front()).name;
  }
  return n == 0 ? std::string("Error maps")
                : fmt::format("Error maps of {} components", n);
}

std::string Notices(const models::StudyRecord& record) {
  std::string html;
  if (record.interrupted) {
    html +=
        "<p class=\"notice\">The run was interrupted: only finished results "
        "are shown, and missing models were not fitted.</p>\n";
  }
  if (const std::string doubt = DoubtText(record); !doubt.empty()) {
    html += "<p class=\"notice\">" + doubt + "</p>\n";
  }
  if (record.components.empty()) {
    html +=
        "<p class=\"notice\">results.json holds no component: there is "
        "nothing to report.</p>\n";
  }
  return html;
}

std::string IndexOf(const models::StudyRecord& record,
                    const std::vector<ReportView>& views,
                    const FigureSet& figures) {
  std::string html = "<thead><tr>";
  for (const char* name : {"component",
                           "use",
                           "error",
                           "95 %",
                           "remaining error",
                           "by unit",
                           "proven",
                           "goal"}) {
    html += fmt::format("<th scope=\"col\" class=\"t\">{}</th>", name);
  }
  html += "</tr></thead><tbody>\n";
  const Table rows = SummaryRows(record);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Headline line = HeadlineOf(views[i]);
    const auto& advice = views[i].component->recommendation;
    const auto cell = [&](const std::string& content) {
      html += "<td class=\"t\">" + content + "</td>";
    };
    html += "<tr>";
    cell(
        fmt::format("<a href=\"#c{}\">{}</a>", i + 1, HtmlName(views[i].name)));
    cell(views[i].recommended.empty() ? "nothing"
                                      : HtmlName(views[i].recommended));
    cell(line.error.empty() ? "not known" : HtmlText(line.error));
    cell(HtmlText(rows.Shown(rows.rows[i][kIntervalColumn])));
    // What is left is 1 - removed.
    cell(advice ? IntervalPicture(advice->rmse,
                                  advice->ci95,
                                  advice->rmse / (1.0 - advice->removed_share))
                : "");
    cell(ErrorByUnit(views[i]));
    cell(HtmlText(rows.Shown(rows.rows[i][kProvenColumn])));
    cell(line.goal_standing == models::GoalStanding::kNone
             ? "none"
             : std::string(models::ToString(line.goal_standing)));
    html += "</tr>\n";
  }
  std::string links;
  for (const RecordPart& part : figures.parts) {
    links += fmt::format(
        "<p><a href=\"#{}\">{}</a></p>", part.id, HtmlText(part.link));
  }
  return "<nav aria-label=\"Components\"><h2>Components</h2>\n"
         "<div class=\"index\">" +
         ScrolledTable("Components", html + "</tbody>") +
         "</div><p class=\"soft small\">Remaining error: a dot between 0 and "
         "the error without a map, with its 95 % interval. By unit: the error "
         "on each held-out day, cycle or block, from 0 to the largest. Proven: "
         "better than the best baseline." +
         (figures.IsBrief()
              ? " Each shows only the main results; <code>errmap "
                "report DIR --component NAME</code> draws the full page of one."
              : "") +
         "</p>" + links + "</nav>\n";
}

std::string Next(const models::StudyRecord& record, std::size_t index) {
  const auto& configs = record.provenance.configuration.component;
  std::vector<std::string> data;
  if (index < configs.size() && configs[index].data && !configs[index].where) {
    data = configs[index].more_data.value_or(std::vector<std::string>());
    data.insert(data.begin(), *configs[index].data);
  }
  const auto& models = record.components[index].models;
  const bool written = std::ranges::any_of(
      models, [](const ModelRecord& model) { return model.file.has_value(); });
  std::string html;
  for (const NextStep& step :
       NextSteps(record, index, data, written ? "." : "")) {
    html += fmt::format(
        "<dt>{}</dt><dd>{}</dd>",
        HtmlText(step.purpose),
        step.words.empty() ? HtmlSentence(step.text) : HtmlCommand(step.words));
  }
  return html.empty()
             ? html
             : fmt::format("<h4>Next{}</h4>\n<dl class=\"next\">{}</dl>\n",
                           written ? ", in this folder" : "",
                           html);
}

std::string Card(const ReportView& view) {
  const Headline line = HeadlineOf(view);
  std::string html = "<div class=\"card\">\n<p class=\"sentence\">" +
                     HtmlSentence(line.answer.use) + "</p>\n";
  if (!line.error.empty()) {
    html += "<p class=\"number\">" + HtmlText(line.error) + "</p>\n";
  }
  std::string rows;
  for (const Remark& row : line.answer.lines) {
    const char* tone = row.tone == Remark::Tone::kGood  ? " class=\"good\""
                       : row.tone == Remark::Tone::kBad ? " class=\"bad\""
                                                        : "";
    rows += fmt::format("<dt>{}</dt><dd{}>{}</dd>",
                        HtmlText(row.label),
                        tone,
                        HtmlSentence(row.text));
  }
  if (!rows.empty()) html += "<dl class=\"next\">" + rows + "</dl>\n";
  return html + "</div>\n";
}

std::string Answer(const models::StudyRecord& record,
                   const ReportView& view,
                   std::size_t index,
                   const ComponentFigures& figures) {
  std::string of_models;
  for (const Figure& figure : figures.figures) {
    if (figure.place == FigurePlace::kAnswer) of_models += FigureHtml(figure);
  }
  return "<div class=\"answer\">\n<div>" + Card(view) + Next(record, index) +
         "</div>\n<div>" + of_models + "</div>\n</div>\n";
}

std::string Measured(const ReportView& view,
                     std::size_t index,
                     const ComponentFigures& figures) {
  const models::DataRecord& measured = view.component->data;
  std::string text = Paragraph(fmt::format(
      "{}: {}{}.",
      measured.file.empty() ? "File not known" : measured.file,
      measured.target.empty() ? "error not known" : TargetWords(measured),
      measured.unit.empty() ? "" : " in " + measured.unit));
  if (measured.reading.rows > 0) {
    for (const std::string& line : data::ReadingLines(measured.reading)) {
      text += Paragraph(line);
    }
  } else {
    text += Paragraph(Count(measured.rows, "row") + UnitsWords(measured) + ".");
  }
  text += Paragraph(kSignConvention) + (index == 0 ? GlossaryLinks() : "");
  return Columns(text, figures, FigurePlace::kMeasured);
}

std::string Why(const ReportView& view, const ComponentFigures& figures) {
  constexpr std::size_t kMostRows = 12;
  const Headline line = HeadlineOf(view);
  const Table leaderboard = PageLeaderboard(view);
  return Columns(List("Reasons", line.reasons) + List("Caveats", line.caveats),
                 figures,
                 FigurePlace::kSensors) +
         (leaderboard.missing.empty()
              ? Grid(WithFirstRows(leaderboard, kMostRows), "first2")
              : Paragraph(leaderboard.missing, "absent"));
}

std::string Evidence(const ReportView& view) {
  std::vector<std::string> lines;
  for (const models::VerdictRecord& verdict : view.component->verdict) {
    if (!verdict.why.empty()) lines.push_back(verdict.why);
  }
  std::string html = List("", lines);
  html += HtmlTable(ComparisonTable(view, view.decisive));
  for (const std::string& holdout : view.holdouts) {
    if (holdout == view.decisive) continue;
    html += Collapsed("Differences under " + holdout,
                      HtmlTable(ComparisonTable(view, holdout)));
  }
  return html + HtmlTable(GapTable(view)) + HtmlTable(StabilityTable(view)) +
         HtmlTable(ShuffledTargetTable(view));
}

std::string Residuals(const ReportView& view, const ComponentFigures& figures) {
  std::string html = Columns("", figures, FigurePlace::kResiduals);
  if (const Table since = SinceStartTable(view); !since.rows.empty()) {
    html += HtmlTable(since);
  }
  const bool brief = figures.detail == FigureDetail::kBrief;
  for (const std::string& holdout : view.holdouts) {
    const bool first = holdout == view.decisive;
    if (brief && !first) continue;
    std::string tables = HtmlTable(ResidualTable(view, holdout));
    if (!brief) {
      tables += HtmlTable(NormalityTable(view, holdout)) +
                HtmlTable(IndependenceTable(view, holdout));
    }
    html += first ? tables
                  : Collapsed("Residual statistics under " + holdout, tables);
  }
  return html;
}

std::string Fits(const ReportView& view, const ComponentFigures& figures) {
  return Columns("", figures, FigurePlace::kFits) + HtmlTable(RunTable(view)) +
         Collapsed("Every start", HtmlTable(StartTable(view))) +
         Collapsed("Every fold", HtmlTable(FoldTable(view))) +
         Collapsed("Options", HtmlTable(OptionTable(view)));
}

std::string Polynomials(const ReportView& view, bool brief) {
  std::string html;
  for (const ModelRecord* model : PolynomialsOf(view)) {
    const bool best = model->name == view.recommended;
    if (brief && !best) continue;
    const auto regression =
        model->regression.value_or(models::RegressionRecord());
    std::string content = Paragraph(regression.method);
    if (model->equation && !model->equation->empty()) {
      content += Paragraph("In physical units, complete:", "small") +
                 "<div class=\"equation\" tabindex=\"0\" role=\"region\" "
                 "aria-label=\"equation\">" +
                 HtmlText(*model->equation) + "</div>\n";
    }
    content += Paragraph(RegressionSummary(regression, ErrorTextOf(view)));
    if (!brief) {
      content += HtmlTable(CoefficientTable(regression)) +
                 HtmlTable(ExcludedTerms(regression)) +
                 HtmlTable(AliasedTerms(regression));
    }
    html += fmt::format("<details{}><summary>{}</summary>\n{}</details>\n",
                        best ? " open" : "",
                        HtmlName(model->name),
                        content);
  }
  return html;
}

std::string Data(const ReportView& view) {
  const std::vector<std::string>& inputs = view.component->data.inputs;
  std::string names;
  for (const std::string& input : inputs) {
    names += (names.empty() ? "" : ", ") + HtmlName(input);
  }
  return "<p>" + Count(std::ssize(inputs), "input") +
         (names.empty() ? "" : ": " + names) + ".</p>\n" +
         HtmlTable(DroppedTable(view)) + HtmlTable(HoldoutTable(view));
}

std::string Component(const models::StudyRecord& record,
                      const ReportView& view,
                      std::size_t index,
                      const FigureSet& set) {
  static const ComponentFigures none;
  const ComponentFigures& figures =
      index < set.components.size() ? set.components[index] : none;
  const bool brief = figures.detail == FigureDetail::kBrief;
  const bool alone = record.components.size() <= kOpenComponents;
  // What stands where, and the list of it.
  struct Part {
    const char* title;
    std::string content;
    bool folded;
  };
  const std::vector<Part> parts = {
      {"What was measured", Measured(view, index, figures), false},
      {"What the map does",
       Columns("", figures, FigurePlace::kCompensation),
       false},
      {"Why this map", Why(view, figures), false},
      {"Is it more than chance?", Evidence(view), true},
      {"Residuals", Residuals(view, figures), true},
      {"Costs and fits",
       HtmlTable(CostTable(view)) +
           (brief ? HtmlTable(RunTable(view)) : Fits(view, figures)),
       true},
      {"Equations and coefficients", Polynomials(view, brief), true},
      {"Provenance",
       Data(view) + (alone ? HtmlTable(ProvenanceTable(record)) : ""),
       true}};
  std::string html = Answer(record, view, index, figures);
  std::string contents;
  std::string body;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].content.empty()) continue;
    const std::string id = fmt::format("c{}-{}", index + 1, i + 1);
    contents += fmt::format("{}<a href=\"#{}\">{}</a>",
                            contents.empty() ? "" : " · ",
                            id,
                            parts[i].title);
    body += parts[i].folded ? Collapsed(parts[i].title, parts[i].content, id)
                            : fmt::format("<h3 id=\"{}\">{}</h3>\n{}",
                                          id,
                                          parts[i].title,
                                          parts[i].content);
  }
  html += "<p class=\"contents\">" + contents + "</p>\n" + body;
  if (alone) {
    return fmt::format("<section id=\"c{}\">\n{}</section>\n", index + 1, html);
  }
  const Headline line = HeadlineOf(view);
  // The anchor lies inside, so that a link opens what is closed.
  return fmt::format(
      "<details class=\"component\"><summary>{} <span>{}</span></summary>\n"
      "<section id=\"c{}\">\n{}<p class=\"back\"><a href=\"#top\">Back to "
      "the index</a></p></section></details>\n",
      HtmlName(view.name),
      line.error.empty()
          ? "no result"
          : HtmlName(view.recommended) + ", " + HtmlText(line.error),
      index + 1,
      html);
}

// What it comes to first, then where and why.
std::string Parts(const FigureSet& set) {
  std::string html;
  for (const RecordPart& part : set.parts) {
    std::string figures;
    for (const Figure& figure : part.figures) figures += FigureHtml(figure);
    html += fmt::format(
        "<section id=\"{}\">\n<h2>{}</h2>\n", part.id, HtmlText(part.title));
    html += Paragraph(part.answer, "sentence");
    for (std::size_t i = 0; i < part.tables.size(); ++i) {
      html += HtmlTable(part.tables[i]);
      if (i == 0) html += Grid(figures, "figures halves");
    }
    html += "</section>\n";
  }
  return html;
}

}  // namespace

std::string ReportHtml(const models::StudyRecord& study,
                       const FigureSet& figures) {
  const models::StudyRecord record = WithPageUnits(study);
  std::vector<ReportView> views;
  for (const ComponentRecord& component : record.components) {
    views.push_back(ViewOf(component));
  }
  std::string html = "<header id=\"top\"><h1>" + HtmlText(Title(record)) +
                     "</h1></header>\n<main>\n";
  html += Notices(record);
  if (views.size() > kOpenComponents) html += IndexOf(record, views, figures);
  for (std::size_t i = 0; i < views.size(); ++i) {
    html += Component(record, views[i], i, figures);
  }
  html += Parts(figures);
  if (views.size() != kOpenComponents) {
    html += Collapsed("Provenance", HtmlTable(ProvenanceTable(record)));
  }
  if (!views.empty()) html += Glossary();
  html +=
      "<p class=\"printed\">Folded sections are not printed: open them first, "
      "or see report.md.</p>\n";
  html += "</main>\n<footer>";
  const std::string& version = record.version;
  html += fmt::format(
      "<p>Drawn by errmap{}; errmap report DIR draws it again from "
      "results.json.</p>",
      version.empty() ? "" : " " + HtmlText(version));
  return PageHtml(Title(record), html + "</footer>\n");
}

}  // namespace errmap::report
