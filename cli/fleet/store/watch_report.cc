#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "cli/fleet/store/merge.h"
#include "cli/fleet/store/watched_maps.h"
#include "cli/report/html.h"
#include "cli/report/plot.h"
#include "cli/report/report_view.h"
#include "cli/report/shell_word.h"
#include "stats/comparison/paired_comparison.h"

namespace errmap::fleet {
namespace {

using models::WatchStatus;

// The sessions checked at their places from 1 on; of many some, and the newest.
std::vector<std::pair<std::string, double>> Sessions(
    const WatchedComponent& component) {
  constexpr std::size_t kMost = 8;
  const std::size_t count = component.checks.size();
  const std::size_t apart = (count + kMost - 1) / kMost;
  std::vector<std::pair<std::string, double>> names;
  for (std::size_t i = count; i > 0; i -= std::min(i, apart)) {
    names.emplace_back(component.checks[i - 1].session.label,
                       static_cast<double>(i));
  }
  return names;
}

std::string Figure(const WatchedComponent& component, std::size_t number) {
  const double scale = component.deployment.shown_scale;
  report::Series found{.label = "found", .mark = report::Mark::kPoints};
  report::Series line{.label = "", .mark = report::Mark::kLine};
  report::Series promised{.label = "promised",
                          .mark = report::Mark::kLine,
                          .colour = "#A33A00",
                          .dashed = true};
  for (std::size_t i = 0; i < component.checks.size(); ++i) {
    const auto x = static_cast<double>(i + 1);
    found.Add({x, scale * std::sqrt(component.checks[i].session.mean_square)});
    promised.Add({x, scale * component.deployment.promised});
  }
  // A line needs two ends.
  if (component.checks.size() == 1) {
    promised.Add({2.0, scale * component.deployment.promised});
  }
  line.columns = found.columns;
  report::Plot plot;
  plot.name = fmt::format("watched-{}", number);
  plot.x = {.quantity = "session since it was deployed",
            .names = Sessions(component)};
  plot.y = {.quantity = "RMSE",
            .unit = report::PrettyUnit(component.deployment.shown_unit),
            .low = 0.0};
  plot.series = {promised, line, found};
  const std::string description =
      fmt::format("RMSE of each session checked since {}; the newest: {}",
                  component.deployment.since,
                  ToString(component.status));
  const std::string& name = component.deployment.component;
  return FigureHtml(plot, report::HtmlName(name), name, description);
}

}  // namespace

std::string WatchedComponent::Proposal(const std::string& store) const {
  const std::string map =
      report::ShellWord(StorePaths{store}.Map(deployment.map));
  // update judges each session by a map that has seen the others.
  const auto measure = [&](const char* what) {
    return fmt::format(
        "measure {}{}, then errmap update {} {} -o new.json; if that is "
        "better, errmap deploy {} {} --model new.json",
        what,
        file_sessions < 2 ? " until the file has two sessions or more" : "",
        map,
        report::ShellWord(file),
        report::ShellWord(store),
        report::ShellWord(deployment.component));
  };
  switch (status) {
    case WatchStatus::kWorse:
      // More than half of the mean square is one offset.
      if (judgement &&
          2.0 * judgement->offset * judgement->offset > found * found) {
        return fmt::format(
            "an offset of {:.3g} {}: errmap check {} {} says whether to "
            "re-zero",
            deployment.shown_scale * judgement->offset,
            deployment.shown_unit,
            map,
            report::ShellWord(file));
      }
      return measure("more of this state");
    case WatchStatus::kDoubtful:
      return "measure one more session, then errmap watch again";
    case WatchStatus::kSensorChanged:
      return fmt::format("look at the sensor {}: moved, loose or drifting?",
                         checks.back().session.sensor);
    case WatchStatus::kOutside:
      return measure("these states");
    case WatchStatus::kTooFewRows:
      return fmt::format("errmap check {} {} says more about so few rows",
                         map,
                         report::ShellWord(file));
    case WatchStatus::kAsPromised:
    case WatchStatus::kNotJudged:
      break;
  }
  return why_not;
}

std::string WatchHeadline(const std::vector<WatchedComponent>& components) {
  std::map<std::string_view, int> counts;
  int judged = 0;
  for (const WatchedComponent& component : components) {
    ++counts[ToString(component.status)];
    judged += std::isfinite(component.p_map) ? 1 : 0;
  }
  std::string text = report::Count(std::ssize(components), "component");
  for (const auto& [status, count] : counts) {
    text += fmt::format(", {} {}", count, status);
  }
  if (judged == 0) return text;
  // By its error and by its sensors.
  return text + fmt::format(
                    "; by chance, {1:.2g} of {0} healthy ones would be called "
                    "worse or changed",
                    judged,
                    2.0 * models::kSurelyChanged * judged);
}

report::Table WatchTable(const std::vector<WatchedComponent>& components,
                         bool brief) {
  report::Table table;
  table.columns = {{"component", false},
                   {"status", false},
                   {"found"},
                   {"promised"},
                   {"unit", false},
                   {"p"},
                   {"sensor", false},
                   {"p sensor"},
                   {"shift"},
                   {"sessions"}};
  if (brief) table.columns.resize(table.columns.size() - 2);
  for (const WatchedComponent& component : components) {
    std::vector<report::Cell> row{component.deployment.component,
                                  ToString(component.status)};
    if (component.examined) {
      const double scale = component.deployment.shown_scale;
      const models::WatchedSession& newest = component.checks.back().session;
      row.insert(row.end(),
                 {report::Number{component.found, 3, scale},
                  report::Number{component.deployment.promised, 3, scale},
                  component.deployment.shown_unit,
                  report::P{component.p_map},
                  brief && newest.p_sensor > stats::kSignificance
                      ? report::Cell()
                      : report::Cell(newest.sensor),
                  report::P{newest.p_sensor},
                  report::Number{newest.sensor_shift, 3},
                  std::ssize(component.checks)});
    }
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
  }
  table.SayIfEmpty("no component has a map deployed and new measurements");
  return table;
}

namespace {

// Its place on the page, the worst first; what nothing was found of last.
std::ptrdiff_t Rank(const WatchedComponent& component) {
  static constexpr std::array kFirst = {WatchStatus::kWorse,
                                        WatchStatus::kSensorChanged,
                                        WatchStatus::kDoubtful,
                                        WatchStatus::kOutside};
  return std::ranges::find(kFirst, component.status) - kFirst.begin();
}

// A row for each of whom something is to be done.
report::Table ToDo(const std::string& store,
                   const std::vector<WatchedComponent>& sorted) {
  report::Table table;
  for (const WatchedComponent& component : sorted) {
    const std::string proposal = component.Proposal(store);
    if (proposal.empty()) continue;
    const Deployment& deployment = component.deployment;
    const double scale = deployment.shown_scale;
    table.Add({{{"component", false}, deployment.component},
               {{"verdict", false}, ToString(component.status)},
               {{"map", false}, deployment.model},
               {{"found"}, report::Number{component.found, 3, scale}},
               {{"promised"}, report::Number{deployment.promised, 3, scale}},
               {{"unit", false}, report::PrettyUnit(deployment.shown_unit)},
               {{"what to do", false}, proposal}});
  }
  table.SayIfEmpty("nothing is to be done");
  return table;
}

}  // namespace

std::string WatchHtml(const std::string& store,
                      const std::vector<WatchedComponent>& components) {
  constexpr std::size_t kMostFigures = 60;
  std::vector<WatchedComponent> sorted = components;
  std::ranges::stable_sort(sorted, {}, Rank);
  std::string figures;
  std::size_t number = 0;
  for (const WatchedComponent& component : sorted) {
    if (Rank(component) < 3 && number < kMostFigures) {
      figures += Figure(component, ++number);
    }
  }
  const std::string title = fmt::format(
      "Maps watched: {}", report::Count(std::ssize(components), "component"));
  return StorePage(
      title,
      fmt::format(
          "<div class=\"card\"><p class=\"sentence\">{}.</p></div>\n{}<div "
          "class=\"figures\">{}</div>\n<details><summary>All "
          "components</summary>\n{}</details>\n<p class=\"soft small\">p "
          "compares each session with held-out sessions at similar times and "
          "places, by t statistics. A component is worse or changed if its p "
          "is below {:g}. Worse also needs an error {:g} % above the promised "
          "one.</p>\n",
          report::HtmlText(WatchHeadline(components)),
          report::HtmlTable(ToDo(store, sorted)),
          figures,
          report::HtmlTable(WatchTable(sorted)),
          models::kSurelyChanged,
          100.0 * models::kLeastWorse));
}

}  // namespace errmap::fleet
