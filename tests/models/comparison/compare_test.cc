#include "models/comparison/compare.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "models/study/study_defaults.h"

namespace errmap::models {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> NamesOf(const ComponentStudy& study) {
  std::vector<std::string> names;
  for (const ModelResult& model : study.study.models) {
    names.push_back(model.name);
  }
  return names;
}

class CompareMapsTest : public ::testing::Test {
 protected:
  CompareMapsTest() { std::filesystem::create_directories(folder_); }
  ~CompareMapsTest() override { std::filesystem::remove_all(folder_); }

  // A line over the position, and a tenth of a micrometre beside it.
  std::string Write(const std::string& name, int rows) const {
    std::string text = "cycle,position_mm,t1_degC,error_mm\n";
    for (int i = 0; i < rows; ++i) {
      const double x = 10.0 * (i % 6);
      text += std::to_string(i / 6) + "," + std::to_string(x) + "," +
              std::to_string(20.0 + (i * 7) % 5) + "," +
              std::to_string(1e-3 * x + 1e-4 * ((i * 5) % 3)) + "\n";
    }
    const std::string path = (folder_ / name).string();
    data::WriteFileAtomically(path, text);
    return path;
  }

  std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / "compare_maps";
};

TEST_F(CompareMapsTest, ChoosesWhatIsLeftEmptyAndJudges) {
  const ComponentStudy study =
      CompareMaps(Write("xdown.csv", 60), {}, {.models = {"poly:eq9"}});
  EXPECT_EQ(study.name, "xdown");
  ASSERT_EQ(study.files.size(), 1U);
  EXPECT_EQ(study.files.front().sha256.size(), 64U);
  ASSERT_EQ(study.holdouts.size(), 2U);
  EXPECT_EQ(study.holdouts[0].name, "every:3");
  EXPECT_EQ(study.holdouts[1].name, "groups:5");
  EXPECT_TRUE(std::isnan(study.goal)) << "a goal that nobody gave";
  // The baselines are there to be beaten.
  EXPECT_EQ(study.first_added, 1U);
  EXPECT_EQ(study.num_added, NamesOf(study).size() - 1);
  EXPECT_THAT(NamesOf(study), Contains("zero"));
  ASSERT_TRUE(study.judgement.recommendation);
  const auto& use = study.study.models[study.judgement.recommendation->model];
  ASSERT_TRUE(use.final_fit);
  EXPECT_TRUE(use.final_fit->interval);
}

TEST_F(CompareMapsTest, TakesWhatItIsGiven) {
  const std::string test = Write("later.csv", 24);
  const ComponentStudy study = CompareMaps(Write("x.csv", 60),
                                           {.inputs = {"position_mm"}},
                                           {.holdouts = {"file:" + test},
                                            .models = {"mean", "zero"},
                                            .goal = 0.25,
                                            .indifference = 0.125});
  EXPECT_DOUBLE_EQ(study.goal, 0.25);
  EXPECT_DOUBLE_EQ(study.indifference, 0.125);
  ASSERT_EQ(study.holdouts.size(), 1U);
  EXPECT_EQ(study.study.models[0].holdouts[0].test.n, 24);
}

TEST_F(CompareMapsTest, RefusesSpecsAndDataThatItCannotUse) {
  const std::string file = Write("x.csv", 60);
  EXPECT_THROW(CompareMaps(file, {}, {.models = {"poly:eq77"}}),
               std::invalid_argument);
  EXPECT_THROW(CompareMaps(file, {}, {.holdouts = {"groups:60"}}),
               std::invalid_argument);
  EXPECT_THROW(CompareMaps("no such file.csv", {}, {}), data::InputError);
  try {
    CompareMaps(Write("few.csv", 2), {}, {.holdouts = {"kfold:2"}});
    FAIL() << "two rows were enough";
  } catch (const data::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("few.csv: too few rows"));
  }
}

TEST(PlanModels, CountsFitsToAllRowsAndToEveryFold) {
  const data::CsvTable table =
      data::ParseCsv("x_mm,error_mm\n1,1\n2,3\n3,2\n4,5\n5,4\n6,7\n", "x.csv");
  ComponentStudy component{.name = "x",
                           .files = {{.file = "x.csv", .sha256 = ""}},
                           .data = data::MakeDataset(table, {}),
                           .holdouts = {},
                           .study = {},
                           .judgement = {}};
  component.holdouts.push_back(MakeHoldout(
      stats::ParseHoldout("kfold:3"), component.data.dataset, 1, nullptr));
  std::vector<std::string> left_out;
  const ComponentPlan plan =
      PlanModels(std::move(component), {"zero", "mean"}, &left_out);
  EXPECT_THAT(plan.HoldoutNames(), ElementsAre("kfold:3"));
  EXPECT_EQ(plan.num_fits(), 4 * static_cast<int>(plan.recipes.size()));
  EXPECT_TRUE(left_out.empty());
}

}  // namespace
}  // namespace errmap::models
