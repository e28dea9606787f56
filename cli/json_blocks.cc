#include "cli/json_blocks.h"

namespace errmap::cli {

Json MetricsJson(const stats::ErrorMetrics& metrics) {
  return {{"n", metrics.residuals.n},
          {"mean", metrics.residuals.mean},
          {"sd", metrics.residuals.sd},
          {"rmse", metrics.rmse},
          {"mae", metrics.mae},
          {"min", metrics.residuals.min},
          {"max", metrics.residuals.max},
          {"range", metrics.residuals.range},
          {"r2", metrics.r2}};
}

std::string DumpJson(const Json& document) {
  constexpr int kIndent = 1;
  // Names from files may hold any bytes: what is no UTF-8 is replaced.
  return document.dump(kIndent, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

}  // namespace errmap::cli
