#include "cli/report/words/commands/fit_summary.h"

#include <cmath>

#include <fmt/format.h>

namespace errmap::report {

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

}  // namespace errmap::report
