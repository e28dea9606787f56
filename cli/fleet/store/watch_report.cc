#include "cli/fleet/store/watch_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/fleet/store/store_folder.h"
#include "cli/report/documents/report_style.h"
#include "cli/report/figures/svg.h"
#include "cli/report/html.h"
#include "cli/report/plot.h"
#include "cli/report/shell_word.h"

namespace errmap::fleet {
namespace {

using models::WatchStatus;

std::string Figure(const WatchedComponent& component, std::size_t number) {
  const double scale = component.deployment.shown_scale;
  report::Series found{.label = "found", .mark = report::Mark::kPoints};
  report::Series line{.label = "", .mark = report::Mark::kLine};
  report::Series promised{.label = "promised",
                          .mark = report::Mark::kLine,
                          .colour = "#A33A00",
                          .dashed = true};
  found.columns.resize(2);
  promised.columns.resize(2);
  for (std::size_t i = 0; i < component.checks.size(); ++i) {
    const auto x = static_cast<double>(i + 1);
    found.columns[0].push_back(x);
    found.columns[1].push_back(
        scale * std::sqrt(component.checks[i].session.mean_square));
    promised.columns[0].push_back(x);
    promised.columns[1].push_back(scale * component.deployment.promised);
  }
  // A line needs two ends.
  promised.columns[0].push_back(
      static_cast<double>(component.checks.size() + 1));
  promised.columns[1].push_back(scale * component.deployment.promised);
  line.columns = found.columns;
  report::Plot plot;
  plot.name = fmt::format("watched-{}", number);
  plot.x = {.quantity = "session since it was deployed"};
  plot.y = {
      .quantity = "RMSE", .unit = component.deployment.shown_unit, .low = 0.0};
  plot.series = {promised, line, found};
  const std::string description =
      fmt::format("RMSE of each session checked since {}; the newest: {}",
                  component.deployment.since,
                  ToString(component.status));
  return fmt::format(
      "<figure><figcaption><b>{}</b></figcaption>{}<p class=\"soft "
      "small\">{}</p></figure>\n",
      report::HtmlName(component.deployment.component),
      report::Svg(plot, component.deployment.component, description),
      report::HtmlText(description));
}

}  // namespace

std::string WatchedComponent::Proposal(const std::string& store) const {
  const auto measure = [&](const char* what) {
    return fmt::format(
        "measure {}, then errmap update {} {} -o new.json; where that is "
        "better, errmap deploy {} {} --model new.json",
        what,
        report::ShellWord(StorePaths{store}.Map(deployment.map)),
        report::ShellWord(file),
        report::ShellWord(store),
        report::ShellWord(deployment.component));
  };
  const auto outside = [&] {
    return checks.back().session.outside_share > models::kMostlyOutside;
  };
  switch (status) {
    case WatchStatus::kWorse:
      return measure(outside() ? "more of this state, unlike those trained on"
                               : "more of this state");
    case WatchStatus::kSensorChanged:
      return fmt::format("look at the sensor {}: moved, loose or drifting?",
                         checks.back().session.sensor);
    case WatchStatus::kOutside:
      return measure("these states");
    case WatchStatus::kAsPromised:
    case WatchStatus::kNotJudged:
      break;
  }
  return why_not;
}

report::Table WatchTable(const std::vector<WatchedComponent>& components) {
  report::Table table;
  table.columns = {{.name = "component", .is_number = false},
                   {.name = "status", .is_number = false},
                   {.name = "sessions"},
                   {.name = "found"},
                   {.name = "promised"},
                   {.name = "unit", .is_number = false},
                   {.name = "p"},
                   {.name = "sensor", .is_number = false},
                   {.name = "shift"},
                   {.name = "p sensor"}};
  for (const WatchedComponent& component : components) {
    std::vector<report::Cell> row{
        report::Cell(std::string_view(component.deployment.component)),
        report::Cell(ToString(component.status))};
    if (component.examined) {
      const double scale = component.deployment.shown_scale;
      const models::WatchedSession& newest = component.checks.back().session;
      row.insert(
          row.end(),
          {report::Cell(std::ssize(component.checks)),
           report::Cell(report::Number{component.found, 3, scale}),
           report::Cell(
               report::Number{component.deployment.promised, 3, scale}),
           report::Cell(std::string_view(component.deployment.shown_unit)),
           report::Cell(report::P{component.p_map}),
           report::Cell(std::string_view(newest.sensor)),
           report::Cell(report::Number{newest.sensor_shift, 3}),
           report::Cell(report::P{newest.p_sensor})});
    }
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
  }
  table.missing = "no component has a map deployed and new measurements";
  return table;
}

std::string WatchHtml(const std::string& store,
                      const std::vector<WatchedComponent>& components) {
  constexpr std::size_t kMostFigures = 60;
  std::vector<WatchedComponent> sorted = components;
  const auto rank = [](const WatchedComponent& component) {
    return component.status == WatchStatus::kWorse           ? 0
           : component.status == WatchStatus::kSensorChanged ? 1
           : component.status == WatchStatus::kOutside       ? 2
                                                             : 3;
  };
  std::ranges::stable_sort(sorted, {}, rank);
  std::string figures;
  std::string proposals;
  std::size_t number = 0;
  for (const WatchedComponent& component : sorted) {
    if (rank(component) < 3 && number < kMostFigures) {
      figures += Figure(component, ++number);
    }
    const std::string proposal = component.Proposal(store);
    if (proposal.empty()) continue;
    proposals += "<li>" + report::HtmlName(component.deployment.component) +
                 ": " + report::HtmlText(proposal) + "</li>\n";
  }
  const std::string title = fmt::format(
      "Maps watched: {}", report::Count(std::ssize(components), "component"));
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">\n<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"default-src 'none'; style-src 'unsafe-inline'; img-src "
      "data:\">\n<title>{0}</title>\n<style>{1}</style></head>\n<body>\n"
      "<header><h1>{0}</h1></header>\n<main>\n{2}<div "
      "class=\"figures\">{3}</div>\n{4}<p class=\"soft small\">p by t "
      "statistics of whole sessions against those held out when the map was "
      "made; at most {5:g} % of the components that are named worse or changed "
      "are so by chance (Benjamini and Hochberg 1995).</p>\n</main>\n"
      "</body></html>\n",
      report::HtmlText(title),
      report::kReportStyle,
      proposals.empty() ? "" : "<ul>" + proposals + "</ul>\n",
      figures,
      report::HtmlTable(WatchTable(sorted)),
      100.0 * models::kFalseDiscoveries);
}

}  // namespace errmap::fleet
