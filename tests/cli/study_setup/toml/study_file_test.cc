#include "cli/study_setup/toml/study_file.h"

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::study_setup {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

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

}  // namespace
}  // namespace errmap::study_setup
