#pragma once

#include <string>
#include <vector>

#include "models/export/language.h"
#include "models/export/program/map_program.h"
#include "models/export/program/self_test.h"

namespace errmap::models {

/// A map ready to be written, and the deviation of its program from it.
struct MapExport {
  std::string name;  // a safe identifier
  Precision precision = Precision::kDouble;
  MapProgram program = {};
  std::vector<SelfTestRow> rows = {};  // ControllerSession
  std::size_t num_checked = 0;         // rows compared with the map itself
  double error_range = 0.0;            // target's unit
  Deviations deviations = {};          // from the map

  /// Largest deviation allowed in a file's self-test (target's unit). It is
  /// AllowedDeviation, or twice the deviation found if that is larger. The
  /// map's own sums then cancel, so no order of summation is more accurate.
  double tolerance() const;
};

/// The direction of motion in which a map acts.
enum class Motion { kAny, kIncreasing, kDecreasing };
/// Throws std::invalid_argument if the map was made for rows of another
/// direction of motion than `motion`.
void RequireMadeFor(const FittedModel& fitted, Motion motion);

/// Longest name of an exported map.
inline constexpr std::size_t kLongestMapName = 40;

/// Makes the program of one map, or of one map each for increasing and
/// decreasing positions, with its controller. Compares it with each map. Throws
/// std::invalid_argument as MakeMapProgram, JoinedPrograms and AddController.
/// Also throws if the name is not a safe identifier of at most kLongestMapName
/// characters. It throws, too, if single precision loses more than
/// AllowedDeviation within the trained range.
MapExport PrepareExport(const std::vector<const FittedModel*>& maps,
                        const std::string& name,
                        Precision precision,
                        const LimitOptions& limits = {});

}  // namespace errmap::models
