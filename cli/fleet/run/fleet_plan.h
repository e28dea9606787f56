#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/desk/study_config.h"

namespace errmap::fleet {

/// What a fleet may cost, from a sample of its components.
struct FleetPlan {
  std::int64_t components = 0;
  std::int64_t looked_at = 0;         // of them, evenly
  double fits = 0.0;                  // of all, as those looked at have
  double seconds = 0.0;               // on one processor
  double largest_mib = 0.0;           // memory of the largest looked at
  std::vector<std::string> unusable;  // of those looked at: why, a line each
};

/// Of an expanded study.
FleetPlan PlanFleet(const desk::StudyConfig& config);

}  // namespace errmap::fleet
