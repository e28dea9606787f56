#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "stats/error_metrics.h"

namespace errmap::cli {

using Json = nlohmann::ordered_json;

/// {"n","mean","sd","rmse","mae","min","max","range","r2"}; what is not finite
/// becomes null.
Json MetricsJson(const stats::ErrorMetrics& metrics);

/// A document as every command prints it.
std::string DumpJson(const Json& document);

}  // namespace errmap::cli
