#include "cli/report/start_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "stats/summary.h"

namespace errmap::cli {
namespace {

using models::StartResult;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Of the final costs that are finite.
struct CostSpread {
  std::size_t finite = 0;
  double min = kNaN;
  double median = kNaN;
  double max = kNaN;
  double sd = kNaN;  // n - 1; NaN for fewer than two
};

CostSpread SpreadOf(const std::vector<StartResult>& starts) {
  std::vector<double> costs;
  for (const StartResult& start : starts) {
    if (std::isfinite(start.final_cost)) costs.push_back(start.final_cost);
  }
  CostSpread spread;
  spread.finite = costs.size();
  if (costs.empty()) return spread;
  std::ranges::sort(costs);
  const std::size_t half = costs.size() / 2;
  spread.min = costs.front();
  spread.max = costs.back();
  spread.median = costs.size() % 2 == 1 ? costs[half]
                                        : 0.5 * (costs[half - 1] + costs[half]);
  if (costs.size() > 1) {
    spread.sd = stats::Summarize(
                    Eigen::Map<const Eigen::VectorXd>(
                        costs.data(), static_cast<Eigen::Index>(costs.size())))
                    .sd;
  }
  return spread;
}

}  // namespace

Json ChoicesJson(const std::vector<models::EffectiveOption>& choices) {
  Json json = Json::object();
  for (const models::EffectiveOption& choice : choices) {
    std::visit([&](const auto& value) { json[choice.key] = value; },
               choice.value);
  }
  return json;
}

Json StartsJson(const std::vector<StartResult>& starts) {
  Json table = Json::array();
  for (const StartResult& start : starts) {
    table.push_back({{"seed", start.seed},
                     {"final_cost", start.final_cost},
                     {"stop", fitting::ToString(start.termination)},
                     {"iterations", start.iterations},
                     {"holdout_rmse", start.holdout_rmse},
                     {"chosen", start.chosen}});
  }
  const CostSpread spread = SpreadOf(starts);
  return {{"table", std::move(table)},
          {"spread",
           {{"finite", spread.finite},
            {"min", spread.min},
            {"median", spread.median},
            {"max", spread.max},
            {"sd", spread.sd}}}};
}

std::string StartsText(const std::vector<StartResult>& starts,
                       const ErrorText& error) {
  if (starts.empty()) return "";
  std::string text = fmt::format(
      "{} starts, * the one taken: lowest cost\n"
      "{:>22}  {:>12}  {:>10}  {:>14}  stop\n",
      starts.size(),
      "seed",
      "cost",
      "iterations",
      "held-out RMSE");
  for (const StartResult& start : starts) {
    text += fmt::format("{}{:>21}  {:>12.6g}  {:>10}  {:>14}  {}\n",
                        start.chosen ? "*" : " ",
                        start.seed,
                        start.final_cost,
                        start.iterations,
                        std::isfinite(start.holdout_rmse)
                            ? error.WithUnit(start.holdout_rmse)
                            : std::string("-"),
                        fitting::ToString(start.termination));
  }
  const CostSpread spread = SpreadOf(starts);
  return text +
         fmt::format("costs from {:.6g} to {:.6g}, median {:.6g}, sd {:.3g}\n",
                     spread.min,
                     spread.max,
                     spread.median,
                     spread.sd);
}

}  // namespace errmap::cli
