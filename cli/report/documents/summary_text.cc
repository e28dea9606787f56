#include "cli/report/documents/summary_text.h"

#include <cmath>

#include <fmt/format.h>

namespace errmap::report {
namespace {

std::string Line(const std::string& label,
                 double value,
                 const data::Unit& unit,
                 const std::string& note = "") {
  if (!std::isfinite(value)) {
    return fmt::format("  {:<10} n/a{}\n", label, note);
  }
  return fmt::format(
      "  {:<10} {:.5g}{}{}\n",
      label,
      value * unit.display_scale,
      unit.display_symbol.empty() ? "" : " " + unit.display_symbol,
      note);
}

}  // namespace

std::string SummaryText(const stats::ErrorMetrics& metrics,
                        const data::Unit& unit,
                        double ks_d,
                        double ks_p_given) {
  std::string text = fmt::format("  {:<10} {}\n", "n", metrics.n);
  text += Line("mean", metrics.mean, unit);
  text += Line("sd", metrics.sd, unit, "  (n - 1)");
  text += Line("rmse", metrics.rmse, unit, "  (n)");
  text += Line("mae", metrics.mae, unit);
  text += Line("min", metrics.min, unit);
  text += Line("max", metrics.max, unit);
  text += Line("range", metrics.range, unit);
  if (std::isfinite(metrics.r2)) {
    text += fmt::format("  {:<10} {:.6f}\n", "r2", metrics.r2);
  }
  if (std::isfinite(ks_d)) {
    text += fmt::format(
        "  {:<10} {:.5f}, p {:.4g} (Eq. 140; mean and sd are estimated\n  "
        "{:<10} from these values, so p is too large)\n",
        "K-S D",
        ks_d,
        ks_p_given,
        "");
  } else {
    text += fmt::format("  {:<10} n/a (the values do not vary)\n", "K-S D");
  }
  return text;
}

}  // namespace errmap::report
