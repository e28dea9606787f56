#include "cli/desk/toml/study_file.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/places.h"

namespace errmap::desk {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kStudy =
    "models = [\"mean\"]\n"
    "[[component]]\n"
    "name = \"x\"\n"
    "data = \"x.csv\"\n";

std::string RefusalOf(const std::string& change) {
  try {
    ParseStudyFile(kStudy, "study.toml", {change});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(StudyFile, TellsCallersOfALibraryOfNoFlags) {
  EXPECT_EQ(RefusalOf("seed"), "set must be KEY=VALUE, found 'seed'");
  EXPECT_EQ(RefusalOf("component.y.goal=1"),
            "set = component.y.goal=1: no component 'y'; the study file has 0 "
            "to 0");
  const std::string negative = RefusalOf("seed=-1");
  EXPECT_THAT(negative, HasSubstr("set = seed=-1: "));
  EXPECT_THAT(negative, HasSubstr("must be a whole number from 0"));
}

TEST(StudyFile, SelectsRowsAndColumnsAsADatasetDoes) {
  const StudyFile file = ParseStudyFile(kStudy,
                                        "at/study.toml",
                                        {"component.x.target=error_um",
                                         "component.x.missing=drop-rows",
                                         "component.x.where.side=\"up\""});
  const ComponentConfig& component = file.config.components.at(0);
  EXPECT_EQ(component.data, "at/x.csv");
  EXPECT_EQ(component.selection.target, "error_um");
  EXPECT_EQ(component.selection.missing, data::MissingPolicy::kDropRows);
  EXPECT_THAT(component.selection.where,
              ElementsAre(data::ColumnFilter{"side", "up"}));
}

class PlannedStudy : public ::testing::Test {
 protected:
  PlannedStudy() : folder_(::testing::TempDir() + "/planned_study") {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ + "/m1");
    for (const char* name : {"down", "up"}) {
      std::filesystem::copy_file(
          errmap::tests::SourceDir() + "/data/sets/nistir5367_xdisp_down.csv",
          folder_ + "/m1/" + name + ".csv");
    }
    std::ofstream(folder_ + "/study.toml")
        << "holdouts = [\"every:3\"]\n"
           "models = [\"mean\"]\n"
           "[[component]]\n"
           "name = \"{machine} {direction}\"\n"
           "data = \"{machine}/{direction}.csv\"\n";
  }
  ~PlannedStudy() override { std::filesystem::remove_all(folder_); }

  std::string folder_;
};

TEST_F(PlannedStudy, HasEveryFileThatAPatternMatchesAndTheStudyFileFirst) {
  std::vector<std::string> remarks;
  const StudyPlan plan =
      PlanStudy(ReadStudyFile(folder_ + "/study.toml"),
                [&](const std::string& line) { remarks.push_back(line); });
  ASSERT_EQ(plan.components.size(), 2U);
  EXPECT_EQ(plan.config.components[0].name, "m1 down");
  EXPECT_EQ(plan.config.components[1].name, "m1 up");
  ASSERT_EQ(plan.inputs.size(), 3U);
  EXPECT_EQ(plan.inputs[0].file, folder_ + "/study.toml");
  EXPECT_EQ(plan.inputs[1].sha256, plan.inputs[2].sha256);
  for (const std::string& remark : remarks) {
    EXPECT_THAT(remark, HasSubstr("m1 "));
    EXPECT_THAT(remark, Not(HasSubstr("--")));
  }
}

}  // namespace
}  // namespace errmap::desk
