#pragma once

#include <string>
#include <vector>

#include "models/export/language.h"
#include "models/export/program/map_program.h"
#include "models/export/program/self_test.h"

namespace errmap::models {

/// A map ready to be written, and what its program was found to lose.
struct MapExport {
  std::string name;  // a safe identifier
  Precision precision = Precision::kDouble;
  MapProgram program = {};
  std::vector<SelfTestRow> rows = {};  // ControllerSession
  std::size_t num_checked = 0;         // rows held against the map itself
  double error_range = 0.0;            // target's unit
  Deviations deviations = {};          // from the map

  /// What a file may differ from the map by when it tests itself (target's
  /// unit): AllowedDeviation, or twice what was found where a map's own sums
  /// cancel, so that no order of them is better.
  double tolerance() const;
};

/// When a map acts.
enum class Motion { kAny, kIncreasing, kDecreasing };
/// Throws std::invalid_argument where the map is made for rows of another
/// direction of motion than it would act in.
void RequireMadeFor(const FittedModel& fitted, Motion motion);

/// Longest name of an exported map.
inline constexpr std::size_t kLongestMapName = 40;

/// Makes the program of one map, or of those of increasing and decreasing
/// positions, with its controller, and holds it against each map. Throws
/// std::invalid_argument as MakeMapProgram, JoinedPrograms and AddController,
/// on a name that is no safe identifier of at most kLongestMapName characters,
/// and where single precision loses more than AllowedDeviation within the
/// trained range.
MapExport PrepareExport(const std::vector<const FittedModel*>& maps,
                        const std::string& name,
                        Precision precision,
                        const LimitOptions& limits = {});

}  // namespace errmap::models
