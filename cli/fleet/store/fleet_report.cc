#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/fleet/store/merge.h"
#include "cli/report/documents/report_html.h"
#include "cli/report/figures/figures.h"
#include "cli/report/figures/svg.h"
#include "cli/report/html.h"
#include "cli/report/number_text.h"
#include "cli/report/plot.h"
#include "cli/report/report_view.h"
#include "cli/report/shell_word.h"
#include "cli/report/table.h"

namespace errmap::fleet {
namespace {

using models::GoalStanding;

bool HasMap(const ComponentSummary& summary) {
  return summary.recommendation.has_value();
}

std::string Collapsed(const std::string& title,
                      const std::string& content,
                      bool open = false) {
  return fmt::format("<details{}><summary>{}</summary>\n{}</details>\n",
                     open ? " open" : "",
                     report::HtmlText(title),
                     content);
}

class FleetPage {
 public:
  FleetPage(const StorePaths& paths, const FleetSummaries& found)
      : paths_(paths), found_(found) {
    for (const ComponentSummary& summary : found.summaries) all_.Add(summary);
    std::map<std::string, int> units;
    for (const ComponentSummary& summary : found.summaries) {
      if (!HasMap(summary)) continue;
      const int count = ++units[summary.display.unit];
      if (count > units[unit_]) unit_ = summary.display.unit;
    }
  }

  std::string Html() const {
    const std::string title = fmt::format(
        "Error maps of {}", report::Count(all_.components, "component"));
    return StorePage(title,
                     Answer() + All() + ByField(0) + ByField(1) + Worst() +
                         Failures() + Footer());
  }

 private:
  std::string Answer() const {
    const std::int64_t judged = all_.met + all_.missed;
    std::string card = "<div class=\"card\">";
    std::string sentence =
        judged > 0 ? fmt::format(
                         "{} of {} with a goal meet it on rows that no fit saw",
                         all_.met,
                         report::Count(judged, "component"))
                   : report::Count(all_.components - all_.failed, "component") +
                         " with a map, and no goal to judge by";
    if (all_.failed > 0) sentence += fmt::format("; {} failed", all_.failed);
    if (!found_.missing.empty()) {
      sentence += fmt::format("; {} are missing", found_.missing.size());
    }
    card += "<p class=\"sentence\">" + sentence + ".</p>";
    if (judged > 0) {
      card += fmt::format("<p class=\"number\">{:.0f} %</p>",
                          report::kPercent * static_cast<double>(all_.met) /
                              static_cast<double>(judged));
    }
    if (std::isfinite(all_.Left())) {
      card += fmt::format(
          "<p>{:.0f} % of the error without a map is left (geometric "
          "mean).</p>",
          report::kPercent * all_.Left());
    }
    return "<div class=\"answer\"><div>" + card + report::HtmlTable(Winners()) +
           "</div>" + Matrix() + "</div><div>" + Distribution() +
           "</div></div>\n";
  }

  // Where polynomials, nets, or maps that remember win.
  report::Table Winners() const {
    std::map<std::string, std::pair<std::int64_t, std::int64_t>> counts;
    for (const ComponentSummary& summary : found_.summaries) {
      if (!HasMap(summary)) continue;
      auto& [maps, remember] =
          counts[std::string(ToString(summary.recommendation->choice))];
      ++maps;
      remember += summary.recommendation->longest_memory ? 1 : 0;
    }
    report::Table table;
    for (const auto& [choice, count] : counts) {
      table.Add({{{"recommended", false}, choice},
                 {{"components"}, count.first},
                 {{"with a memory"}, count.second}});
    }
    table.SayIfEmpty("no component has a map");
    return table;
  }

  // Share of the components up to an error, before and after.
  std::string Distribution() const {
    report::Series before{.label = "no map",
                          .mark = report::Mark::kLine,
                          .colour = "#A33A00",
                          .size = 2.2};
    report::Series after{
        .label = "recommended map", .mark = report::Mark::kLine, .size = 2.2};
    std::vector<double> errors_before;
    std::vector<double> errors_after;
    std::int64_t left_out = 0;
    for (const ComponentSummary& summary : found_.summaries) {
      if (!HasMap(summary)) continue;
      if (summary.display.unit != unit_) {
        ++left_out;
        continue;
      }
      const double scale = summary.display.scale;
      errors_before.push_back(scale * summary.recommendation->uncompensated);
      errors_after.push_back(scale * summary.recommendation->rmse);
    }
    before.columns = Shares(std::move(errors_before));
    after.columns = Shares(std::move(errors_after));
    report::Plot plot;
    plot.name = "distribution";
    plot.x = {.quantity = "RMSE held out",
              .unit = report::PrettyUnit(unit_),
              .logarithmic = true};
    plot.y = {.quantity = "components up to it",
              .unit = "%",
              .low = 0.0,
              .high = report::kPercent};
    plot.series = {before, after};
    if (!report::HasPoints(plot)) {
      return "<figure><figcaption><b>Errors before and after</b></figcaption>"
             "<p class=\"absent\">No component has a map.</p></figure>";
    }
    return FigureHtml(
        plot,
        "Errors before and after",
        "Errors before and after",
        left_out == 0 ? "Share of the components whose error is at most this"
                      : fmt::format("Share of the components whose error is at "
                                    "most this; {} in another unit are left "
                                    "out",
                                    left_out));
  }

  // Steps of (error, percent of the errors up to it), at most kMost.
  static std::vector<std::vector<double>> Shares(std::vector<double> errors) {
    constexpr std::size_t kMost = 200;
    std::erase_if(errors, [](double e) { return !(e > 0.0) || std::isinf(e); });
    std::ranges::sort(errors);
    std::vector<std::vector<double>> columns(2);
    const std::size_t points = std::min(errors.size(), kMost);
    for (std::size_t i = 0; i < points; ++i) {
      const std::size_t at =
          points == 1 ? 0 : i * (errors.size() - 1) / (points - 1);
      columns[0].insert(columns[0].end(), 2, errors[at]);
      columns[1].push_back(i == 0 ? 0.0 : columns[1].back());
      columns[1].push_back(report::kPercent * static_cast<double>(at + 1) /
                           static_cast<double>(errors.size()));
    }
    return columns;
  }

  // Machines by components: the error of each, of several the one that is the
  // most times its goal.
  std::string Matrix() const {
    using Column = std::map<std::string, const ComponentSummary*>;
    std::map<std::string, Column> rows;
    std::set<std::string> columns;
    const auto over_goal = [](const ComponentSummary& summary) {
      return summary.recommendation->rmse / summary.goal;
    };
    for (const ComponentSummary& summary : found_.summaries) {
      if (summary.fields.size() < 2 || !HasMap(summary)) continue;
      const std::string& column = summary.fields[1].second;
      columns.insert(column);
      const ComponentSummary*& cell = rows[summary.fields[0].second][column];
      if (cell == nullptr || over_goal(summary) > over_goal(*cell)) {
        cell = &summary;
      }
    }
    if (rows.size() < 2 || columns.size() < 2) return "";
    const auto head = [](const std::string& name) {
      return "<th class=\"t\">" + report::HtmlName(name) + "</th>";
    };
    std::string html = "<tr>" + head(FieldName(0));
    for (const std::string& column : columns) html += head(column);
    html += "</tr>\n";
    for (const auto& [name, cells] : rows) {
      html += "<tr><td class=\"t\">" + report::HtmlName(name) + "</td>";
      for (const std::string& column : columns) {
        const auto cell = cells.find(column);
        html += cell == cells.end() ? "<td></td>" : ErrorCell(*cell->second);
      }
      html += "</tr>\n";
    }
    return Collapsed(
        fmt::format("Error by {} and {}", FieldName(0), FieldName(1)),
        report::ScrolledTable("Errors", html),
        rows.size() <= kMostShown);
  }

  // Green where the goal is met, red where it is not.
  static std::string ErrorCell(const ComponentSummary& summary) {
    const auto& found = *summary.recommendation;
    const char* const tone = found.goal == GoalStanding::kMet    ? "good"
                             : found.goal == GoalStanding::kNone ? "soft"
                                                                 : "bad";
    return fmt::format(
        "<td class=\"{}\">{:.3g} {}</td>",
        tone,
        summary.display.scale * found.rmse,
        report::HtmlText(report::PrettyUnit(summary.display.unit)));
  }

  std::string FieldName(std::size_t field) const {
    for (const ComponentSummary& summary : found_.summaries) {
      if (summary.fields.size() > field) return summary.fields[field].first;
    }
    return "";
  }

  std::string ByField(std::size_t field) const {
    std::map<std::string, FleetTally> tallies;
    for (const ComponentSummary& summary : found_.summaries) {
      if (summary.fields.size() > field) {
        tallies[summary.fields[field].second].Add(summary);
      }
    }
    if (tallies.empty()) return "";
    report::Table table;
    for (const auto& [value, tally] : tallies) {
      table.Add({{{FieldName(field), false}, value},
                 {{"components"}, tally.components},
                 {{"goal met"}, tally.met},
                 {{"not met"}, tally.missed},
                 {{"failed"}, tally.failed},
                 {{"error left, %"},
                  report::Number{report::kPercent * tally.Left(), 3}}});
    }
    return Collapsed(fmt::format("By {}: {}", FieldName(field), tallies.size()),
                     report::HtmlTable(table));
  }

  std::string Worst() const {
    constexpr std::size_t kMost = 20;
    std::vector<std::pair<double, const ComponentSummary*>> worst;
    for (const ComponentSummary& summary : found_.summaries) {
      if (!HasMap(summary)) continue;
      const double ratio = summary.recommendation->rmse / summary.goal;
      if (ratio > 1.0 && std::isfinite(ratio)) {
        worst.emplace_back(ratio, &summary);
      }
    }
    std::ranges::stable_sort(
        worst, std::greater(), [](const auto& entry) { return entry.first; });
    if (worst.size() > kMost) worst.resize(kMost);
    if (worst.empty()) return "";
    std::string html =
        "<tr><th "
        "class=\"t\">component</th><th>RMSE</th><th>goal</th><th>without a "
        "map</th><th class=\"t\">unit</th><th class=\"t\">recommended</th>"
        "</tr>\n";
    for (const auto& [ratio, summary] : worst) {
      const auto& found = *summary->recommendation;
      const double scale = summary->display.scale;
      html += fmt::format(
          "<tr><td class=\"t\">{}</td><td>{:.3g}</td><td>{:.3g}</td><td>{}</td>"
          "<td class=\"t\">{}</td><td class=\"t\">{}</td></tr>\n",
          Linked(*summary),
          scale * found.rmse,
          scale * summary->goal,
          std::isfinite(found.uncompensated)
              ? fmt::format("{:.3g}", scale * found.uncompensated)
              : "-",
          report::HtmlText(report::PrettyUnit(summary->display.unit)),
          report::HtmlName(found.model));
    }
    return "<h2>The worst against their goals</h2>\n" +
           report::ScrolledTable("The worst", html) + "\n";
  }

  std::string Failures() const {
    std::string list;
    for (const ComponentSummary& summary : found_.summaries) {
      if (HasMap(summary)) continue;
      list += "<li>" + report::HtmlName(summary.name) + ": " +
              report::HtmlText(summary.why.value_or("")) + "</li>\n";
    }
    for (const std::string& name : found_.missing) {
      list += "<li>" + report::HtmlName(name) +
              ": missing, run its share again</li>\n";
    }
    if (list.empty()) return "";
    return Collapsed("Components that failed or are missing",
                     "<ul>" + list + "</ul>");
  }

  // Of so many that a page holds no picture of each.
  static constexpr std::size_t kMostPictures = 1000;
  // Of so many that the page begins with all of them.
  static constexpr std::size_t kMostShown = 60;

  // "unseen day", what the error is of.
  static std::string Unseen(const ComponentSummary& summary) {
    for (const SummaryHoldoutRecord& holdout : summary.holdouts) {
      if (holdout.name == summary.recommendation->holdout) {
        return "unseen " + holdout.unit_of_analysis;
      }
    }
    return "";
  }

  std::string All() const {
    const bool pictures = found_.summaries.size() <= kMostPictures;
    std::string rows;
    for (const ComponentSummary& summary : found_.summaries) {
      if (!HasMap(summary)) continue;
      const auto& found = *summary.recommendation;
      const double scale = summary.display.scale;
      std::string interval;
      if (std::isfinite(found.ci95[0]) && std::isfinite(found.ci95[1])) {
        interval = fmt::format(
            "{:.3g}-{:.3g}", scale * found.ci95[0], scale * found.ci95[1]);
      }
      rows += fmt::format(
          "<tr><td class=\"t\">{}</td><td class=\"t\">{}</td><td>{:.3g} {}</td>"
          "<td class=\"t\">{}</td><td>{}</td>{}<td class=\"t\">{}</td><td "
          "class=\"t\"><code>errmap deploy {} {}</code></td></tr>\n",
          Linked(summary),
          report::HtmlName(found.model),
          scale * found.rmse,
          report::HtmlText(report::PrettyUnit(summary.display.unit)),
          report::HtmlText(Unseen(summary)),
          interval,
          pictures ? "<td class=\"t\">" +
                         report::IntervalPicture(
                             found.rmse, found.ci95, found.uncompensated) +
                         "</td>"
                   : "",
          ToString(found.goal),
          report::HtmlText(report::ShellWord(paths_.store)),
          report::HtmlText(report::ShellWord(summary.name)));
    }
    if (rows.empty()) return "";
    return Collapsed(
        "All components",
        report::ScrolledTable(
            "All components",
            fmt::format("<tr><th class=\"t\">component</th><th "
                        "class=\"t\">use</th><th>error</th>"
                        "<th class=\"t\">of an</th><th>95 %</th>{}<th "
                        "class=\"t\">goal</th>"
                        "<th class=\"t\">to hand it over</th></tr>\n{}",
                        pictures ? "<th class=\"t\">remaining error</th>" : "",
                        rows)),
        found_.summaries.size() <= kMostShown);
  }

  // Its page where that has been drawn.
  std::string Linked(const ComponentSummary& summary) const {
    std::error_code ignored;
    if (!std::filesystem::exists(paths_.InFolder(summary.name, kPageFile),
                                 ignored)) {
      return report::HtmlName(summary.name);
    }
    return fmt::format("<a href=\"{}/{}\">{}</a>",
                       report::HtmlText(paths_.FolderOf(summary.name)),
                       kPageFile,
                       report::HtmlName(summary.name));
  }

  std::string Footer() const {
    return fmt::format(
        "<p class=\"soft small\">errmap {}, study {}, seed {}. A component's "
        "own "
        "page: errmap report STORE --component NAME. Errors are RMSE on rows "
        "held out of the fit, error = actual - nominal.</p>\n",
        report::HtmlText(found_.fleet.version),
        report::HtmlText(found_.fleet.file),
        found_.fleet.seed);
  }

  const StorePaths& paths_;
  const FleetSummaries& found_;
  FleetTally all_;
  std::string unit_;  // of most components
};

}  // namespace

std::string StorePage(const std::string& title, const std::string& main) {
  return report::PageHtml(
      title,
      fmt::format("<header><h1>{}</h1></header>\n<main>\n{}</main>\n",
                  report::HtmlText(title),
                  main));
}

std::string FigureHtml(const report::Plot& plot,
                       const std::string& caption,
                       const std::string& title,
                       const std::string& description) {
  return fmt::format(
      "<figure><figcaption><b>{}</b></figcaption>{}<p class=\"soft "
      "small\">{}</p></figure>\n",
      caption,
      report::Svg(plot, title, description),
      report::HtmlText(description));
}

std::string FleetReportHtml(const StorePaths& paths,
                            const FleetSummaries& found) {
  return FleetPage(paths, found).Html();
}

}  // namespace errmap::fleet
