// A fleet study in shards, put together and asked, as a user runs it.

#include <sys/stat.h>

#include "tests/cli/both_ways.h"
#include "tests/cli/fleet/fleet_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

using Fleet = FleetTest;

TEST_F(Fleet, OneBrokenComponentStopsNoOtherAndIsNamed) {
  WriteFleet();
  const Outcome outcome = Study("store");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("m02/yaw failed: "));
  EXPECT_THAT(outcome.err, HasSubstr("8 fitted, 0 unchanged, 1 failed"));
  EXPECT_THAT(outcome.out, HasSubstr("m01/x, down"));
  const Json failed =
      Rows("store", "SELECT name, why FROM components WHERE status = 'failed'");
  ASSERT_THAT(failed, SizeIs(1));
  EXPECT_EQ(failed[0][0], "m02/yaw");
  EXPECT_THAT(failed[0][1].get<std::string>(), HasSubstr("yaw_up.csv"));
  for (const Outcome& asked :
       {Run({"report", "store", "--component", "m02/yaw"}),
        Run({"deploy", "store", "m02/yaw"})}) {
    EXPECT_THAT(RefusalOf(asked, kUnusable),
                AllOf(HasSubstr("'m02/yaw' has no results and no map, since it "
                                "failed: "),
                      HasSubstr("yaw_up.csv")));
  }
  EXPECT_EQ(Rows("store",
                 "SELECT field, value FROM fields WHERE component = "
                 "'m01/x, down' ORDER BY field"),
            Json::parse(R"([["component", "x"], ["direction", "down"],
                            ["machine", "m01"]])"));
}

TEST_F(Fleet, APatternThatMatchesNothingAndAMissingFileAreFailedComponents) {
  WriteComponent("a.csv", 1);
  Write("fleet.toml",
        "models = [\"mean\"]\n"
        "[[component]]\ndata = \"{machine}/x.csv\"\n"
        "[[component]]\ndata = \"missing.csv\"\n"
        "[[component]]\ndata = \"a.csv\"\n");
  const Outcome outcome = Study("store");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(Rows("store", "SELECT name, status FROM components"),
            Json::parse(R"([["a", "ok"], ["missing", "failed"],
                            ["{machine}/x.csv", "failed"]])"));
}

TEST_F(Fleet, InitProposesAStudyOfAFolder) {
  WriteFleet();
  Write("data/m01/x_up.csv", "torn\n");  // no reason to leave out the others
  Write("data/m01/notes.csv", "no,numbers\na,b\n");
  const Outcome outcome = Run({"init", "data"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("8 files; left out, since they cannot be mapped: "
                        "'notes', 'yaw_up';\ncheck it"));
  EXPECT_THAT(
      Read("study.toml"),
      AllOf(HasSubstr("name = \"{machine}/{component}, {direction}\""),
            HasSubstr("\"data/{machine}/{component:x|z}_{direction:down|up}"
                      ".csv\"")));
}

TEST_F(Fleet, TheFirstLineCountsEveryComponent) {
  WriteFleet();
  WriteComponent("data/m01/turn_up.csv", 5);
  std::string text = Read("data/m01/turn_up.csv");
  Write("data/m01/turn_up.csv",
        text.replace(text.find("error_mm"), 8, "error_urad"));
  // None has a goal, so nothing is said of goals.
  EXPECT_EQ(SplitLines(Study("store").out).front(), "10 components: 1 failed.");
}

TEST_F(Fleet, SharesInAnyOrderGiveWhatOneRunGives) {
  WriteFleet();
  ASSERT_EQ(Study("whole", {"--jobs", "1"}).status, 0);
  for (const char* share : {"2/3", "0/3", "2/3", "1/3"}) {
    const Outcome outcome = Study("shared", {"--shard", share});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(Run({"merge", "shared"}).status, 0);
  EXPECT_EQ(Content("whole"), Content("shared"));
  EXPECT_EQ(Results("whole"), Results("shared"));
}

TEST_F(Fleet, SharesThatAreKilledGoOnAndTwoOfTheSameDoNoHarm) {
  WriteFleet();
  ASSERT_EQ(Study("whole").status, 0);
  const std::vector<std::string> words{"compare",
                                       "--config",
                                       "fleet.toml",
                                       "--out",
                                       "shared",
                                       "--jobs",
                                       "1",
                                       "--shard",
                                       "0/1"};
  for (const int pause_ms : {5, 60, 15, 120, 30}) {
    Process first(scratch_.path(), words);
    Process second(scratch_.path(), words);
    std::this_thread::sleep_for(std::chrono::milliseconds(pause_ms));
    first.Kill();
    second.Kill();
    first.Wait();
    second.Wait();
  }
  Process one(scratch_.path(), words);
  Process two(scratch_.path(), words);
  EXPECT_EQ(one.Wait().status, 0);
  EXPECT_EQ(two.Wait().status, 0);
  EXPECT_EQ(Run({"merge", "shared"}).status, 0);
  EXPECT_EQ(Content("whole"), Content("shared"));
}

TEST_F(Fleet, WhatHasNotChangedIsNotFittedAgain) {
  WriteFleet();
  ASSERT_EQ(Study("store").status, 0);
  EXPECT_THAT(Study("store", {"--resume"}).err,
              HasSubstr("0 fitted, 8 unchanged, 1 failed"));
  WriteComponent("data/m01/x_down.csv", 77);
  WriteComponent("data/m03/x_down.csv", 78);
  EXPECT_THAT(Study("store").err, HasSubstr("2 fitted, 7 unchanged, 1 failed"));
  EXPECT_THAT(Study("store", {"--goal", "0.001"}).err,
              HasSubstr("9 fitted, 0 unchanged, 1 failed"));
}

TEST_F(Fleet, MergeSaysWhatIsMissing) {
  WriteFleet();
  EXPECT_EQ(Study("store", {"--shard", "1/3", "--quiet"}).err, "");
  const Outcome merged = Run({"merge", "store"});
  EXPECT_EQ(merged.status, kEveryFitFailed);
  EXPECT_THAT(merged.err,
              AllOf(HasSubstr("of 9 components are missing: "),
                    HasSubstr("run the shards again")));
  EXPECT_FALSE(
      Rows("store", "SELECT * FROM components WHERE status = 'missing'")
          .empty());
  // Shares of another study do not count as this one's.
  EXPECT_EQ(Study("store", {"--shard", "0/3", "--seed", "2"}).status, 0);
  EXPECT_GT(Rows("store", "SELECT count(*) FROM components")[0][0], 0);
  EXPECT_EQ(Run({"merge", "store"}).status, kEveryFitFailed);
}

TEST_F(Fleet, AComponentThatLeavesTheStudyLeavesTheStore) {
  WriteFleet();
  ASSERT_EQ(Study("store").status, 0);
  std::filesystem::remove(scratch_ / "data/m01/x_down.csv");
  ASSERT_EQ(Study("store").status, 0);
  EXPECT_EQ(Rows("store", "SELECT count(*) FROM components")[0][0],
            kComponents - 1);
}

TEST_F(Fleet, WrongCommandLinesGetOneLine) {
  WriteFleet();
  EXPECT_THAT(
      RefusalOf(Run({"compare", "--config", "fleet.toml"}), kWrongCommandLine),
      HasSubstr("needs --out STORE"));
  for (const char* share : {"3/3", ""}) {
    EXPECT_THAT(RefusalOf(Study("s", {"--shard", share}), kWrongCommandLine),
                HasSubstr("give I/N"));
  }
  EXPECT_THAT(RefusalOf(Study("data"), kWrongCommandLine),
              HasSubstr("is not a store and not empty"));
  EXPECT_THAT(
      RefusalOf(Run({"compare", "x.csv", "--shard", "0/1"}), kWrongCommandLine),
      HasSubstr("--config"));
  EXPECT_THAT(RefusalOf(Run({"merge", "data"}), kUnusable),
              HasSubstr("is not a store"));
  Write("bad.toml", "[[component]]\nname = \"{a}\"\ndata = \"{b}.csv\"\n");
  EXPECT_THAT(RefusalOf(Run({"compare", "--config", "bad.toml", "--out", "s"}),
                        kUnusable),
              HasSubstr("no field {a}"));
  EXPECT_FALSE(Exists("s"));
}

TEST_F(Fleet, AFileOfBothWaysIsTwoComponents) {
  for (const char* folder : {"data/m1", "data/m2"}) {
    std::filesystem::create_directories(scratch_ / folder);
  }
  Write("data/m1/x.csv", RowsOfBothWays());
  WriteComponent("data/m2/x.csv", 3);
  ASSERT_EQ(Run({"init", "data", "-o", "fleet.toml"}).status, 0);
  const std::vector<std::string> quick = {"--models", "mean,poly:position"};
  const Outcome outcome = Study("store", quick);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("2 fitted, 0 unchanged, 0 failed"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("missing")));
  EXPECT_EQ(Rows("store", "SELECT name, status, rows FROM components"),
            Json::parse(R"([["m1/x, down", "ok", 80], ["m1/x, up", "ok", 80],
                            ["m2/x", "ok", 72]])"));
  EXPECT_EQ(Run({"merge", "store"}).status, 0);
  EXPECT_THAT(Run({"report", "store", "--component", "m1/x, up"}).out,
              HasSubstr("report.html"));
  EXPECT_THAT(
      RefusalOf(Run({"report", "store", "--component", "m1/x"}), kUnusable),
      HasSubstr("its components are 'm1/x, up', 'm1/x, down'"));
  EXPECT_EQ(Run({"deploy", "store", "m1/x, up"}).status, 0);
  EXPECT_THAT(Study("store", quick).err,
              HasSubstr("0 fitted, 2 unchanged, 0 failed"));
  // A component of that name may be there already.
  Write("data/m1/x_up.csv", Read("data/m2/x.csv"));
  ASSERT_EQ(Run({"init", "data", "-o", "fleet.toml", "--force"}).status, 0);
  EXPECT_EQ(Study("store", quick).status, 0);
  EXPECT_EQ(Rows("store", "SELECT name FROM components WHERE status = 'ok'"),
            Json::parse(R"([["m1/x, down"], ["m1/x, up"],
                            ["m1/x, up of data/m1/x.csv"], ["m2/x"]])"));
}

TEST_F(Fleet, DryRunFitsNothing) {
  WriteFleet();
  const Outcome outcome = Study("store", {"--dry-run"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("9 components"), HasSubstr("unusable: m02/yaw")));
  EXPECT_FALSE(Exists("store"));
}

// ---- The database

class FleetQuery : public FleetTest {
 protected:
  void SetUp() override {
    WriteFleet();
    ASSERT_EQ(Study("store").status, 0);
  }
};

TEST_F(FleetQuery, TheTenQueriesOfTheReadmeAnswer) {
  const std::string text =
      Process::TextOf(tests::SourceDir() + "/cli/fleet/queries.md");
  int queries = 0;
  for (std::size_t at = 0; (at = text.find("```sql\n", at)) != text.npos;) {
    at += 7;
    const std::string sql = text.substr(at, text.find("```", at) - at);
    EXPECT_FALSE(Ask("store", sql)["columns"].empty()) << sql;
    ++queries;
  }
  EXPECT_EQ(queries, 10);
}

TEST_F(FleetQuery, NewerSchemasAndOtherFilesAreRefusedByName) {
  MakeSchemaNewer("store/errmap.sqlite");
  const std::string store = Read("store/errmap.sqlite");
  for (const Outcome& outcome :
       {Run({"deploy", "store", "--all"}), Run({"merge", "store"})}) {
    EXPECT_THAT(RefusalOf(outcome, kUnusable),
                AllOf(HasSubstr("store/errmap.sqlite has schema 99"),
                      HasSubstr("use the newer errmap")));
  }
  EXPECT_EQ(Read("store/errmap.sqlite"), store);
  Write("store/errmap.sqlite", "no database at all, but quite some text");
  EXPECT_THAT(RefusalOf(Run({"deploy", "store", "--all"}), kUnusable),
              HasSubstr("store/errmap.sqlite"));
  std::filesystem::remove(scratch_ / "store/errmap.sqlite");
  EXPECT_THAT(RefusalOf(Run({"deploy", "store", "--all"}), kUnusable),
              HasSubstr("errmap merge STORE makes it"));
  // A pipe would be waited for.
  ASSERT_EQ(mkfifo((scratch_ / "store/errmap.sqlite").c_str(), 0600), 0);
  EXPECT_THAT(RefusalOf(Run({"deploy", "store", "--all"}), kUnusable),
              HasSubstr("store/errmap.sqlite: is not a plain file"));
}

// Bytes that a disk lost, in any page: named, and merged anew.
TEST_F(FleetQuery, ADamagedStoreSaysWhatToDoAndIsWrittenAnew) {
  const std::string whole = Read("store/errmap.sqlite");
  constexpr std::size_t kPage = 4096;
  ASSERT_GT(whole.size(), 3 * kPage);
  for (std::size_t page = 0; page < whole.size() / kPage; page += 3) {
    SCOPED_TRACE(page);
    std::string damaged = whole;
    damaged.replace(page * kPage, kPage, kPage, '\x5a');
    Write("store/errmap.sqlite", damaged);
    if (page == 0) {
      EXPECT_THAT(RefusalOf(Run({"deploy", "store", "--all"}), kUnusable),
                  AllOf(HasSubstr("store/errmap.sqlite is damaged"),
                        HasSubstr("errmap merge STORE rewrites it")));
    }
    const Outcome merge = Run({"merge", "store"});
    EXPECT_THAT(merge.err, HasSubstr("store/errmap.sqlite.damaged"));
    EXPECT_EQ(Read("store/errmap.sqlite.damaged"), damaged);
    EXPECT_EQ(Rows("store", "SELECT count(*) FROM components")[0][0],
              kComponents);
  }
}

TEST_F(FleetQuery, AFullDiskIsOneLineAndTheStoreStaysAsItWas) {
  const std::string before = Read("store/errmap.sqlite");
  EXPECT_THAT(RefusalOf(RunWithFilesUpTo(40000, {"merge", "store"}), kFailure),
              AllOf(HasSubstr("cannot write store/errmap.sqlite"),
                    HasSubstr("it is unchanged")));
  EXPECT_EQ(Read("store/errmap.sqlite"), before);
  EXPECT_FALSE(Exists("store/errmap.sqlite.new"));
}

TEST_F(FleetQuery, AMergeThatIsKilledLosesNothingAndReadersSeeWholeStores) {
  // Processes of one folder share their caught outputs.
  const ScratchFolder elsewhere;
  const std::string store = (scratch_ / "store").string();
  constexpr int kKills = 30;
  // A component that is not whole lacks rows of some table.
  const std::string rows =
      "SELECT (SELECT count(*) FROM components), (SELECT count(*) FROM "
      "models), "
      "(SELECT count(*) FROM metrics), (SELECT count(*) FROM verdicts), "
      "(SELECT count(*) FROM recommendations), (SELECT count(*) FROM maps)";
  const Json whole = Rows("store", rows);
  EXPECT_EQ(whole[0][0], kComponents);
  for (int i = 0; i < kKills; ++i) {
    Process merge(elsewhere.path(), {"merge", store});
    std::this_thread::sleep_for(std::chrono::milliseconds((i * 7) % 31));
    EXPECT_EQ(Rows("store", rows), whole);
    merge.Kill();
    merge.Wait();
    EXPECT_EQ(Rows("store", rows), whole);
  }
  EXPECT_EQ(Run({"merge", "store"}).status, 0);
  EXPECT_FALSE(Exists("store/errmap.sqlite.new"));
}

}  // namespace
}  // namespace errmap
