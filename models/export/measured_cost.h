#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "models/export/export_map.h"

namespace errmap::models {

/// Size and time of an exported map with this machine's compiler and processor.
struct MeasuredCost {
  std::int64_t code_bytes = 0;
  std::int64_t constant_bytes = 0;
  // CPU time, which excludes other programs.
  /// Time of one step within many consecutive steps.
  double median_ns = 0.0;
  /// Quantile 99.9 % and maximum of 100 000 steps timed one by one, minus the
  /// time to read the clock. The maximum is mostly due to this system's
  /// interrupts, which count as the program's time.
  double high_ns = 0.0;
  double worst_ns = 0.0;
};

/// The compiler and its flags, for display and JSON.
inline constexpr const char* kCostCompiler = "cc -std=c99 -O2";

/// Compiles the map's C and runs it. If that fails here, returns nothing and
/// sets `why` to the reason.
std::optional<MeasuredCost> MeasureCost(const MapExport& map, std::string* why);

}  // namespace errmap::models
