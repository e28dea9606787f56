
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/study_setup/study_options.h"
#include "cli/study_setup/toml/study_file.h"

namespace errmap::study_setup {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

constexpr std::uint64_t kDefaultSeed = 1;

TEST(DataOptions, SayNothingOfDefaults) {
  EXPECT_THAT(DataOptions({}, kDefaultSeed), IsEmpty());
}

TEST(DataOptions, AreThoseThatReadTheSameMeasurements) {
  data::DatasetSelection selection;
  selection.target = "error_um";
  selection.exclude = {"t 1", "a,b"};
  selection.session = "none";
  selection.align = data::Alignment::kFirst;
  selection.missing = data::MissingPolicy::kDropRows;
  selection.keep_dead = true;
  EXPECT_THAT(DataOptions(selection, 7),
              ElementsAre(Pair("target", "error_um"),
                          Pair("exclude", "t 1,\"a,b\""),
                          Pair("session", "none"),
                          Pair("align", "first"),
                          Pair("missing", "drop-rows"),
                          Pair("keep_dead", ""),
                          Pair("seed", "7")));
}

// A value of each kind that is not the default, for a study file.
std::string Given(const std::string& /*text*/) { return "\"a\""; }
std::string Given(const std::vector<std::string>& /*names*/) {
  return "[\"a\"]";
}
std::string Given(bool by_default) { return by_default ? "false" : "true"; }

TEST(StudyOptions, OfTheListAreReadFromFilesAndPrinted) {
  const data::DatasetSelection defaults;
  ForSelectionOptions(
      defaults,
      [](const StudyOption& option,
         const auto& by_default,
         const auto&... values) {
        std::string value;
        if constexpr (sizeof...(values) == 0) {
          value = Given(by_default);
        } else {
          for (const auto& word : (values, ...)) {
            if (word != by_default) {
              value = "\"" + std::string(ToString(word)) + "\"";
            }
          }
        }
        const StudyFile study =
            ParseStudyFile("[[component]]\ndata = \"x.csv\"\n" +
                               std::string(option.key) + " = " + value,
                           "study.toml",
                           {});
        const ComponentConfig& component = study.config.components.front();
        EXPECT_THAT(DataOptions(component.selection, kDefaultSeed),
                    ElementsAre(Pair(option.key, ::testing::_)));
      });
}

TEST(NameList, DoublesQuotesInNames) {
  EXPECT_EQ(NameList({"a", "12\" bar", "c"}), "a,\"12\"\" bar\",c");
}

}  // namespace
}  // namespace errmap::study_setup
