#pragma once

#include <cstdint>
#include <string>

#include "cli/fleet/run/fleet_plan.h"

namespace errmap::cli {

/// For a terminal: on `tasks` shares of `jobs` processors.
std::string FleetPlanText(const fleet::FleetPlan& plan,
                          std::int64_t tasks,
                          int jobs,
                          const std::string& out);

}  // namespace errmap::cli
