#include <algorithm>
#include <cmath>

#include "models/study/record/builders/parts.h"
#include "stats/summary.h"

namespace errmap::models {
namespace {

CostSpreadRecord SpreadOf(const std::vector<StartResult>& starts) {
  std::vector<double> costs;
  for (const StartResult& start : starts) {
    if (std::isfinite(start.final_cost)) costs.push_back(start.final_cost);
  }
  CostSpreadRecord spread;
  spread.finite = std::ssize(costs);
  if (costs.empty()) return spread;
  std::ranges::sort(costs);
  const std::size_t half = costs.size() / 2;
  spread.min = costs.front();
  spread.max = costs.back();
  spread.median = costs.size() % 2 == 1 ? costs[half]
                                        : 0.5 * (costs[half - 1] + costs[half]);
  if (costs.size() > 1) {
    spread.sd = stats::Summarize(
                    Eigen::Map<const VectorXd>(costs.data(), std::ssize(costs)))
                    .sd;
  }
  return spread;
}

}  // namespace

SummaryRecord MakeRecord(const fitting::FitSummary& summary) {
  SummaryRecord record{.stop = summary.termination,
                       .converged = summary.converged(),
                       .message = summary.message,
                       .iterations = summary.iterations,
                       .evaluations = summary.evaluations(),
                       .value_evaluations = summary.value_evaluations,
                       .gradient_evaluations = summary.gradient_evaluations,
                       .curvature_evaluations = summary.curvature_evaluations,
                       .initial_cost = summary.initial_cost,
                       .final_cost = summary.final_cost,
                       .initial_gradient_norm = summary.initial_gradient_norm,
                       .final_gradient_norm = summary.final_gradient_norm,
                       .mean_iteration_seconds = summary.mean_iteration_seconds,
                       .sd_iteration_seconds = summary.sd_iteration_seconds};
  if (summary.trace.empty()) return record;
  auto& trace = record.trace.emplace();
  for (const fitting::TracePoint& point : summary.trace) {
    trace.emplace_back(point.iteration, point.rms_error, point.gradient_norm);
  }
  return record;
}

StartsRecord MakeRecord(const std::vector<StartResult>& starts) {
  return {.table = starts, .spread = SpreadOf(starts)};
}

ByName<OptionValue> MakeRecord(const std::vector<EffectiveOption>& options) {
  ByName<OptionValue> record;
  for (const EffectiveOption& option : options) {
    record.emplace_back(option.key, option.value);
  }
  return record;
}

FitRecord MakeFitRecord(double fit_seconds,
                        const fitting::FitSummary& summary,
                        const std::vector<std::string>& remarks,
                        const std::vector<EffectiveOption>& choices,
                        const std::vector<StartResult>& starts) {
  FitRecord record{.fit_seconds = fit_seconds,
                   .summary = {MakeRecord(summary)},
                   .remarks = remarks};
  if (!choices.empty()) record.choices = MakeRecord(choices);
  if (!starts.empty()) record.starts = MakeRecord(starts);
  return record;
}

}  // namespace errmap::models
