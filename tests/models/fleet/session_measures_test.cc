#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "models/fleet/watch.h"
#include "models/recipe_catalog.h"
#include "models/uncertainty/add_uncertainty.h"

namespace errmap::models {
namespace {

using ::testing::HasSubstr;

// Days of five cycles of six places; cycles count on through the days.
std::string Days(int first, int last, double shift) {
  std::string text = "day,cycle,position_mm,t1_degC,error_mm\n";
  std::mt19937_64 random(static_cast<unsigned>(first));
  const auto noise = [&] {
    return 0.001 * (static_cast<double>(random() % 2001) / 1000.0 - 1.0);
  };
  for (int day = first; day <= last; ++day) {
    const double of_day = noise();
    for (int cycle = 0; cycle < 5; ++cycle) {
      for (int place = 0; place < 6; ++place) {
        const double t = 20.0 + 0.5 * cycle + 0.1 * (day % 3);
        text +=
            std::to_string(day) + "," + std::to_string(5 * day + cycle) + "," +
            std::to_string(50 * place) + "," + std::to_string(t) + "," +
            std::to_string(0.002 * t + shift + of_day + 0.2 * noise()) + "\n";
      }
    }
  }
  return text;
}

// A map with the promise that `holdout` makes.
FittedModel MapOf(int days, const std::string& spec) {
  const data::Dataset dataset =
      data::MakeDataset(data::ParseCsv(Days(1, days, 0.0), "days.csv"), {})
          .dataset;
  FittedModel fitted = MakeRecipe("poly:full:degree=1")->Fit(dataset, {});
  const Holdout holdout = MakeHoldout(stats::ParseHoldout(spec), dataset, 1);
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  recipes.push_back(MakeRecipe("poly:full:degree=1"));
  const StudyResult study = RunStudy(dataset, {holdout}, recipes, {});
  AddUncertainty(dataset, holdout, study.models[0].holdouts[0], &fitted);
  return fitted;
}

WatchedSession Measured(const FittedModel& fitted, const std::string& text) {
  const auto sessions =
      MeasureSessions(fitted,
                      MakeMapRows(fitted, data::ParseCsv(text, "new.csv"), {}),
                      nullptr);
  EXPECT_EQ(sessions.size(), 1U);
  return sessions.front().session;
}

std::string FirstRows(const std::string& text, int rows) {
  std::size_t end = 0;
  for (int line = 0; line <= rows; ++line) end = text.find('\n', end) + 1;
  return text.substr(0, end);
}

// Five equal days: five runs of groups are the days, and a watch that went by
// the name judged none of sixty.
TEST(WhyNotWatched, GroupsThatCutAsSessionsDoAreSessions) {
  for (const char* spec : {"sessions:5", "groups:5"}) {
    const FittedModel fitted = MapOf(5, spec);
    ASSERT_TRUE(fitted.interval);
    EXPECT_TRUE(fitted.interval->of_sessions) << spec;
    EXPECT_EQ(WhyNotWatched(fitted), "") << spec;
  }
  const FittedModel of_parts = MapOf(5, "groups:10");
  EXPECT_FALSE(of_parts.interval->of_sessions);
  EXPECT_THAT(WhyNotWatched(of_parts), HasSubstr("not judged on whole"));
  EXPECT_THAT(WhyNotWatched(MapOf(2, "sessions:2")),
              HasSubstr("was judged on 2 sessions"));
}

TEST(MeasureSessions, HoldADayAndItsPartsAgainstTheHeldOutOnes) {
  const FittedModel fitted = MapOf(8, "sessions:8");
  const std::string healthy = Days(9, 9, 0.0);
  const std::string slipped = Days(9, 9, 0.02);
  for (const int rows : {30, 15, 6}) {
    SCOPED_TRACE(rows);
    const WatchedSession good = Measured(fitted, FirstRows(healthy, rows));
    ASSERT_TRUE(good.expected.known());
    EXPECT_FALSE(IsWorse(*JudgeSessions(*fitted.held_out, {good}), 2e-5));
    const WatchedSession bad = Measured(fitted, FirstRows(slipped, rows));
    EXPECT_TRUE(IsWorse(*JudgeSessions(*fitted.held_out, {bad}), 2e-5));
  }
}

TEST(MeasureSessions, JudgeNothingByFewRowsOrOnePlace) {
  const FittedModel fitted = MapOf(8, "sessions:8");
  const std::string day = Days(9, 9, 0.02);
  for (const int rows : {1, 2, 3}) {
    const WatchedSession few = Measured(fitted, FirstRows(day, rows));
    EXPECT_TRUE(few.too_few);
    EXPECT_FALSE(few.expected.known());
    EXPECT_FALSE(JudgeSessions(*fitted.held_out, {few}));
  }
}

}  // namespace
}  // namespace errmap::models
