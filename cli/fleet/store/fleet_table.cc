#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/fleet/store/merge.h"
#include "cli/report/table.h"
#include "data/text.h"
#include "models/record_json.h"

namespace errmap::fleet {

struct FleetResults {
  std::string schema;
  std::vector<ComponentSummary> components;
};

namespace {

// How far from its goal, or from what there was without a map: the worst first.
double Badness(const ComponentSummary& summary) {
  if (!summary.recommendation) return HUGE_VAL;
  const double rmse = summary.recommendation->rmse;
  const double against = std::isfinite(summary.goal)
                             ? summary.goal
                             : summary.recommendation->uncompensated;
  return std::isfinite(rmse) && against > 0.0 ? rmse / against : 0.0;
}

std::string Headline(const std::vector<ComponentSummary>& summaries) {
  FleetTally all;
  for (const ComponentSummary& summary : summaries) all.Add(summary);
  // Where none has a goal there is nothing to say of it.
  std::vector<std::string> parts;
  if (all.met + all.missed > 0) {
    parts.push_back(
        fmt::format("goal met by {}, not met by {}", all.met, all.missed));
    if (all.without_goal > 0) {
      parts.push_back(fmt::format("no goal for {}", all.without_goal));
    }
  }
  if (all.failed > 0) parts.push_back(fmt::format("{} failed", all.failed));
  return report::Count(all.components, "component") +
         (parts.empty() ? "" : ": " + data::JoinWords(parts, ", ")) + ".\n";
}

// A row per component: what is recommended and how it does.
report::Table FleetTable(const std::vector<ComponentSummary>& summaries) {
  report::Table table;
  table.columns = {{"component", false},
                   {"status", false},
                   {"recommended", false},
                   {"hold-out", false},
                   {"before"},
                   {"rmse"},
                   {"unit", false},
                   {"goal", false}};
  for (const ComponentSummary& summary : summaries) {
    std::vector<report::Cell> row{summary.name, ToString(summary.status)};
    if (summary.recommendation) {
      const auto& found = *summary.recommendation;
      const double scale = summary.display.scale;
      row.insert(row.end(),
                 {found.model,
                  found.holdout,
                  report::Number{found.uncompensated, 4, scale},
                  report::Number{found.rmse, 4, scale},
                  summary.display.unit,
                  ToString(found.goal)});
    }
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

void FleetTally::Add(const ComponentSummary& summary) {
  using models::GoalStanding;
  ++components;
  if (!summary.recommendation) {
    ++failed;
    return;
  }
  const auto& found = *summary.recommendation;
  met += found.goal == GoalStanding::kMet ? 1 : 0;
  missed += found.goal == GoalStanding::kMissed ||
                    found.goal == GoalStanding::kMetAfterRezeroing
                ? 1
                : 0;
  without_goal += found.goal == GoalStanding::kNone ? 1 : 0;
  if (found.rmse > 0.0 && found.uncompensated > 0.0) {
    log_ratio += std::log(found.rmse / found.uncompensated);
    ++ratios;
  }
}

double FleetTally::Left() const {
  return ratios == 0 ? models::kNotKnown
                     : std::exp(log_ratio / static_cast<double>(ratios));
}

std::string FormattedFleet(const std::vector<ComponentSummary>& summaries,
                           const std::string& format,
                           std::size_t columns) {
  if (auto text = report::TableText(FleetTable(summaries), format)) {
    return *std::move(text);
  }
  if (format == "json") {
    return models::JsonText(FleetResults{"errmap-fleet-results-1", summaries},
                            1) +
           "\n";
  }
  constexpr std::size_t kMostShown = 20;
  std::vector<ComponentSummary> worst = summaries;
  std::string note;
  if (worst.size() > kMostShown) {
    std::ranges::stable_sort(worst, std::greater(), Badness);
    worst.resize(kMostShown);
    note = fmt::format("The worst {} against their goals:\n", kMostShown);
  }
  return Headline(summaries) + note +
         report::TerminalTable(FleetTable(worst), columns);
}

}  // namespace errmap::fleet
