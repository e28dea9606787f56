#include "cli/report/learning_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/units.h"
#include "models/learning/sensor_curve.h"

namespace errmap::report {
namespace {

using ::testing::HasSubstr;

std::string Words(models::QuantilesRecord units_for_goal) {
  const models::LearningCurvesRecord curves{
      .unit = "day", .units = 6, .goal = 2.0, .models = {}};
  models::LearningModelRecord model;
  model.law = models::LearningLawRecord{.units_for_goal = units_for_goal,
                                        .never_reaches_goal = 0.0};
  return LawWords(curves, model, ErrorText(data::UnitOfSymbol("um"), 1.0));
}

// Its median alone may contradict the curve, which is noisy at few days.
TEST(LawWords, GiveTheRangeOfDaysThatReachTheGoal) {
  EXPECT_THAT(Words({1.0, 2.0, 4.0}),
              HasSubstr(" is reached with 1 to 4 of the 6"));
  EXPECT_THAT(Words({3.0, 3.0, 3.0}),
              HasSubstr(" is reached with about 3 of the 6"));
  EXPECT_THAT(Words({2.0, 3.0, 9.0}),
              HasSubstr(" is reached with about 3 of the 6"));
}

TEST(EnoughWords, SayThatAllSensorsAreNeeded) {
  models::SensorCurve curve;
  curve.all.sensors = 5;
  curve.enough = 3;
  EXPECT_EQ(EnoughWords(curve), "3 of 5 sensors are enough, within 5 % of all");
  curve.enough = 5;
  EXPECT_EQ(EnoughWords(curve),
            "All 5 sensors are needed; fewer add over 5 % to the error");
}

}  // namespace
}  // namespace errmap::report
