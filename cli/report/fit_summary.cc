#include "cli/report/fit_summary.h"

#include <cmath>

#include <fmt/format.h>

namespace errmap::cli {

Json FitSummaryJson(const fitting::FitSummary& summary) {
  Json json = {{"stop", fitting::ToString(summary.termination)},
               {"converged", summary.converged()},
               {"message", summary.message},
               {"iterations", summary.iterations},
               {"evaluations", summary.evaluations()},
               {"value_evaluations", summary.value_evaluations},
               {"gradient_evaluations", summary.gradient_evaluations},
               {"curvature_evaluations", summary.curvature_evaluations},
               {"initial_cost", summary.initial_cost},
               {"final_cost", summary.final_cost},
               {"initial_gradient_norm", summary.initial_gradient_norm},
               {"final_gradient_norm", summary.final_gradient_norm},
               {"mean_iteration_seconds", summary.mean_iteration_seconds},
               {"sd_iteration_seconds", summary.sd_iteration_seconds}};
  if (!summary.trace.empty()) {
    Json& trace = json["trace"] = Json::array();
    for (const fitting::TracePoint& point : summary.trace) {
      trace.push_back({point.iteration, point.rms_error, point.gradient_norm});
    }
  }
  return json;
}

std::string FitSummaryText(const fitting::FitSummary& summary) {
  std::string text = fmt::format("stop: {} ({})\n",
                                 fitting::ToString(summary.termination),
                                 summary.message);
  if (summary.iterations == 0) return text;
  text += fmt::format(
      "{} iterations; evaluations: {} of value, {} of gradient, {} of "
      "curvature\n",
      summary.iterations,
      summary.value_evaluations,
      summary.gradient_evaluations,
      summary.curvature_evaluations);
  text += fmt::format(
      "sqrt(2 E) from {:.6g} to {:.6g}, |gradient| from {:.3g} to {:.3g}\n",
      std::sqrt(2.0 * summary.initial_cost),
      std::sqrt(2.0 * summary.final_cost),
      summary.initial_gradient_norm,
      summary.final_gradient_norm);
  constexpr double kMicroseconds = 1e6;
  text += fmt::format("{:.3g} s, an iteration {:.3g} us",
                      summary.seconds,
                      summary.mean_iteration_seconds * kMicroseconds);
  if (std::isfinite(summary.sd_iteration_seconds)) {
    text += fmt::format(" (sd {:.3g})",
                        summary.sd_iteration_seconds * kMicroseconds);
  }
  return text + "\n";
}

}  // namespace errmap::cli
