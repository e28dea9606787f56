#include "models/uncertainty/map_update.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace errmap::models {
namespace {

UpdateTrial TrialOf(std::vector<UpdateTrial::Session> sessions) {
  UpdateTrial trial;
  trial.sessions = std::move(sessions);
  double old_squares = 0.0;
  double new_squares = 0.0;
  for (const UpdateTrial::Session& session : trial.sessions) {
    old_squares += session.old_rmse * session.old_rmse;
    new_squares += session.new_rmse * session.new_rmse;
  }
  const auto count = static_cast<double>(trial.sessions.size());
  trial.old_rmse = std::sqrt(old_squares / count);
  trial.new_rmse = std::sqrt(new_squares / count);
  return trial;
}

TEST(UpdateTrial, OneSessionFarOffOutweighsOneALittleBetter) {
  EXPECT_TRUE(TrialOf({{"1", 0.70, 0.74}, {"2", 11.9, 0.90}}).better(0.02));
}

// 0.07 lower in all, and 20 % higher in three of four.
TEST(UpdateTrial, OneSessionAloneDoesNotDecide) {
  const UpdateTrial trial = TrialOf(
      {{"1", 1.0, 1.2}, {"2", 1.0, 1.2}, {"3", 1.0, 1.2}, {"4", 3.0, 2.6}});
  ASSERT_LT(trial.new_rmse, trial.old_rmse - 0.02);
  EXPECT_FALSE(trial.better(0.02));
}

TEST(UpdateTrial, WhatDoesNotMatterIsNoReason) {
  EXPECT_FALSE(TrialOf({{"1", 0.70, 0.69}, {"2", 0.90, 0.89}}).better(0.02));
}

TEST(UpdateTrial, AFailedSuccessorIsNotBetter) {
  UpdateTrial trial = TrialOf({{"1", 2.0, 1.0}, {"2", 2.0, 1.0}});
  ASSERT_TRUE(trial.better(0.02));
  trial.why_failed = "no minimum";
  EXPECT_FALSE(trial.better(0.02));
}

// A successor would average both.
TEST(UpdateTrial, AnotherSignOrOffsetIsNotLearnt) {
  for (const auto member :
       {&UpdateTrial::negated_rmse, &UpdateTrial::shifted_rmse}) {
    UpdateTrial trial = TrialOf({{"1", 47.0, 40.0}, {"2", 36.0, 30.0}});
    ASSERT_TRUE(trial.better(0.02));
    trial.*member = 0.6;
    EXPECT_FALSE(trial.better(0.02));
    EXPECT_EQ(trial.is_negated(), member == &UpdateTrial::negated_rmse);
    EXPECT_EQ(trial.is_shifted(), member == &UpdateTrial::shifted_rmse);
    // It hardly explains more than the successor learns.
    trial.*member = 20.0;
    EXPECT_TRUE(trial.better(0.02));
  }
}

// A session that both maps predict exactly says nothing of either.
TEST(UpdateTrial, ASessionWithoutErrorsDecidesNothing) {
  EXPECT_TRUE(TrialOf({{"1", 0.0, 0.0}, {"2", 2.0, 1.0}}).better(0.02));
  EXPECT_FALSE(TrialOf({{"1", 1.0, 0.0}, {"2", 0.0, 1.0}}).better(-0.1));
}

}  // namespace
}  // namespace errmap::models
