#pragma once

#include <string_view>

#include "stats/error_metrics.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// Result of comparing a held-out error with the user's goal.
enum class GoalStanding {
  kNone,       // no goal was set
  kNotJudged,  // too few rows, an interrupted run, or a failed fit
  kMet,        // the RMSE is at most the goal
  /// Only the sd is at most the goal, so re-zeroing may suffice. Never set if
  /// the maps are already re-zeroed.
  kMetAfterRezeroing,
  kMissed,
};

/// "no goal", "not judged", "met", "met after re-zeroing", "not met".
std::string_view ToString(GoalStanding standing);

/// A goal with the error compared with it, in the target's unit.
struct GoalJudgement {
  GoalStanding standing = GoalStanding::kNone;
  double goal = stats::kNaN;
  double rmse = stats::kNaN;
  double sd = stats::kNaN;      // n - 1
  double offset = stats::kNaN;  // mean of target - predicted
};

/// Fewest held-out rows to judge a goal: with fewer, a poor map may meet it by
/// chance.
inline constexpr Index kFewestRowsForGoal = 24;

/// Compares `test`, a model's held-out errors, with `goal` (target's unit; NaN:
/// none). `complete`: every fold was fitted and the study ran to its end. An
/// interrupted study is not judged, since its folds may be the easy ones. Nor
/// are fewer than kFewestRowsForGoal rows. `rezeroed`: the errors are those
/// after re-zeroing.
GoalJudgement JudgeGoal(double goal,
                        const stats::ErrorMetrics& test,
                        bool complete,
                        bool rezeroed = false);

}  // namespace errmap::models
