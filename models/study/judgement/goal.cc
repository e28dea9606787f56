#include "models/study/judgement/goal.h"

#include <array>
#include <cmath>

#include "data/text.h"

namespace errmap::models {

std::string_view ToString(GoalStanding standing) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"no goal", "not judged", "met", "met after re-zeroing", "not met"});
  return data::NameOf(kNames, standing);
}

GoalJudgement JudgeGoal(double goal,
                        const stats::ErrorMetrics& test,
                        bool complete,
                        bool rezeroed) {
  GoalJudgement judged{
      .goal = goal, .rmse = test.rmse, .sd = test.sd, .offset = test.mean};
  if (!std::isfinite(goal)) {
    judged.standing = GoalStanding::kNone;
  } else if (!complete || !std::isfinite(judged.rmse) ||
             test.n < kFewestRowsForGoal) {
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
