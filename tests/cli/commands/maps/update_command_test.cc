// Maps that are fitted again with new sessions, and kept where those are no
// better.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/commands/promise_days.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class UpdateCommand : public CliPromise {
 protected:
  // Days whose errors are as many times as large, which no offset explains.
  static std::string GrownDays(int first, int last, double factor) {
    std::string text;
    for (const std::string& line : SplitLines(DaysInCliPromise(first, last))) {
      const std::size_t at = line.rfind(',') + 1;
      text += line.substr(0, at) +
              (text.empty()
                   ? line.substr(at)
                   : data::CsvNumber(factor * std::stod(line.substr(at)))) +
              "\n";
    }
    return text;
  }
};

TEST_F(UpdateCommand, UpdatesAMapThatNewSessionsMakeBetter) {
  Write("new.csv", DaysInCliPromise(11, 14, 9.0));
  const Json moved = RunJson({"update",
                              "map.json",
                              "new.csv",
                              "-o",
                              "new.json",
                              "--known",
                              "new.csv",
                              "--format",
                              "json"});
  EXPECT_EQ(moved["updated"], true);
  EXPECT_LT(moved["new_rmse"], moved["old_rmse"]);
  const Json judged =
      RunJson({"evaluate", "new.json", "new.csv", "--format", "json"});
  EXPECT_LT(judged["summary"]["rmse"].get<double>(), 2.0);
}

// What an updated map learnt from is not forgotten by its next update.
TEST_F(UpdateCommand, UpdatesOnceMoreFromAllThatWasLearnt) {
  const auto update = [this](const std::string& map, const std::string& data) {
    return RunJson(
        {"update", map, data, "-o", "newer.json", "--format", "json"});
  };
  const auto files = [](const Json& updated) {
    std::vector<std::string> names;
    for (const Json& input : updated["provenance"]["inputs"]) {
      names.push_back(input["file"]);
    }
    return names;
  };
  Write("new.csv", GrownDays(11, 14, 1.6));
  Write("newer.csv", GrownDays(15, 16, 2.5));
  const Json once = update("map.json", "new.csv");
  ASSERT_EQ(once["updated"], true);
  EXPECT_THAT(files(once), ElementsAre("map.json", "train.csv", "new.csv"));
  Write("once.json", Read("newer.json"));
  EXPECT_THAT(files(update("once.json", "newer.csv")),
              ElementsAre("once.json", "train.csv", "new.csv", "newer.csv"));
  // A file that changed is named, and the rest still serves.
  Write("train.csv", DaysInCliPromise(1, 9));
  const Outcome lost =
      Run({"update", "once.json", "newer.csv", "-o", "newer.json"});
  EXPECT_EQ(lost.status, 0) << lost.err;
  EXPECT_THAT(OneLine(lost.out),
              HasSubstr("'train.csv' is missing or changed"));
  EXPECT_THAT(Run({"update",
                   "once.json",
                   "newer.csv",
                   "-o",
                   "newer.json",
                   "--known",
                   "train.csv",
                   "--known",
                   "new.csv"})
                  .out,
              Not(HasSubstr("missing or changed")));
}

// Where it is run from decides nothing: what the map was fitted to is looked
// for beside the new sessions and beside the map, too, by its hash.
TEST_F(UpdateCommand, FindsWhatTheMapLearntFromWhereverItIsRun) {
  std::filesystem::create_directories(scratch_ / "data");
  std::filesystem::create_directories(scratch_ / "maps");
  const auto move = [&](const char* from, const char* to) {
    std::filesystem::rename(scratch_ / from, scratch_ / to);
  };
  Write("data/new.csv", GrownDays(11, 14, 1.6));
  const auto update = [&](const std::string& map, const std::string& data) {
    return RunJson(
        {"update", map, data, "-o", "newer.json", "--format", "json"});
  };
  const Json here = update("map.json", "data/new.csv");
  EXPECT_EQ(here["not_at_hand"], Json::array());
  move("train.csv", "data/train.csv");
  const Json beside_data = update("map.json", "data/new.csv");
  EXPECT_EQ(beside_data["not_at_hand"], Json::array());
  EXPECT_EQ(beside_data["sessions"], here["sessions"]);
  move("data/train.csv", "maps/train.csv");
  move("map.json", "maps/map.json");
  const Json beside_map = update("maps/map.json", "data/new.csv");
  EXPECT_EQ(beside_map["not_at_hand"], Json::array());
  EXPECT_EQ(beside_map["sessions"], here["sessions"]);
  // The file of new sessions is the one it was fitted to.
  move("maps/train.csv", "data/again.csv");
  EXPECT_EQ(update("maps/map.json", "data/again.csv")["not_at_hand"],
            Json::array());
  EXPECT_EQ(update("maps/map.json", "data/new.csv")["not_at_hand"],
            Json::array({"train.csv"}));
}

TEST_F(UpdateCommand, KeepsTheOldMapUnlessTheNewOneIsBetter) {
  // DaysInCliPromise of the same kind: what ten days know, two more hardly
  // better.
  Write("same.csv", DaysInCliPromise(1, 2));
  const Outcome outcome =
      Run({"update", "map.json", "same.csv", "-o", "same.json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("same.json is the old one"));
  EXPECT_EQ(Read("same.json"), Read("map.json"));
  Write("one.csv", DaysInCliPromise(11, 11));
  EXPECT_THAT(
      RefusalOf(
          Run({"update", "map.json", "one.csv", "-o", "one.json", "--quiet"}),
          kUnusable),
      HasSubstr("two new sessions"));
}

TEST_F(UpdateCommand, KeepsTheOldMapWhereSignOrZeroIsOther) {
  Write("opposite.csv", GrownDays(11, 14, -1.0));
  Write("shifted.csv", DaysInCliPromise(11, 14, 40.0));
  for (const auto& [file, what] :
       {std::pair("opposite.csv", "have the opposite sign"),
        std::pair("shifted.csv", "are shifted by 39.7 um")}) {
    const Outcome outcome = Run({"update", "map.json", file, "-o", "new.json"});
    EXPECT_THAT(outcome.out, HasSubstr(what));
    EXPECT_EQ(Read("new.json"), Read("map.json")) << file;
  }
}

}  // namespace
}  // namespace errmap
