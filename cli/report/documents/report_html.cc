#include "cli/report/documents/report_html.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/report/documents/report_glossary.h"
#include "cli/report/documents/report_headline.h"
#include "cli/report/documents/report_style.h"
#include "cli/report/figures/row_pictures.h"
#include "cli/report/html.h"
#include "cli/report/number_text.h"
#include "cli/report/shell_word.h"
#include "cli/report/tables/fit_tables.h"
#include "cli/report/tables/machine_tables.h"
#include "cli/report/tables/report_tables.h"
#include "cli/report/tables/result_table.h"
#include "cli/report/words/data_words.h"
#include "cli/report/words/next_steps.h"
#include "cli/report/words/verdict_text.h"

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

// "" where there is nothing to unfold.
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
  constexpr int kWide = 560;
  const bool wide = !figure.small && figure.plot.width > kWide;
  std::string drawn = FigureSvg(figure);
  if (wide) {
    // On a phone it keeps a size that can be read.
    drawn = fmt::format(
        "<div class=\"scroll bare\" tabindex=\"0\" role=\"region\" "
        "aria-label=\"{}\">{}</div>",
        HtmlText(figure.title),
        drawn);
  }
  return fmt::format(
      "<figure{}><figcaption><b>{}</b></figcaption>{}{}</figure>\n",
      wide ? " class=\"wide\"" : "",
      HtmlName(figure.title),
      drawn,
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

// Those of one place, by the model they are of; small ones in a grid of their
// own.
std::string FiguresHtml(const ComponentFigures& figures,
                        FigurePlace place,
                        const char* style = "figures") {
  std::string html;
  for (std::size_t i = 0; i < figures.figures.size();) {
    const std::string& subject = figures.figures[i].subject;
    std::string large;
    std::string small;
    for (; i < figures.figures.size() && figures.figures[i].subject == subject;
         ++i) {
      const Figure& figure = figures.figures[i];
      if (figure.place != place) continue;
      (figure.small ? small : large) += FigureHtml(figure);
    }
    if (!subject.empty() && !(large.empty() && small.empty())) {
      html += "<h4>" + HtmlName(subject) + "</h4>\n";
    }
    html += Grid(large, style) + Grid(small, "figures many");
  }
  return html;
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
  const std::string title =
      Count(static_cast<long long>(more.rows.size()), "more model");
  return HtmlTable(table) + Collapsed(title, HtmlTable(more));
}

// A box for each model: without its tick the figures leave the model out.
std::string Picks(const ReportView& view) {
  std::string html;
  for (std::size_t i = 0; i < view.models.size(); ++i) {
    html += fmt::format(
        "<label><input type=\"checkbox\" class=\"h{}\" checked> {}</label>\n",
        i,
        HtmlName(view.models[i]->name));
  }
  return "<div class=\"picks\">" + Collapsed("Models in the figures", html) +
         "</div>\n";
}

// Where no browser knows :has(), all stay.
std::string PickStyle(const std::vector<ReportView>& views) {
  std::size_t most = 0;
  for (const ReportView& view : views)
    most = std::max(most, view.models.size());
  std::string style;
  for (std::size_t i = 0; i < most; ++i) {
    style += fmt::format(
        "section:has(.h{0}:not(:checked)) .m{0}{{display:none}}\n", i);
  }
  return style;
}

// The page and what it is made of.
class Page {
 public:
  Page(const models::StudyRecord& record, const FigureSet& figures)
      : record_(record), figures_(figures) {}

  std::string Html() const;

 private:
  const models::StudyRecord& record_;
  const FigureSet& figures_;

  const std::vector<ComponentRecord>& Components() const {
    return record_.components;
  }
  std::size_t NumComponents() const { return Components().size(); }

  std::string Title() const;
  std::string Notices() const;
  std::string Index(const std::vector<ReportView>& views) const;
  std::string Component(const ReportView& view, std::size_t index) const;
  std::string Answer(const ReportView& view,
                     std::size_t index,
                     const ComponentFigures& figures) const;
  std::string Next(std::size_t index) const;
  std::string Card(const ReportView& view) const;
  std::string Evidence(const ReportView& view) const;
  std::string Residuals(const ReportView& view,
                        const ComponentFigures& figures) const;
  std::string Fits(const ReportView& view,
                   const ComponentFigures& figures) const;
  std::string Polynomials(const ReportView& view, bool brief) const;
  std::string Data(const ReportView& view) const;
  std::string Machine() const;
};

std::string Page::Title() const {
  const std::size_t n = NumComponents();
  if (n == 1) {
    return "Error map of " + ViewOf(Components().front()).name;
  }
  return n == 0 ? std::string("Error maps")
                : fmt::format("Error maps of {} components", n);
}

std::string Page::Notices() const {
  std::string html;
  if (record_.interrupted) {
    html +=
        "<p class=\"notice\">The run was interrupted: only what was "
        "finished is shown, and models that are missing were not "
        "fitted.</p>\n";
  }
  if (const std::string doubt = DoubtText(record_); !doubt.empty()) {
    html += "<p class=\"notice\">" + doubt + "</p>\n";
  }
  if (NumComponents() == 0) {
    html +=
        "<p class=\"notice\">results.json holds no component: there is "
        "nothing to report.</p>\n";
  }
  return html;
}

std::string Page::Index(const std::vector<ReportView>& views) const {
  std::string html =
      "<nav aria-label=\"Components\"><h2>Components</h2>\n<div "
      "class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"Components\"><table><thead><tr>";
  for (const char* name : {"component",
                           "use",
                           "error",
                           "95 %",
                           "left of the error",
                           "unit by unit",
                           "proven",
                           "goal"}) {
    html += fmt::format("<th scope=\"col\" class=\"t\">{}</th>", name);
  }
  html += "</tr></thead><tbody>\n";
  const Table rows = SummaryRows(record_);
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
  return html +
         "</tbody></table></div><p class=\"soft small\">Left of the error: the "
         "dot between 0 and the error without a map, its bar the 95 % "
         "interval. Unit by unit: the error on each cycle, day or block held "
         "out whole, from 0 to the largest. Proven: better than the best "
         "baseline." +
         (figures_.IsBrief()
              ? " Of each there is what matters most; <code>errmap "
                "report DIR --component NAME</code> draws the "
                "whole page of one."
              : "") +
         "</p>" +
         (record_.machine ? "<p><a href=\"#machine\">The machine: the error at "
                            "the tool</a></p>"
                          : "") +
         "</nav>\n";
}

std::string Page::Next(std::size_t index) const {
  const auto& configs = record_.provenance.configuration.component;
  std::vector<std::string> data;
  if (index < configs.size() && configs[index].data && !configs[index].where) {
    data = configs[index].more_data.value_or(std::vector<std::string>());
    data.insert(data.begin(), *configs[index].data);
  }
  const auto& models = Components()[index].models;
  const bool written = std::ranges::any_of(
      models, [](const ModelRecord& model) { return model.file.has_value(); });
  std::string html;
  for (const NextStep& step :
       NextSteps(record_, index, data, written ? "." : "")) {
    html += fmt::format(
        "<dt>{}</dt><dd>{}</dd>",
        HtmlText(step.purpose),
        step.words.empty() ? HtmlSentence(step.text) : HtmlCommand(step.words));
  }
  return html.empty() ? html : "<dl class=\"next\">" + html + "</dl>\n";
}

std::string Page::Card(const ReportView& view) const {
  const Headline line = HeadlineOf(view);
  std::string html = "<div class=\"card\">\n<p class=\"sentence\">" +
                     HtmlSentence(line.answer.use) + "</p>\n";
  if (!line.error.empty()) {
    html += "<p class=\"number\">" + HtmlText(line.error) + "</p>\n";
  }
  std::string rows;
  for (const AnswerLine& row : line.answer.lines) {
    const char* tone = row.tone == AnswerLine::Tone::kGood  ? " class=\"good\""
                       : row.tone == AnswerLine::Tone::kBad ? " class=\"bad\""
                                                            : "";
    rows += fmt::format("<dt>{}</dt><dd{}>{}</dd>",
                        HtmlText(row.label),
                        tone,
                        HtmlSentence(row.text));
  }
  if (!rows.empty()) html += "<dl class=\"next\">" + rows + "</dl>\n";
  return html + "</div>\n";
}

std::string Page::Answer(const ReportView& view,
                         std::size_t index,
                         const ComponentFigures& figures) const {
  const std::string of_models =
      FiguresHtml(figures, FigurePlace::kAnswer, "plain") + Picks(view);
  const std::string of_sensors =
      FiguresHtml(figures, FigurePlace::kSensors, "plain");
  std::string notes;
  if (view.component->data.reading.rows > 0) {
    for (const std::string& line :
         data::ReadingLines(view.component->data.reading)) {
      notes += Paragraph(line, "soft small");
    }
  }
  notes += Paragraph(kSignConvention, "soft small") +
           (index == 0 ? GlossaryLinks() : "");
  return "<div class=\"answer\">\n<div>" + Card(view) +
         (of_sensors.empty() ? notes + "</div>\n<div>" + of_models + Next(index)
                             : of_models + "</div>\n<div>" + Next(index) +
                                   notes + of_sensors) +
         "</div>\n</div>\n";
}

std::string Page::Evidence(const ReportView& view) const {
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
         HtmlTable(MemorisationTable(view));
}

std::string Page::Residuals(const ReportView& view,
                            const ComponentFigures& figures) const {
  std::string html = FiguresHtml(figures, FigurePlace::kResiduals);
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

std::string Page::Fits(const ReportView& view,
                       const ComponentFigures& figures) const {
  return FiguresHtml(figures, FigurePlace::kFits) + HtmlTable(RunTable(view)) +
         Collapsed("Every start", HtmlTable(StartTable(view))) +
         Collapsed("Every fold", HtmlTable(FoldTable(view))) +
         Collapsed("Options", HtmlTable(OptionTable(view)));
}

std::string Page::Polynomials(const ReportView& view, bool brief) const {
  std::string html;
  for (const PolynomialTables& model : PolynomialTablesOf(view)) {
    const bool best = model.model == view.recommended;
    if (brief && !best) continue;
    std::string content = Paragraph(model.method);
    if (!model.equation.empty()) {
      content += Paragraph("In physical units, complete:", "small") +
                 "<div class=\"equation\" tabindex=\"0\" role=\"region\" "
                 "aria-label=\"equation\">" +
                 HtmlText(model.equation) + "</div>\n";
    }
    content += Paragraph(model.summary);
    if (!brief) {
      content += HtmlTable(model.coefficients) + HtmlTable(model.excluded) +
                 HtmlTable(model.aliased);
    }
    html += fmt::format("<details{}><summary>{}</summary>\n{}</details>\n",
                        best ? " open" : "",
                        HtmlName(model.model),
                        content);
  }
  return html;
}

std::string Page::Data(const ReportView& view) const {
  const models::DataRecord& measured = view.component->data;
  std::string html =
      "<p>" +
      fmt::format(
          "{}: {} rows, target {}{}{}{}{}.",
          measured.file.empty() ? "File not known" : HtmlName(measured.file),
          measured.rows,
          measured.target.empty() ? "not known" : HtmlName(measured.target),
          measured.unit.empty() ? "" : " in " + HtmlText(measured.unit),
          measured.group ? ", groups by " + HtmlName(*measured.group)
                         : ", no groups",
          measured.session ? ", sessions by " + HtmlName(*measured.session)
                           : "",
          measured.align == data::Alignment::kFirst
              ? "; each session's first value is taken off the target"
              : "") +
      "</p>\n";
  const std::vector<std::string>& inputs = measured.inputs;
  std::string names;
  for (const std::string& input : inputs) {
    names += (names.empty() ? "" : ", ") + HtmlName(input);
  }
  html += "<p>" + Count(static_cast<long long>(inputs.size()), "input") +
          (names.empty() ? "" : ": " + names) + ".</p>\n";
  html += HtmlTable(DroppedTable(view)) + HtmlTable(HoldoutTable(view));
  return html;
}

std::string Page::Component(const ReportView& view, std::size_t index) const {
  static const ComponentFigures none;
  const ComponentFigures& figures =
      index < figures_.components.size() ? figures_.components[index] : none;
  const bool brief = figures.detail == FigureDetail::kBrief;
  const bool alone = NumComponents() <= kOpenComponents;
  // What stands where, and the list of it.
  struct Part {
    const char* title;
    std::string content;
    bool folded;
  };
  const Headline line = HeadlineOf(view);
  const std::string reasons =
      List("Reasons", line.reasons) + List("Caveats", line.caveats);
  const std::string effect =
      FiguresHtml(figures, FigurePlace::kCompensation, "figures halves") +
      FiguresHtml(figures, FigurePlace::kSurface, "figures thirds");
  constexpr std::size_t kMostRows = 12;
  std::vector<Part> parts;
  const Table leaderboard = PageLeaderboard(view);
  parts.push_back({"Every model",
                   leaderboard.missing.empty()
                       ? WithFirstRows(leaderboard, kMostRows)
                       : Paragraph(leaderboard.missing, "absent"),
                   false});
  parts.push_back({"What the map does", effect, false});
  parts.push_back({"Why this map, and what bounds its worth", reasons, true});
  parts.push_back({"Is it more than chance?", Evidence(view), true});
  parts.push_back({"Residuals", Residuals(view, figures), true});
  parts.push_back(
      {"Costs and fits",
       HtmlTable(CostTable(view)) +
           (brief ? HtmlTable(RunTable(view)) : Fits(view, figures)),
       true});
  parts.push_back(
      {"Equations and coefficients", Polynomials(view, brief), true});
  parts.push_back({"Data and hold-outs", Data(view), true});
  std::string html = Answer(view, index, figures);
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
std::string Page::Machine() const {
  if (!record_.machine) return "";
  std::string figures;
  for (const Figure& figure : figures_.machine) figures += FigureHtml(figure);
  std::string html = "<section id=\"machine\">\n<h2>The machine</h2>\n";
  const std::vector<Table> tables = MachineTables(*record_.machine);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    html += HtmlTable(tables[i]);
    if (i == 0) html += Grid(figures, "figures halves");
  }
  return html + "</section>\n";
}

std::string Page::Html() const {
  std::vector<ReportView> views;
  for (std::size_t i = 0; i < NumComponents(); ++i) {
    views.push_back(ViewOf(Components()[i]));
  }
  const std::string title = HtmlText(Title());
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">\n<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"default-src 'none'; style-src 'unsafe-inline'; img-src "
      "data:\">\n<link rel=\"icon\" href=\"data:,\">\n<title>" +
      title + "</title>\n<style>" + kReportStyle + PickStyle(views) +
      "</style>\n</head>\n<body>\n";
  html += "<header id=\"top\"><h1>" + title + "</h1></header>\n<main>\n";
  html += Notices();
  if (views.size() > kOpenComponents) html += Index(views);
  for (std::size_t i = 0; i < views.size(); ++i) {
    html += Component(views[i], i);
  }
  html += Machine();
  html += Collapsed("Provenance", HtmlTable(ProvenanceTable(record_)));
  if (!views.empty()) html += Glossary();
  html +=
      "<p class=\"printed\">What is folded on the screen is left out here; "
      "open it before printing, or see report.md.</p>\n";
  html += "</main>\n<footer>";
  const std::string& version = record_.version;
  html += fmt::format(
      "<p>Drawn by errmap{}; errmap report DIR draws it anew from "
      "results.json.</p>",
      version.empty() ? "" : " " + HtmlText(version));
  return html + "</footer>\n</body>\n</html>\n";
}

}  // namespace

std::string ReportHtml(const models::StudyRecord& record,
                       const FigureSet& figures) {
  return Page(WithPageUnits(record), figures).Html();
}

}  // namespace errmap::report
