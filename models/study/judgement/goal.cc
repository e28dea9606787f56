#include "models/study/judgement/goal.h"

#include <cmath>

namespace errmap::models {

std::string_view ToString(GoalStanding standing) {
  switch (standing) {
    case GoalStanding::kNone:
      return "no goal";
    case GoalStanding::kNotJudged:
      return "not judged";
    case GoalStanding::kMet:
      return "met";
    case GoalStanding::kMetAfterRezeroing:
      return "met after re-zeroing";
    case GoalStanding::kMissed:
      return "not met";
  }
  return "";
}

GoalJudgement JudgeGoal(double goal,
                        const stats::ErrorMetrics& test,
                        bool complete,
                        bool rezeroed) {
  GoalJudgement judged{.goal = goal,
                       .rmse = test.rmse,
                       .sd = test.residuals.sd,
                       .offset = test.residuals.mean};
  if (!std::isfinite(goal)) {
    judged.standing = GoalStanding::kNone;
  } else if (!complete || !std::isfinite(judged.rmse) ||
             test.residuals.n < kFewestRowsForGoal) {
    judged.standing = GoalStanding::kNotJudged;
  } else if (judged.rmse <= goal) {
    judged.standing = GoalStanding::kMet;
  } else if (!rezeroed && judged.sd <= goal) {
    judged.standing = GoalStanding::kMetAfterRezeroing;
  } else {
    judged.standing = GoalStanding::kMissed;
  }
  return judged;
}

}  // namespace errmap::models
