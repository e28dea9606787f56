#include "cli/report/documents/start_report.h"

#include <cmath>

#include <fmt/format.h>

#include "models/study/record/making/parts.h"

namespace errmap::report {

std::string StartsText(const std::vector<models::StartResult>& starts,
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
  for (const models::StartResult& start : starts) {
    text += fmt::format("{}{:>21}  {:>12.6g}  {:>10}  {:>14}  {}\n",
                        start.chosen ? "*" : " ",
                        start.seed,
                        start.final_cost,
                        start.iterations,
                        std::isfinite(start.holdout_rmse)
                            ? error.WithUnit(start.holdout_rmse)
                            : std::string("-"),
                        fitting::ToString(start.stop));
  }
  const models::CostSpreadRecord spread = models::MakeRecord(starts).spread;
  return text +
         fmt::format("costs from {:.6g} to {:.6g}, median {:.6g}, sd {:.3g}\n",
                     spread.min,
                     spread.max,
                     spread.median,
                     spread.sd);
}

}  // namespace errmap::report
