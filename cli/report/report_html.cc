#include "cli/report/report_html.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/report/fit_tables.h"
#include "cli/report/html.h"
#include "cli/report/machine_tables.h"
#include "cli/report/report_headline.h"
#include "cli/report/report_style.h"
#include "cli/report/report_tables.h"
#include "cli/report/result_table.h"

namespace errmap::cli {
namespace {

constexpr std::size_t kOpenComponents = 1;

std::string Paragraph(const std::string& text, const char* style = "") {
  if (text.empty()) return "";
  return fmt::format("<p{}>{}</p>\n",
                     *style != '\0' ? fmt::format(" class=\"{}\"", style) : "",
                     HtmlText(text));
}

std::string List(const std::string& title,
                 const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string html =
      title.empty() ? "<ul>" : fmt::format("<h4>{}</h4><ul>", HtmlText(title));
  for (const std::string& line : lines) {
    html += "<li>" + HtmlText(line) + "</li>";
  }
  return html + "</ul>\n";
}

std::string Collapsed(const std::string& title, const std::string& content) {
  return fmt::format("<details><summary>{}</summary>\n{}</details>\n",
                     HtmlText(title),
                     content);
}

std::string FigureHtml(const Figure& figure) {
  std::string html = fmt::format(
      "<figure{}><figcaption><b>{}</b></figcaption>",
      !figure.small && figure.plot.width > 560 ? " class=\"wide\"" : "",
      HtmlName(figure.title));
  html += figure.missing.empty()
              ? FigureSvg(figure) + Paragraph(figure.note, "soft small")
              : "<p class=\"absent\">" + HtmlText(figure.missing) + "</p>";
  return html + "</figure>\n";
}

std::string Grid(const std::string& figures, const char* style) {
  if (figures.empty()) return "";
  return fmt::format("<div class=\"{}\">\n{}</div>\n", style, figures);
}

// Those of one place, by the model they are of; small ones in a grid of their
// own.
std::string FiguresHtml(const ComponentFigures& figures, FigurePlace place) {
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
    html += Grid(large, "figures") + Grid(small, "figures many");
  }
  return html;
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
                     const ComponentFigures& figures) const;
  std::string Card(const ReportView& view) const;
  std::string Evidence(const ReportView& view) const;
  std::string Residuals(const ReportView& view,
                        const ComponentFigures& figures) const;
  std::string Fits(const ReportView& view,
                   const ComponentFigures& figures) const;
  std::string Polynomials(const ReportView& view, bool brief) const;
  std::string Data(const ReportView& view,
                   const ComponentFigures& figures) const;
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
      "aria-label=\"Components\"><table><thead><tr><th scope=\"col\" "
      "class=\"t\">component</th><th scope=\"col\" class=\"t\">use</th>"
      "<th scope=\"col\" class=\"t\">error</th><th scope=\"col\" "
      "class=\"t\">hold-out</th><th scope=\"col\" class=\"t\">goal</th>"
      "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Headline line = HeadlineOf(views[i]);
    const std::string_view goal =
        line.goal_standing == models::GoalStanding::kNone
            ? "none"
            : models::ToString(line.goal_standing);
    html += fmt::format(
        "<tr><td class=\"t\"><a href=\"#c{}\">{}</a></td><td "
        "class=\"t\">{}</td><td class=\"t\">{}</td><td class=\"t\">{}</td>"
        "<td class=\"t\">{}</td></tr>\n",
        i + 1,
        HtmlName(views[i].name),
        views[i].recommended.empty() ? "nothing"
                                     : HtmlName(views[i].recommended),
        line.error.empty() ? "not known" : HtmlText(line.error),
        views[i].decisive.empty() ? "none" : HtmlName(views[i].decisive),
        goal);
  }
  return html + "</tbody></table></div></nav>\n";
}

std::string Page::Card(const ReportView& view) const {
  const Headline line = HeadlineOf(view);
  std::string html = "<div class=\"card\">\n";
  html += "<p class=\"sentence\">" + HtmlText(line.sentence) + "</p>\n";
  if (!line.error.empty()) {
    html += "<p class=\"number\">" + HtmlText(line.error) + "</p>\n";
    html += Paragraph(line.where +
                      (line.interval.empty() ? "" : "; " + line.interval));
  }
  if (!line.goal.empty()) {
    html +=
        fmt::format("<p class=\"goal{}\">{}</p>\n",
                    line.goal_standing == models::GoalStanding::kNone  ? " none"
                    : line.goal_standing == models::GoalStanding::kMet ? " met"
                                                                       : "",
                    HtmlText(line.goal));
  }
  if (!line.beside.empty())
    html += Paragraph("Beside it: " + line.beside + ".");
  if (!line.cost.empty()) html += Paragraph(line.cost + ".");
  if (!line.sensors.empty()) {
    html += Paragraph("Sensors: " + line.sensors + ".", "small");
  }
  html += Paragraph(line.why, "small");
  return html + "</div>\n";
}

std::string Page::Answer(const ReportView& view,
                         const ComponentFigures& figures) const {
  const Headline line = HeadlineOf(view);
  std::string html = "<div class=\"answer\">\n<div>" + Card(view);
  html += Paragraph(kSignConvention, "soft small") + "</div>\n<div>";
  for (const Figure& figure : figures.figures) {
    if (figure.place == FigurePlace::kAnswer) {
      html += FigureHtml(figure);
    }
  }
  html += "</div>\n</div>\n" + HtmlTable(PageLeaderboard(view));
  return html + List("Reasons", line.reasons) + List("Caveats", line.caveats);
}

std::string Page::Evidence(const ReportView& view) const {
  std::string html = "<h3>Is it more than chance?</h3>\n";
  std::vector<std::string> lines;
  for (const models::VerdictRecord& verdict : view.component->verdict) {
    if (!verdict.why.empty()) lines.push_back(verdict.why);
  }
  html += List("", lines);
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
  std::string html = "<h3>Residuals</h3>\n";
  if (!view.recommended.empty()) {
    html += fmt::format(
        "<p>Held-out residuals of the recommended model{} under {}.</p>\n",
        view.rival.empty()
            ? ""
            : " and of its strongest rival, " + HtmlName(view.rival) + ",",
        HtmlName(view.decisive));
  }
  html += FiguresHtml(figures, FigurePlace::kResiduals);
  const std::string every = FiguresHtml(figures, FigurePlace::kEveryModel);
  if (!every.empty()) {
    html += "<h4>Residuals of every model, " + HtmlName(view.decisive) +
            "</h4>\n" + every;
  }
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
  return "<h3>The fits</h3>\n" + FiguresHtml(figures, FigurePlace::kFits) +
         HtmlTable(RunTable(view)) +
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
    content += model.equation.empty()
                   ? Paragraph("The equation was not kept.", "absent")
                   : "<div class=\"equation\" tabindex=\"0\" role=\"region\" "
                     "aria-label=\"equation\">" +
                         HtmlText(model.equation) + "</div>\n";
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
  if (html.empty()) {
    html = brief ? "" : Paragraph("No model has an equation.", "absent");
  }
  return html.empty() ? html : "<h3>Equations and coefficients</h3>\n" + html;
}

std::string Page::Data(const ReportView& view,
                       const ComponentFigures& figures) const {
  const models::DataRecord& measured = view.component->data;
  std::string html = "<h3>Data and hold-outs</h3>\n";
  html +=
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
  return html + FiguresHtml(figures, FigurePlace::kData);
}

std::string Page::Component(const ReportView& view, std::size_t index) const {
  static const ComponentFigures none;
  const ComponentFigures& figures =
      index < figures_.components.size() ? figures_.components[index] : none;
  const bool brief = figures.detail == FigureDetail::kBrief;
  std::string html = Answer(view, figures);
  if (brief) {
    html += HtmlTable(ComparisonTable(view, view.decisive));
  } else {
    html += Evidence(view);
  }
  html += Residuals(view, figures);
  html += brief ? HtmlTable(RunTable(view)) : Fits(view, figures);
  html += Polynomials(view, brief) + Data(view, figures);
  if (brief) {
    html +=
        "<p class=\"soft small\">A short form, for the page has many "
        "components: errmap report DIR --figures DIR2 draws every figure, "
        "and results.json has every number.</p>\n";
  }
  if (NumComponents() <= kOpenComponents) {
    return fmt::format("<section id=\"c{}\">\n{}</section>\n", index + 1, html);
  }
  const Headline line = HeadlineOf(view);
  // The anchor lies inside, so that a link opens what is closed.
  return fmt::format(
      "<details class=\"component\"><summary>{} <span>{}</span></summary>\n"
      "<section id=\"c{}\">\n{}<p><a href=\"#top\">Back to the "
      "index</a></p></section></details>\n",
      HtmlName(view.name),
      line.error.empty()
          ? "no result"
          : HtmlName(view.recommended) + ", " + HtmlText(line.error),
      index + 1,
      html);
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
      title + "</title>\n<style>" + kReportStyle +
      "</style>\n</head>\n<body>\n";
  html += "<header id=\"top\"><h1>" + title + "</h1></header>\n<main>\n";
  html += Notices();
  if (views.size() > kOpenComponents) html += Index(views);
  for (std::size_t i = 0; i < views.size(); ++i) {
    html += Component(views[i], i);
  }
  if (record_.machine) {
    html += "<section id=\"machine\">\n<h2>The machine</h2>\n";
    for (const Table& table : MachineTables(*record_.machine)) {
      html += HtmlTable(table);
    }
    html += "</section>\n";
  }
  html += "<h3>Provenance</h3>\n" + HtmlTable(ProvenanceTable(record_));
  html += "</main>\n<footer>";
  const std::string& version = record_.version;
  html += fmt::format(
      "<p>Drawn by errmap{} from results.json beside this file; errmap report "
      "DIR draws it anew. {}</p>",
      version.empty() ? "" : " " + HtmlText(version),
      HtmlText(kSignConvention));
  return html + "</footer>\n</body>\n</html>\n";
}

}  // namespace

std::string ReportHtml(const models::StudyRecord& record,
                       const FigureSet& figures) {
  return Page(record, figures).Html();
}

}  // namespace errmap::cli
