#include <atomic>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "models/study/record/component_study.h"
#include "tests/models/history/history_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;

// Days of six rows whose errors are an offset each, and nothing else.
data::Dataset DaysOf(const std::vector<double>& offsets) {
  constexpr Index kRows = 6;
  const auto rows = static_cast<Index>(offsets.size()) * kRows;
  std::vector<Index> codes;
  for (Index row = 0; row < rows; ++row) codes.push_back(row / kRows);
  const data::Dataset dataset = errmap::testing::WithLog(
      {errmap::testing::ColumnNamed("t1_degC")},
      Eigen::VectorXd::LinSpaced(rows, 20.0, 25.0),
      Eigen::VectorXd::LinSpaced(
          rows, 0.0, 60.0 * static_cast<double>(rows - 1)),
      codes);
  data::Dataset::Parts parts;
  parts.source = "days";
  parts.inputs = dataset.inputs();
  parts.input_values = dataset.input_values();
  parts.target = dataset.target();
  parts.target_values.resize(rows);
  for (Index row = 0; row < rows; ++row) {
    parts.target_values[row] = offsets[static_cast<std::size_t>(row / kRows)];
  }
  parts.log = dataset.log();
  parts.log_rows = dataset.log_rows();
  return data::Dataset(std::move(parts));
}

std::optional<SessionWorth> WorthToMean(const data::Dataset& dataset,
                                        const std::string& holdout,
                                        const StudyOptions& options) {
  const auto holdouts = MakeHoldouts(dataset, {holdout});
  const auto recipes = MakeRecipes({"mean"});
  const StudyResult study = RunStudy(dataset, holdouts, recipes, {});
  return WorthOfASession(dataset,
                         holdouts.front(),
                         *recipes.front(),
                         study.models.front().holdouts.front(),
                         options);
}

double MeanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(SessionWorth, IsTheErrorWithOneSessionFewer) {
  const std::vector<double> offsets = {0.0, 3.0, -1.0, 2.5, 7.0};
  const auto worth = WorthToMean(DaysOf(offsets), "sessions:5", {.jobs = 2});
  ASSERT_TRUE(worth);
  EXPECT_EQ(worth->sessions, 5);
  EXPECT_EQ(worth->folds, 5);
  // By hand: the means of the other days, and of these less one.
  const data::Dataset dataset = DaysOf(offsets);
  const auto folds = MakeHoldouts(dataset, {"sessions:5"}).front().folds;
  double log_ratio = 0.0;
  for (std::size_t fold = 0; fold < folds.size(); ++fold) {
    const auto out = static_cast<std::size_t>(folds[fold].test.front() / 6);
    std::vector<double> others = offsets;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(out));
    const double all = std::abs(offsets[out] - MeanOf(others));
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(fold % 4));
    log_ratio += std::log(std::abs(offsets[out] - MeanOf(others)) / all) / 5.0;
  }
  EXPECT_NEAR(worth->ratio_of_one_fewer, std::exp(log_ratio), 1e-12);
  const double exponent = std::max(0.0, log_ratio / std::log(4.0 / 3.0));
  EXPECT_NEAR(worth->ratio_of_one_more, std::pow(5.0 / 6.0, exponent), 1e-12);
}

TEST(SessionWorth, IsNotAskedOfManySessions) {
  std::vector<double> offsets;
  for (int day = 0; day < 50; ++day) offsets.push_back(day % 7);
  EXPECT_TRUE(WorthToMean(DaysOf(offsets), "sessions:5", {}));
  offsets.push_back(1.0);
  EXPECT_FALSE(WorthToMean(DaysOf(offsets), "sessions:5", {}));
}

TEST(SessionWorth, IsNotKnownOfFewSessionsOrOtherHoldOuts) {
  EXPECT_FALSE(WorthToMean(DaysOf({0.0, 3.0, 1.0}), "sessions:3", {}));
  EXPECT_FALSE(WorthToMean(DaysOf({0.0, 3.0, 1.0, 2.0}), "every:3", {}));
  const std::atomic<bool> stop = true;
  EXPECT_FALSE(
      WorthToMean(DaysOf({0.0, 3.0, 1.0, 2.0}), "sessions:4", {.stop = &stop}));
}

}  // namespace
}  // namespace errmap::models
