#include "models/study/journal/fit_label.h"

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/version.h"
#include "tests/models/history/history_data.h"
#include "tests/models/model_test_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using data::Dataset;
using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;
using errmap::testing::QuadraticData;
using ::testing::HasSubstr;

constexpr Eigen::Index kFitLabelRows = 40;

Dataset::Parts PartsOf(const Dataset& dataset) {
  Dataset::Parts parts;
  parts.source = dataset.source();
  parts.inputs = dataset.inputs();
  parts.input_values = dataset.input_values();
  parts.target = dataset.target();
  parts.target_values = dataset.target_values();
  parts.groups = dataset.groups();
  parts.weights = dataset.weights();
  parts.rows = dataset.rows();
  return parts;
}

std::vector<std::string> KeysOf(
    const Dataset& dataset,
    const std::vector<std::string>& holdouts = {"every:3"},
    const std::vector<std::string>& specs = {"poly:eq8"},
    const StudyOptions& options = {},
    const std::string& program = "errmap 1") {
  const auto folds = MakeHoldouts(dataset, holdouts);
  const FitLabels labels(
      "x", dataset, folds, MakeRecipes(specs), options, program);
  return labels.Keys();
}

TEST(FitLabels, GiveEveryFitAKeyOfItsOwn) {
  const auto keys = KeysOf(QuadraticData(kFitLabelRows),
                           {"every:3", "every:4", "kfold:3"},
                           {"mean", "poly:eq7", "net:scg", "net:lm"});
  EXPECT_EQ(std::set<std::string>(keys.begin(), keys.end()).size(),
            keys.size());
}

TEST(FitLabels, AreTheSameForTheSameStudy) {
  EXPECT_EQ(KeysOf(QuadraticData(kFitLabelRows)),
            KeysOf(QuadraticData(kFitLabelRows)));
}

TEST(FitLabels, DoNotDependOnTheNameOfTheFileNorOnJobs) {
  Dataset::Parts parts = PartsOf(QuadraticData(kFitLabelRows));
  parts.source = "elsewhere.csv";
  EXPECT_EQ(KeysOf(Dataset(parts), {"every:3"}, {"poly:eq8"}, {.jobs = 4}),
            KeysOf(QuadraticData(kFitLabelRows)));
}

TEST(FitLabels, ChangeWithSeedOptionsAndProgram) {
  const Dataset dataset = QuadraticData(kFitLabelRows);
  const auto keys = KeysOf(dataset);
  const auto seed = KeysOf(dataset, {"every:3"}, {"poly:eq8"}, {.seed = 2});
  const auto options = KeysOf(dataset, {"every:3"}, {"poly:eq7"});
  const auto program =
      KeysOf(dataset, {"every:3"}, {"poly:eq8"}, {}, "errmap 2");
  for (std::size_t i = 0; i < keys.size(); ++i) {
    EXPECT_NE(seed[i], keys[i]);
    EXPECT_NE(options[i], keys[i]);
    EXPECT_NE(program[i], keys[i]);
  }
}

TEST(FitLabels, ChangeWithEverythingThatAFitSeesOfItsRows) {
  const std::vector<std::function<void(Dataset::Parts*)>> changes = {
      [](auto* p) { p->input_values(0, 1) += 1e-14; },
      [](auto* p) { p->target_values[0] *= 1.0 + 1e-15; },
      [](auto* p) { p->inputs[1].name = "t9_degC"; },
      [](auto* p) { p->inputs[1].unit.symbol = "K"; },
      [](auto* p) { p->target.unit.symbol = "um"; },
      [](auto* p) { p->weights = Eigen::VectorXd::Ones(kFitLabelRows); },
      [](auto* p) { p->rows.back() = 99; },
      [](auto* p) {
        p->groups = {
            "cycle", {"1"}, std::vector<Eigen::Index>(kFitLabelRows, 0)};
      },
  };
  const auto keys = KeysOf(QuadraticData(kFitLabelRows));
  for (std::size_t change = 0; change < changes.size(); ++change) {
    Dataset::Parts parts = PartsOf(QuadraticData(kFitLabelRows));
    changes[change](&parts);
    const auto changed = KeysOf(Dataset(parts));
    for (std::size_t i = 0; i < keys.size(); ++i) {
      EXPECT_NE(changed[i], keys[i]) << change << " " << i;
    }
  }
}

// Filters run through every row, kept in a fold or not.
TEST(FitLabels, ChangeWithTheLogThatFiltersRunThrough) {
  const std::vector<std::function<void(data::SessionLog*)>> changes = {
      [](auto* log) { log->time[2] += 0.5; },
      [](auto* log) { log->time_unit = "rows"; },
      [](auto* log) { log->input_values(2, 0) += 1e-14; },
      [](auto* log) { log->sessions.column = "run"; },
      [](auto* log) { log->sessions.codes[44] = 0; },
      [](auto* log) { log->first_rows[1] += 1; },
  };
  const Dataset dataset = errmap::testing::WanderingDays();
  const auto keys = KeysOf(dataset);
  for (std::size_t change = 0; change < changes.size(); ++change) {
    auto log = std::make_shared<data::SessionLog>(*dataset.log());
    changes[change](log.get());
    Dataset::Parts parts = PartsOf(dataset);
    parts.log = log;
    parts.log_rows = dataset.log_rows();
    const auto changed = KeysOf(Dataset(parts));
    for (std::size_t i = 0; i < keys.size(); ++i) {
      EXPECT_NE(changed[i], keys[i]) << change << " " << i;
    }
  }
}

TEST(FitLabels, ChangeOnlyForTheFoldsThatSeeAChangedRow) {
  // Three folds forward: the last of four blocks is seen by the last fold and
  // by the fit to all rows.
  const auto keys = KeysOf(QuadraticData(kFitLabelRows), {"forward:3"});
  Dataset::Parts parts = PartsOf(QuadraticData(kFitLabelRows));
  parts.target_values[kFitLabelRows - 1] += 1.0;
  const auto changed = KeysOf(Dataset(parts), {"forward:3"});
  ASSERT_EQ(keys.size(), 4U);
  EXPECT_NE(changed[0], keys[0]);
  EXPECT_EQ(changed[1], keys[1]);
  EXPECT_EQ(changed[2], keys[2]);
  EXPECT_NE(changed[3], keys[3]);
}

TEST(FitLabels, KnowTheRowsOfATestFile) {
  const Dataset dataset = QuadraticData(kFitLabelRows);
  const auto keys_with = [&](const Dataset& test) {
    std::vector<Holdout> holdouts;
    holdouts.push_back(MakeHoldout(stats::ParseHoldout("file:test.csv"),
                                   dataset,
                                   1,
                                   std::make_shared<const Dataset>(test)));
    const auto recipes = MakeRecipes({"mean"});
    const FitLabels labels("x", dataset, holdouts, recipes, {}, "errmap 1");
    return std::pair(labels.Keys()[0], labels.Keys()[1]);
  };
  const auto all = keys_with(dataset);
  const auto some = keys_with(dataset.SelectRows({1, 2, 3}));
  EXPECT_EQ(all.first, some.first);
  EXPECT_NE(all.second, some.second);
  EXPECT_EQ(some, keys_with(dataset.SelectRows({1, 2, 3})));
}

TEST(ProgramIdentity, NamesVersionAndBuild) {
  EXPECT_THAT(ProgramIdentity(),
              HasSubstr(std::string("errmap ") + Version() + " (build "));
}

}  // namespace
}  // namespace errmap::models
