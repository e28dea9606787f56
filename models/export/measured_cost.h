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
  // In CPU time, which stands still while the system runs something else.
  /// One step, of many made one after the other.
  double median_ns = 0.0;
  /// Of a hundred thousand steps made alone, less what reading the clock takes:
  /// what 99.9 % of them stay below, and the slowest. That one is mostly this
  /// system's interrupts, which are counted as the program's.
  double high_ns = 0.0;
  double worst_ns = 0.0;
};

/// The compiler and its flags, for people and JSON.
inline constexpr const char* kCostCompiler = "cc -std=c99 -O2";

/// Compiles the map's C and runs it. Nothing, with the reason in `why`, where
/// there is no compiler.
std::optional<MeasuredCost> MeasureCost(const MapExport& map, std::string* why);

}  // namespace errmap::models
