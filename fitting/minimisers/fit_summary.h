#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::fitting {

/// Why a minimisation ended. Only kGradient, kResolution and kDirect claim a
/// minimum.
enum class Termination {
  kDirect,           // solved in one go (linear least squares)
  kFailed,           // no usable point: x0 infeasible, or never run
  kCostGoal,         // sqrt(2 f) < cost goal: as asked, a minimum or not
  kGradient,         // gradient small against the parameters: converged
  kSlowProgress,     // cost hardly falls any more, not converged
  kNoDescent,        // no step lowers the cost, not converged
  kIterationLimit,   // not converged
  kEvaluationLimit,  // not converged
  kTimeLimit,        // not converged
  kInterrupted,      // stopped from outside, not converged
  kResolution,       // no step lowers the cost, at its minimum: converged
};

/// "gradient", "iteration_limit", ...: the word in JSON and tables.
std::string_view ToString(Termination termination);

/// True for kGradient, kResolution and kDirect: a goal or a limit reached is no
/// minimum.
bool IsConverged(Termination termination);

/// sqrt(2 f), the report's rmserr; where f is below 0, which no sum of squares
/// is, -sqrt(-2 f): a lower cost is a lower number.
double RmsError(double cost);

/// One line of an error-reduction curve.
struct TracePoint {
  std::int64_t iteration = 0;
  double rms_error = 0.0;  // RmsError(f)
  double gradient_norm = 0.0;
};

/// What a minimisation did. Born saying that it has not run.
struct FitSummary {
  Termination termination = Termination::kFailed;
  std::string message = "not run";
  double initial_cost = std::numeric_limits<double>::quiet_NaN();
  double final_cost = std::numeric_limits<double>::quiet_NaN();
  double initial_gradient_norm = std::numeric_limits<double>::quiet_NaN();
  double final_gradient_norm = std::numeric_limits<double>::quiet_NaN();
  std::int64_t iterations = 0;
  std::int64_t value_evaluations = 0;      // f alone
  std::int64_t gradient_evaluations = 0;   // f with gradient
  std::int64_t curvature_evaluations = 0;  // p'Hp along a direction
  double seconds = 0.0;
  /// Of one iteration, n-1 in the sd (Table 4); NaN for too few of them.
  double mean_iteration_seconds = std::numeric_limits<double>::quiet_NaN();
  double sd_iteration_seconds = std::numeric_limits<double>::quiet_NaN();
  std::vector<TracePoint> trace;  // empty unless asked for

  bool converged() const { return IsConverged(termination); }
  std::int64_t evaluations() const {
    return value_evaluations + gradient_evaluations + curvature_evaluations;
  }
};

}  // namespace errmap::fitting
