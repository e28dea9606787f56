#include "models/study/judgement/goal.h"

#include <cmath>

#include <gtest/gtest.h>

namespace errmap::models {
namespace {

// Residuals of sd `sd` about `offset`, n large.
stats::ErrorMetrics Metrics(double offset, double sd) {
  stats::ErrorMetrics metrics;
  metrics.n = 1000;
  metrics.mean = offset;
  metrics.sd = sd;
  metrics.rmse = std::hypot(offset, sd);
  return metrics;
}

TEST(Goal, IsMetWhereTheRmseIsAtMostTheGoal) {
  const auto standing = [](double offset, double sd) {
    return JudgeGoal(0.5, Metrics(offset, sd), true).standing;
  };
  EXPECT_EQ(standing(0.0, 0.5), GoalStanding::kMet);
  EXPECT_EQ(standing(0.3, 0.4), GoalStanding::kMet);
  EXPECT_EQ(standing(0.0, 0.51), GoalStanding::kMissed);
  // 0.2 um of scatter about an offset of 5 um is not a map good to 0.5 um.
  EXPECT_EQ(standing(4.98, 0.2), GoalStanding::kMetAfterRezeroing);
  EXPECT_EQ(standing(-4.98, 0.5), GoalStanding::kMetAfterRezeroing);
  EXPECT_EQ(standing(-4.98, 0.6), GoalStanding::kMissed);
}

// What re-zeroing left is not re-zeroed once more.
TEST(Goal, IsMissedByAMapThatIsRezeroedAlready) {
  const auto standing = [](double offset, double sd) {
    return JudgeGoal(0.5, Metrics(offset, sd), true, true).standing;
  };
  EXPECT_EQ(standing(4.98, 0.2), GoalStanding::kMissed);
  EXPECT_EQ(standing(0.3, 0.4), GoalStanding::kMet);
}

TEST(Goal, IsNotJudgedOnFewRows) {
  stats::ErrorMetrics metrics = Metrics(0.0, 0.1);
  metrics.n = kFewestRowsForGoal - 1;
  EXPECT_EQ(JudgeGoal(0.5, metrics, true).standing, GoalStanding::kNotJudged);
  metrics.n = kFewestRowsForGoal;
  EXPECT_EQ(JudgeGoal(0.5, metrics, true).standing, GoalStanding::kMet);
}

TEST(Goal, CarriesTheNumbersItWasHeldAgainst) {
  const GoalJudgement judged = JudgeGoal(0.5, Metrics(-0.3, 0.4), true);
  EXPECT_EQ(judged.goal, 0.5);
  EXPECT_EQ(judged.rmse, 0.5);
  EXPECT_EQ(judged.sd, 0.4);
  EXPECT_EQ(judged.offset, -0.3);
}

TEST(Goal, IsNotJudgedWithoutOneOrOnAnIncompleteStudy) {
  EXPECT_EQ(JudgeGoal(std::nan(""), Metrics(0.0, 0.1), true).standing,
            GoalStanding::kNone);
  EXPECT_EQ(JudgeGoal(0.5, Metrics(0.0, 0.1), false).standing,
            GoalStanding::kNotJudged);
  EXPECT_EQ(JudgeGoal(0.5, Metrics(0.0, std::nan("")), true).standing,
            GoalStanding::kNotJudged);
}

}  // namespace
}  // namespace errmap::models
