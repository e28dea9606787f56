#include "fitting/minimisers/fit_summary.h"

#include <array>
#include <cmath>

namespace errmap::fitting {

std::string_view ToString(Termination termination) {
  // In the order of the enumeration.
  constexpr auto kNames = std::to_array<std::string_view>({"direct",
                                                           "failed",
                                                           "cost_goal",
                                                           "gradient",
                                                           "slow_progress",
                                                           "no_descent",
                                                           "iteration_limit",
                                                           "evaluation_limit",
                                                           "time_limit",
                                                           "interrupted",
                                                           "cost_resolution"});
  const auto place = static_cast<std::size_t>(termination);
  return place < kNames.size() ? kNames[place] : "failed";
}

bool IsConverged(Termination termination) {
  return termination == Termination::kGradient ||
         termination == Termination::kResolution ||
         termination == Termination::kDirect;
}

double RmsError(double cost) {
  return std::copysign(std::sqrt(2.0 * std::abs(cost)), cost);
}

}  // namespace errmap::fitting
