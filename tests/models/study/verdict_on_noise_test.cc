// A verdict is never confident on noise: whole studies of small models on
// errors that depend on nothing, over seeds. tests/fuzz/small_study.cc asks the
// same of seeds that a fuzzer chooses.

#include <cstdint>

#include <gtest/gtest.h>

#include "data/column_header.h"
#include "models/study/judgement/judgement.h"
#include "stats/random.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using Eigen::Index;

enum class NoiseInVerdictOnNoise {
  kEven,         // of one size
  kHeavyTailed,  // one reading in ten is far off
  kOfGroups,     // each group has an offset of its own
};

data::Dataset NoiseOf(NoiseInVerdictOnNoise kind,
                      Index groups,
                      std::uint64_t seed) {
  constexpr Index kPerGroup = 6;
  stats::Random random(seed);
  const auto draw = [&] {
    return random.Uniform() + random.Uniform() + random.Uniform() - 1.5;
  };
  data::Dataset::Parts parts;
  parts.source = "noise";
  for (const char* name : {"position_mm", "t1_degC", "t2_degC"}) {
    parts.inputs.push_back({name, data::UnitOfColumn(name)});
  }
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  const Index rows = groups * kPerGroup;
  parts.input_values.resize(rows, 3);
  parts.target_values.resize(rows);
  parts.groups.column = "cycle";
  double offset = 0.0;
  for (Index row = 0; row < rows; ++row) {
    const Index group = row / kPerGroup;
    if (row % kPerGroup == 0) {
      parts.groups.labels.push_back(std::to_string(group));
      offset = kind == NoiseInVerdictOnNoise::kOfGroups ? draw() : 0.0;
    }
    parts.groups.codes.push_back(group);
    parts.input_values.row(row) << static_cast<double>(row % kPerGroup),
        20.0 + draw(), 20.0 + draw();
    const bool is_far =
        kind == NoiseInVerdictOnNoise::kHeavyTailed && random.Uniform() < 0.1;
    parts.target_values[row] = 1e-3 * (offset + (is_far ? 10.0 : 1.0) * draw());
  }
  return data::Dataset(std::move(parts));
}

// Whether anything says with confidence that a map is of use.
bool IsConfident(const data::Dataset& dataset, std::uint64_t seed) {
  const auto holdouts =
      errmap::testing::MakeHoldouts(dataset, {"leave-one-group-out"});
  const auto recipes = errmap::testing::MakeRecipes(
      {"mean", "poly:position", "poly:eq8", "poly:stepwise:degree=2"});
  const StudyResult study = RunStudy(
      dataset, holdouts, recipes, {.seed = seed, .fit_all_rows = false});
  const Judgement judged = JudgeStudy(
      dataset, holdouts, study, {.indifference = 2e-5, .seed = seed});
  const auto& verdict = judged.verdicts.at(0);
  const auto& advice = judged.recommendation;
  return (verdict && verdict->established() &&
          verdict->choice != Choice::kBaseline) ||
         (advice && advice->choice != Choice::kBaseline &&
          advice->against_baseline == Confidence::kEstablished);
}

int ConfidentOf(NoiseInVerdictOnNoise kind, Index groups, int studies) {
  int confident = 0;
  for (int seed = 1; seed <= studies; ++seed) {
    const auto number = static_cast<std::uint64_t>(seed);
    confident += IsConfident(NoiseOf(kind, groups, number), number) ? 1 : 0;
  }
  return confident;
}

// To do nothing is a map, too: one that reads sensors must be worth them.
TEST(VerdictOnNoise, HardlyEverRecommendsAMapWithSensors) {
  constexpr int kStudies = 40;
  int with_sensors = 0;
  for (int seed = 1; seed <= kStudies; ++seed) {
    const auto number = static_cast<std::uint64_t>(seed);
    const data::Dataset dataset =
        NoiseOf(NoiseInVerdictOnNoise::kOfGroups, 8, number);
    const auto holdouts =
        errmap::testing::MakeHoldouts(dataset, {"leave-one-group-out"});
    const auto recipes = errmap::testing::MakeRecipes(
        {"zero", "mean", "poly:position", "poly:temperature", "poly:eq8"});
    const StudyResult study =
        RunStudy(dataset, holdouts, recipes, {.seed = number});
    const Judgement judged = JudgeStudy(
        dataset, holdouts, study, {.indifference = 2e-5, .seed = number});
    ASSERT_TRUE(judged.recommendation.has_value());
    const ModelResult& model = study.models[judged.recommendation->model];
    with_sensors += SensorsOf(*model.final_fit).empty() ? 0 : 1;
  }
  EXPECT_LE(with_sensors, 2);
}

TEST(VerdictOnNoise, IsNeverConfidentWhereOneSessionMayExplainAll) {
  for (const NoiseInVerdictOnNoise kind : {NoiseInVerdictOnNoise::kEven,
                                           NoiseInVerdictOnNoise::kHeavyTailed,
                                           NoiseInVerdictOnNoise::kOfGroups}) {
    for (const Index groups : {3, 6, 11}) {
      EXPECT_EQ(ConfidentOf(kind, groups, 20), 0);
    }
  }
}

// Of 5 %, the level of each statement, at most: seeds are fixed.
TEST(VerdictOnNoise, IsSeldomConfidentWhereThereAreUnitsEnough) {
  constexpr int kStudies = 40;
  constexpr int kMostConfident = 2;
  for (const NoiseInVerdictOnNoise kind : {NoiseInVerdictOnNoise::kEven,
                                           NoiseInVerdictOnNoise::kHeavyTailed,
                                           NoiseInVerdictOnNoise::kOfGroups}) {
    EXPECT_LE(ConfidentOf(kind, 15, kStudies), kMostConfident);
  }
}

}  // namespace
}  // namespace errmap::models
