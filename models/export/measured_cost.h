#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "models/export/export_map.h"

namespace errmap::models {

/// What this machine's compiler and processor make of an exported map.
struct MeasuredCost {
  std::int64_t code_bytes = 0;
  std::int64_t constant_bytes = 0;
  /// One step, of many made one after the other.
  double median_ns = 0.0;
  /// The slowest of a hundred thousand steps made alone, less what reading the
  /// clock takes: on a system that is not real-time, interrupts included.
  double worst_ns = 0.0;
};

/// The compiler and its flags, for people and JSON.
inline constexpr const char* kCostCompiler = "cc -std=c99 -O2";

/// Compiles the map's C and runs it. Nothing, with the reason in `why`, where
/// there is no compiler.
std::optional<MeasuredCost> MeasureCost(const MapExport& map, std::string* why);

}  // namespace errmap::models
