#include "fitting/minimisers/fit_summary.h"

#include <cmath>

namespace errmap::fitting {

std::string_view ToString(Termination termination) {
  switch (termination) {
    case Termination::kDirect:
      return "direct";
    case Termination::kFailed:
      return "failed";
    case Termination::kCostGoal:
      return "cost_goal";
    case Termination::kGradient:
      return "gradient";
    case Termination::kResolution:
      return "cost_resolution";
    case Termination::kSlowProgress:
      return "slow_progress";
    case Termination::kNoDescent:
      return "no_descent";
    case Termination::kIterationLimit:
      return "iteration_limit";
    case Termination::kEvaluationLimit:
      return "evaluation_limit";
    case Termination::kTimeLimit:
      return "time_limit";
    case Termination::kInterrupted:
      return "interrupted";
  }
  return "failed";
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
