#pragma once

#include <limits>
#include <string_view>

#include "stats/error_metrics.h"

namespace errmap::models {

/// How a held-out error stands to what the user needs.
enum class GoalStanding {
  kNone,               // no goal was set
  kNotJudged,          // too few rows, an interrupted run, or a failed fit
  kMet,                // the RMSE is at most the goal
  kMetAfterRezeroing,  // only the sd is: an offset, taken off, would do
  kMissed,
};

/// "no goal", "not judged", "met", "met after re-zeroing", "not met".
std::string_view ToString(GoalStanding standing);

/// A goal with what was held against it, in the target's unit.
struct GoalJudgement {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  GoalStanding standing = GoalStanding::kNone;
  double goal = kNaN;
  double rmse = kNaN;
  double sd = kNaN;      // n - 1
  double offset = kNaN;  // mean of target - predicted
};

/// Rows held out that a goal asks for: chance lets a poor map meet it on fewer.
inline constexpr Eigen::Index kFewestRowsForGoal = 24;

/// Holds `test`, a model's held-out errors, against `goal` (target's unit; NaN:
/// none). `complete`: every fold was fitted and the study ran to its end; what
/// an interrupted one leaves may be what was easy, and is not judged. Nor are
/// fewer than kFewestRowsForGoal rows.
GoalJudgement JudgeGoal(double goal,
                        const stats::ErrorMetrics& test,
                        bool complete);

}  // namespace errmap::models
