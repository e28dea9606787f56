
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "models/study/rezero/rezeroed_study.h"

namespace errmap::models {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two days, a row every half hour, its error the hours since midnight; cycles
// of two rows.
data::Dataset DaysInZeroPlan(bool with_times) {
  std::string text = with_times ? "time_s," : "";
  text += "day,cycle,position_mm,error_mm\n";
  for (int day = 1; day <= 2; ++day) {
    for (int i = 0; i < 6; ++i) {
      if (with_times) text += fmt::format("{},", 86400 * day + 1800 * i);
      text += fmt::format(
          "{},{},{},{}\n", day, 3 * day + i / 2, 10 * (i % 3), 0.5 * i);
    }
  }
  return data::MakeDataset(data::ParseCsv(text, "days"), {}).dataset;
}

HeldOutRows AllRowsOf(const data::Dataset& dataset) {
  HeldOutRows held{.source = &dataset, .rows = {}, .fold_of = {}};
  for (Eigen::Index row = 0; row < dataset.num_rows(); ++row) {
    held.rows.push_back(row);
    held.fold_of.push_back(0);
  }
  return held;
}

RezeroRule RuleOf(const char* text) {
  std::string noise;
  return ParseRezero(text, &noise);
}

TEST(ZeroPlan, JudgesARowThatIsDueByTheOldOffset) {
  const data::Dataset dataset = DaysInZeroPlan(true);
  const ZeroPlan plan = PlanZeros(AllRowsOf(dataset), RuleOf("1h"), 1);
  EXPECT_THAT(plan.zero_of, ElementsAre(-1, 0, 0, 2, 2, 4, -1, 6, 6, 8, 8, 10));
  EXPECT_EQ(plan.probes, 6);
  EXPECT_THAT(plan.scored, ElementsAre(1, 2, 3, 4, 5, 7, 8, 9, 10, 11));
}

TEST(ZeroPlan, LeavesRowsOutWhoseProbeIsTooLongAgo) {
  const data::Dataset dataset = DaysInZeroPlan(true);
  HeldOutRows held = AllRowsOf(dataset);
  held.rows = {0, 1, 5};
  held.fold_of.resize(3);
  EXPECT_THAT(PlanZeros(held, RuleOf("1h"), 1).zero_of, ElementsAre(-1, 0, -1));
  EXPECT_THAT(PlanZeros(held, RuleOf("session"), 1).zero_of,
              ElementsAre(-1, 0, 0));
}

TEST(ZeroPlan, TakesTheFirstRowOfEachCycleAsAProbe) {
  const data::Dataset dataset = DaysInZeroPlan(false);
  const ZeroPlan plan = PlanZeros(AllRowsOf(dataset), RuleOf("probe"), 1);
  EXPECT_THAT(plan.zero_of, ElementsAre(-1, 0, 0, 2, 2, 4, -1, 6, 6, 8, 8, 10));
}

TEST(ZeroPlan, KeepsFoldsApart) {
  const data::Dataset dataset = DaysInZeroPlan(true);
  HeldOutRows held = AllRowsOf(dataset);
  for (std::size_t i = 0; i < held.fold_of.size(); ++i) held.fold_of[i] = i % 2;
  EXPECT_THAT(PlanZeros(held, RuleOf("session"), 1).zero_of,
              ElementsAre(-1, -1, 0, 1, 0, 1, -1, -1, 6, 7, 6, 7));
}

TEST(ZeroPlan, TakesWhatTheProbeFoundOffLaterErrors) {
  const data::Dataset dataset = DaysInZeroPlan(true);
  const ZeroPlan plan = PlanZeros(AllRowsOf(dataset), RuleOf("1h"), 1);
  const Eigen::VectorXd left = Rezeroed(plan, dataset.target_values());
  EXPECT_EQ(
      left,
      (Eigen::VectorXd(10) << .5, 1, .5, 1, .5, .5, 1, .5, 1, .5).finished());
}

TEST(ZeroPlan, DrawsTheNoiseOfProbesFromTheSeed) {
  const data::Dataset dataset = DaysInZeroPlan(true);
  RezeroRule rule = RuleOf("30min");
  rule.noise = 2.0;
  double squares = 0.0;
  int draws = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const ZeroPlan plan = PlanZeros(AllRowsOf(dataset), rule, seed);
    squares += plan.noise.squaredNorm();
    draws += static_cast<int>(plan.probes);
    EXPECT_EQ(plan.noise, PlanZeros(AllRowsOf(dataset), rule, seed).noise);
  }
  // Of 1200 draws the sd is known to 2 %.
  EXPECT_NEAR(std::sqrt(squares / draws), 2.0, 0.16);
}

TEST(ZeroPlan, RefusesIntervalsWhereThereAreNoTimes) {
  const data::Dataset dataset = DaysInZeroPlan(false);
  try {
    PlanZeros(AllRowsOf(dataset), RuleOf("1h"), 1);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("1h needs times"));
  }
}

}  // namespace
}  // namespace errmap::models
