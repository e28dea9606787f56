#include "models/study/judgement/extrapolated_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using errmap::testing::MakeHoldouts;
using ::testing::ElementsAre;

// The inputs x and y of six rows, mapped from x or from both.
data::Dataset Rows() {
  data::Dataset::Parts parts;
  parts.source = "rows";
  for (const char* name : {"x", "y"}) {
    parts.inputs.push_back({.name = name, .unit = {}});
  }
  parts.input_values.resize(6, 2);
  parts.input_values << 1, 5, 2, 5, 3, 5, 3, 5, 2, 5, 4, 6;
  parts.target = {.name = "e", .unit = {}};
  parts.target_values = parts.input_values.col(0);
  return data::Dataset(std::move(parts));
}

FittedModel MapOfInExtrapolatedRows(const std::string& formula) {
  return MakeRecipe("poly:formula=" + formula)->Fit(Rows(), {});
}

std::vector<std::vector<bool>> Outside(const Holdout& holdout,
                                       const std::string& formula) {
  std::vector<std::vector<bool>> found;
  for (const auto& rows :
       ExtrapolatedRows(Rows(), holdout, MapOfInExtrapolatedRows(formula))) {
    found.emplace_back(rows.begin(), rows.end());
  }
  return found;
}

TEST(ExtrapolatedRows, TellsOfEachFoldTheRowsBeyondWhatItWasTrainedOn) {
  const Holdout thirds = MakeHoldouts(Rows(), {"blocks:3"}).front();
  // Without the first two rows x goes from 2 on, without the last two to 3.
  EXPECT_THAT(Outside(thirds, "x"),
              ElementsAre(ElementsAre(true, false),
                          ElementsAre(false, false),
                          ElementsAre(false, true)));
}

// As positions do that are measured, not commanded.
TEST(ExtrapolatedRows, TakesNoiseAtABoundForWithin) {
  const FoldValues values{.low = 0.0,
                          .high = 100.0,
                          .tested = Eigen::Vector4d(-3.0, -1.0, 101.0, 103.0)};
  EXPECT_EQ(values.Below().count(), 1);
  EXPECT_EQ(values.Above().count(), 1);
}

TEST(ExtrapolatedRows, LooksAtInputsOfTheMapOnly) {
  Holdout last = MakeHoldouts(Rows(), {"every:3"}).front();
  last.folds = {{.train = {0, 1, 2, 5}, .test = {3, 4}},
                {.train = {0, 1, 2, 3, 4}, .test = {5}}};
  EXPECT_THAT(Outside(last, "y"),
              ElementsAre(ElementsAre(false, false), ElementsAre(true)));
  last.folds.back().train = {0, 5};
  EXPECT_THAT(Outside(last, "x"),
              ElementsAre(ElementsAre(false, false), ElementsAre(false)));
}

TEST(ExtrapolatedRows, LooksAtAllRowsOfAnotherFile) {
  Holdout other = MakeHoldouts(Rows(), {"every:3"}).front();
  other.folds = {{.train = {1, 2}, .test = {0, 1, 2, 3, 4, 5}}};
  other.test_data = std::make_shared<const data::Dataset>(Rows());
  EXPECT_THAT(Outside(other, "x"),
              ElementsAre(ElementsAre(true, false, false, false, false, true)));
}

}  // namespace
}  // namespace errmap::models
