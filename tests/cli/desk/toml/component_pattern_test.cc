#include "cli/desk/toml/component_pattern.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_runner.h"

namespace errmap::desk {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(PathPattern, GivesTheEarlierFieldTheLongerPart) {
  const PathPattern pattern("{machine}/{component}_{direction}.csv");
  const auto fields = pattern.Match("m01/x_displacement_down.csv");
  ASSERT_TRUE(fields);
  EXPECT_THAT(*fields,
              ElementsAre(Pair("machine", "m01"),
                          Pair("component", "x_displacement"),
                          Pair("direction", "down")));
  EXPECT_FALSE(pattern.Match("m01/parallelism.csv"));
  EXPECT_FALSE(pattern.Match("a/m01/x_down.csv"));
  EXPECT_FALSE(pattern.Match("m01/_down.csv"));
  EXPECT_FALSE(pattern.Match(".hidden/x_down.csv"));
}

TEST(PathPattern, TakesOnlyTheWordsThatAreListed) {
  const PathPattern pattern("{component}_{direction:down|up}.csv");
  EXPECT_TRUE(pattern.Match("x_yaw_up.csv"));
  EXPECT_FALSE(pattern.Match("x_yaw.csv"));
}

TEST(PathPattern, ManyFieldsInOneNameAreMatchedInTime) {
  const PathPattern pattern("{a}{b}{c}{d}{e}{f}{g}{h}{i}{j}x");
  EXPECT_FALSE(pattern.Match(std::string(200, 'y')));
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
    StudyConfig study;
    std::vector<ComponentSource> sources;
    for (const auto& [name, path] : patterns) {
      ComponentConfig& component = study.components.emplace_back();
      component.name = name;
      component.data = scratch_.path().string();
      ComponentSource& source = sources.emplace_back();
      source.path = path;
      source.is_pattern = true;
    }
    ExpandPatterns(&study, &sources);
    EXPECT_EQ(sources.size(), study.components.size());
    std::vector<std::string> names;
    for (const ComponentConfig& component : study.components) {
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

}  // namespace
}  // namespace errmap::desk
