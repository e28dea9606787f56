#include "cli/fleet/store/fleet_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/table.h"
#include "data/text.h"
#include "models/study/record/record_json.h"

namespace errmap::fleet {

struct FleetResults {
  std::string schema;
  std::vector<models::ComponentSummary> components;
};

namespace {

using models::ComponentSummary;
using models::ModelStatus;

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
  std::size_t failed = 0;
  std::size_t met = 0;
  std::size_t missed = 0;
  std::size_t without = 0;
  for (const ComponentSummary& summary : summaries) {
    if (!summary.recommendation) {
      ++failed;
      continue;
    }
    const models::GoalStanding goal = summary.recommendation->goal;
    met += goal == models::GoalStanding::kMet ? 1 : 0;
    missed += goal == models::GoalStanding::kMissed ||
                      goal == models::GoalStanding::kMetAfterRezeroing
                  ? 1
                  : 0;
    without += goal == models::GoalStanding::kNone ? 1 : 0;
  }
  // Where none has a goal there is nothing to say of it.
  std::vector<std::string> parts;
  if (met + missed > 0) {
    parts.push_back(fmt::format("goal met by {}, not met by {}", met, missed));
    if (without > 0) parts.push_back(fmt::format("no goal for {}", without));
  }
  if (failed > 0) parts.push_back(fmt::format("{} failed", failed));
  return report::Count(std::ssize(summaries), "component") +
         (parts.empty() ? "" : ": " + data::JoinWords(parts, ", ")) + ".\n";
}

// A row per component: what is recommended and how it does.
report::Table FleetTable(const std::vector<ComponentSummary>& summaries) {
  report::Table table;
  table.columns = {{.name = "component", .is_number = false},
                   {.name = "status", .is_number = false},
                   {.name = "recommended", .is_number = false},
                   {.name = "hold-out", .is_number = false},
                   {.name = "before"},
                   {.name = "rmse"},
                   {.name = "unit", .is_number = false},
                   {.name = "goal", .is_number = false}};
  for (const ComponentSummary& summary : summaries) {
    std::vector<report::Cell> row{report::Cell(std::string_view(summary.name)),
                                  report::Cell(ToString(summary.status))};
    if (summary.recommendation) {
      const auto& found = *summary.recommendation;
      const double scale = summary.display.scale;
      row.insert(row.end(),
                 {report::Cell(std::string_view(found.model)),
                  report::Cell(std::string_view(found.holdout)),
                  report::Cell(report::Number{found.uncompensated, 4, scale}),
                  report::Cell(report::Number{found.rmse, 4, scale}),
                  report::Cell(std::string_view(summary.display.unit)),
                  report::Cell(ToString(found.goal))});
    }
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

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
