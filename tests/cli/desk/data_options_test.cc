#include "cli/desk/data_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::desk {
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

TEST(NameList, DoublesQuotesInNames) {
  EXPECT_EQ(NameList({"a", "12\" bar", "c"}), "a,\"12\"\" bar\",c");
}

}  // namespace
}  // namespace errmap::desk
