#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "stats/not_a_number.h"

namespace errmap::fitting {

/// Why a minimisation ended. Only kGradient, kResolution and kDirect claim a
/// minimum.
enum class Termination {
  kDirect,           // solved directly (linear least squares)
  kFailed,           // no usable point: x0 infeasible, or never run
  kCostGoal,         // sqrt(2 f) < cost goal: as requested, minimum or not
  kGradient,         // gradient small against the parameters: converged
  kSlowProgress,     // cost hardly falls any more, not converged
  kNoDescent,        // no step lowers the cost, not converged
  kIterationLimit,   // not converged
  kEvaluationLimit,  // not converged
  kTimeLimit,        // not converged
  kInterrupted,      // stopped from outside, not converged
  kResolution,       // no step lowers the cost, at its minimum: converged
};

/// "gradient", "iteration_limit", ...: the name in JSON and tables.
std::string_view ToString(Termination termination);

/// Returns true for kGradient, kResolution and kDirect. Reaching a goal or a
/// limit is not convergence.
bool IsConverged(Termination termination);

/// Returns sqrt(2 f), the report's rmserr. If f < 0, impossible for a sum of
/// squares, returns -sqrt(-2 f), so that a lower cost gives a lower number.
double RmsError(double cost);

/// One point of an error-reduction curve.
struct TracePoint {
  std::int64_t iteration = 0;
  double rms_error = 0.0;  // RmsError(f)
  double gradient_norm = 0.0;
};

/// Result of a minimisation. By default it states that none has run.
struct FitSummary {
  Termination termination = Termination::kFailed;
  std::string message = "not run";
  double initial_cost = stats::kNaN;
  double final_cost = stats::kNaN;
  double initial_gradient_norm = stats::kNaN;
  double final_gradient_norm = stats::kNaN;
  std::int64_t iterations = 0;
  std::int64_t value_evaluations = 0;      // f alone
  std::int64_t gradient_evaluations = 0;   // f with gradient
  std::int64_t curvature_evaluations = 0;  // p'Hp along a direction
  double seconds = 0.0;
  /// Seconds per iteration, sd with n-1 (Table 4); NaN if there are too few.
  double mean_iteration_seconds = stats::kNaN;
  double sd_iteration_seconds = stats::kNaN;
  std::vector<TracePoint> trace;  // empty unless requested

  bool converged() const { return IsConverged(termination); }
  std::int64_t evaluations() const {
    return value_evaluations + gradient_evaluations + curvature_evaluations;
  }
};

}  // namespace errmap::fitting
