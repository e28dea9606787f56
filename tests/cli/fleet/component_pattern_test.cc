#include "cli/fleet/run/component_pattern.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_runner.h"
#include "tests/places.h"

namespace errmap::fleet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Pair;

// The fields of a file of that path, where the pattern matches it.
std::optional<PathFields> Match(const PathPattern& pattern,
                                const std::string& path) {
  const ScratchFolder scratch;
  std::filesystem::create_directories((scratch / path).parent_path());
  std::ofstream(scratch / path) << "x";
  const auto found = pattern.FilesBelow(scratch.path().string());
  if (found.empty()) return std::nullopt;
  return found.front().second;
}

TEST(PathPattern, GivesTheEarlierFieldTheLongerPart) {
  const PathPattern pattern("{machine}/{component}_{direction}.csv");
  const auto fields = Match(pattern, "m01/x_displacement_down.csv");
  ASSERT_TRUE(fields);
  EXPECT_THAT(*fields,
              ElementsAre(Pair("machine", "m01"),
                          Pair("component", "x_displacement"),
                          Pair("direction", "down")));
  EXPECT_FALSE(Match(pattern, "m01/parallelism.csv"));
  EXPECT_FALSE(Match(pattern, "a/m01/x_down.csv"));
  EXPECT_FALSE(Match(pattern, "m01/_down.csv"));
  EXPECT_FALSE(Match(pattern, ".hidden/x_down.csv"));
}

TEST(PathPattern, TakesOnlyTheWordsThatAreListed) {
  const PathPattern pattern("{component}_{direction:down|up}.csv");
  EXPECT_TRUE(Match(pattern, "x_yaw_up.csv"));
  EXPECT_FALSE(Match(pattern, "x_yaw.csv"));
}

TEST(PathPattern, ManyFieldsInOneNameAreMatchedInTime) {
  const PathPattern pattern("{a}{b}{c}{d}{e}{f}{g}{h}{i}{j}x");
  EXPECT_FALSE(Match(pattern, std::string(200, 'y')));
}

TEST(PathPattern, RefusesWhatIsNoPattern) {
  for (const char* text : {"{a", "a}", "{}", "{a b}", "{a}{a}", "{a{b}}"}) {
    EXPECT_THROW(PathPattern{text}, std::invalid_argument) << text;
  }
}

TEST(FillIn, NamesAFieldThatIsNotThere) {
  EXPECT_EQ(FillIn("{m} of {n}", {{"m", "a"}, {"n", "b"}}), "a of b");
  EXPECT_THROW(FillIn("{k}", {{"m", "a"}}), std::invalid_argument);
}

class ExpandedPatterns : public ::testing::Test {
 protected:
  void Touch(const std::string& path) const {
    std::filesystem::create_directories((scratch_ / path).parent_path());
    std::ofstream(scratch_ / path) << "x";
  }
  // Of (name, path) of each [[component]].
  std::vector<std::string> Names(
      const std::vector<std::pair<std::string, std::string>>& patterns) const {
    FleetStudy study;
    for (const auto& [name, path] : patterns) {
      study_setup::ComponentConfig& component =
          study.config.components.emplace_back();
      component.name = name;
      component.data = scratch_.path().string();
      study.sources.push_back({.path = path, .is_pattern = true, .fields = {}});
    }
    study = Expanded(study);
    EXPECT_EQ(study.sources.size(), study.config.components.size());
    std::vector<std::string> names;
    for (const study_setup::ComponentConfig& component :
         study.config.components) {
      names.push_back(component.name);
    }
    return names;
  }

  ScratchFolder scratch_;
};

TEST_F(ExpandedPatterns, FilesThatANameDoesNotTellApartGetTheOtherFields) {
  Touch("m1/x_down.csv");
  Touch("m1/x_up.csv");
  Touch("m2/x_up.csv");
  Touch("m2/notes.txt");
  EXPECT_THAT(Names({{"{machine}/{component}",
                      "{machine}/{component}_{direction}.csv"}}),
              ElementsAre("m1/x, down", "m1/x, up", "m2/x"));
}

TEST_F(ExpandedPatterns, AFileBelongsToTheFirstPatternThatMatchesIt) {
  Touch("x_down.csv");
  Touch("yaw.csv");
  EXPECT_THAT(Names({{"{c} {d}", "{c}_{d}.csv"}, {"{c}", "{c}.csv"}}),
              ElementsAre("x down", "yaw"));
}

TEST_F(ExpandedPatterns, APatternWithoutFilesStaysAComponent) {
  EXPECT_THAT(Names({{"", "{machine}/x.csv"}}), ElementsAre("{machine}/x.csv"));
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
  study_setup::StudyFile file =
      study_setup::ReadStudyFile(folder_ + "/study.toml");
  file.config = Expanded(WithPatterns(file)).config;
  const study_setup::StudyPlan plan = study_setup::PlanStudy(
      file, [&](const std::string& line) { remarks.push_back(line); });
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
}  // namespace errmap::fleet
