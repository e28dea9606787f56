// Maps that are deployed and watched, as a user does it.

#include "tests/cli/fleet/fleet_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A simulated turning centre: ten days of which maps are made, two to watch.
class Watch : public FleetTest {
 protected:
  static constexpr const char* kName = "m1/x_displacement, down";

  void Simulate(const std::string& folder,
                int days,
                std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"simulate",
                                   "turning-centre",
                                   "-o",
                                   folder,
                                   "--days",
                                   std::to_string(days),
                                   "--cycles",
                                   "8",
                                   "--points",
                                   "0",
                                   "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_EQ(Run(words).status, 0);
  }

  // Of the last two days what is measured at the component.
  void WriteNewDays(const std::string& from, const std::string& to) const {
    const std::vector<std::string> lines =
        SplitLines(Read(from + "/x_displacement_down.csv"));
    std::string text = lines.front() + "\n";
    for (std::size_t i = 1; i < lines.size(); ++i) {
      if (std::stoi(SplitFields(lines[i])[1]) > 10) text += lines[i] + "\n";
    }
    std::filesystem::create_directories(scratch_ / to / "m1");
    Write(to + "/m1/x_displacement_down.csv", text);
  }

  void SetUp() override {
    Simulate("data/m1", 10);
    Write("fleet.toml",
          "models = [\"mean\", \"poly:ridge:view=history:terms=linear\"]\n"
          "holdouts = [\"sessions:10\"]\n"
          "[[component]]\nname = \"{machine}/{component}, {direction}\"\n"
          "data = \"data/{machine}/{component:x_displacement}_"
          "{direction:down}.csv\"\n");
    const Outcome made = Study("store");
    ASSERT_EQ(made.status, 0) << made.err;
  }

  Json Watched(const std::string& data, int status) const {
    const Outcome outcome = Run({"watch", "store", data, "--format", "json"});
    EXPECT_EQ(outcome.status, status) << outcome.err;
    return Json::parse(outcome.out)["components"][0];
  }
};

TEST_F(Watch, TellsHealthyWorseAndDriftingApart) {
  const Outcome deployed = Run({"deploy", "store", kName});
  ASSERT_EQ(deployed.status, 0) << deployed.err;
  EXPECT_THAT(deployed.out, AllOf(HasSubstr("since 20"), HasSubstr("um RMSE")));
  Simulate("healthy", 12);
  WriteNewDays("healthy", "new");
  const Json healthy = Watched("new", 0);
  EXPECT_EQ(healthy["sessions"], 2);
  EXPECT_THAT(healthy["status"], Not(HasSubstr("worse")));

  // The same days again are known already.
  EXPECT_EQ(Watched("new", 0)["sessions"], 2);

  // Another map begins another history.
  ASSERT_EQ(Run({"deploy", "store", kName}).status, 0);
  Simulate("shifted", 12, {"--from-day", "11", "--shift-um", "8"});
  WriteNewDays("shifted", "later");
  const Json shifted = Watched("later", kEveryFitFailed);
  EXPECT_EQ(shifted["status"], "worse");
  EXPECT_EQ(shifted["sessions"], 2);
  EXPECT_GT(shifted["found"], shifted["promised"]);
  EXPECT_THAT(shifted["proposal"].get<std::string>(),
              HasSubstr("errmap update store/maps/"));
  EXPECT_TRUE(Exists("store/watch.html"));

  ASSERT_EQ(Run({"deploy", "store", kName}).status, 0);
  Simulate("drifting",
           12,
           {"--from-day", "11", "--drifting", "12", "--sensor-noise", "0.02"});
  WriteNewDays("drifting", "drift");
  EXPECT_EQ(Run({"watch", "store", "drift"}).status, 0);
  EXPECT_EQ(
      Rows("store", "SELECT count(*), sum(until IS NULL) FROM deployments"),
      Json::parse("[[3, 1]]"));
  EXPECT_EQ(Rows("store", "SELECT count(*) FROM checks"), Json::parse("[[6]]"));
  // A merge keeps what is deployed, and all that was checked.
  ASSERT_EQ(Run({"merge", "store"}).status, 0);
  EXPECT_EQ(Rows("store", "SELECT count(*) FROM checks"), Json::parse("[[6]]"));
}

TEST_F(Watch, WhatCannotBeDeployedOrFoundGetsOneLine) {
  EXPECT_THAT(RefusalOf(Run({"watch", "store", "data"}), kUnusable),
              HasSubstr("no map is deployed"));
  EXPECT_THAT(RefusalOf(Run({"deploy", "store", "nothing"}), kWrongCommandLine),
              HasSubstr("no component 'nothing'"));
  Write("other.json", "{}");
  RefusalOf(Run({"deploy", "store", kName, "--model", "other.json"}),
            kUnusable);
  EXPECT_EQ(Rows("store", "SELECT count(*) FROM deployments"),
            Json::parse("[[0]]"));
  ASSERT_EQ(Run({"deploy", "store", kName}).status, 0);
  EXPECT_THAT(RefusalOf(Run({"watch", "store", "missing.csv"}), kUnusable),
              HasSubstr("missing.csv"));
  EXPECT_THAT(Run({"watch", "store", "data"}).err,
              HasSubstr("of no component with a map deployed"));
}

TEST_F(Watch, FullDisksAndNewerSchemasChangeNothing) {
  ASSERT_EQ(Run({"deploy", "store", kName}).status, 0);
  const std::vector<std::vector<std::string>> commands{
      {"deploy", "store", kName},
      {"watch",
       "store",
       std::string(kName) + "=data/m1/x_displacement_down.csv"}};
  const std::string before = Read("store/errmap.sqlite");
  for (const std::vector<std::string>& words : commands) {
    SCOPED_TRACE(words.front());
    EXPECT_THAT(RefusalOf(RunWithFilesUpTo(50000, words), kFailure),
                HasSubstr("cannot write store/"));
    EXPECT_EQ(Read("store/errmap.sqlite"), before);
    EXPECT_FALSE(Exists("store/errmap.sqlite.new"));
  }
  MakeSchemaNewer("store/errmap.sqlite");
  const std::string newer = Read("store/errmap.sqlite");
  for (const std::vector<std::string>& words : commands) {
    EXPECT_THAT(RefusalOf(Run(words), kUnusable),
                HasSubstr("store/errmap.sqlite is of schema 99"))
        << words.front();
  }
  EXPECT_EQ(Read("store/errmap.sqlite"), newer);
}

TEST_F(Watch, KilledDeploymentsAndChecksLoseNothing) {
  ASSERT_EQ(Run({"deploy", "store", kName}).status, 0);
  std::int64_t deployments = 1;
  constexpr int kKills = 30;
  for (int i = 0; i < kKills; ++i) {
    const std::vector<std::string> words =
        i % 2 == 0
            ? std::vector<std::string>{"deploy", "store", kName}
            : std::vector<std::string>{
                  "watch",
                  "store",
                  std::string(kName) + "=data/m1/x_displacement_down.csv",
                  "--quiet"};
    Process process(scratch_.path(), words);
    std::this_thread::sleep_for(std::chrono::milliseconds((i * 13) % 97));
    process.Kill();
    process.Wait();
    const Json found =
        Rows("store",
             "SELECT count(*), sum(until IS NULL), "
             "(SELECT count(*) FROM checks) % 10, "
             "(SELECT count(*) FROM recommendations) FROM deployments");
    EXPECT_GE(found[0][0], deployments);
    EXPECT_EQ(found[0][1], 1);
    EXPECT_EQ(found[0][2], 0);  // ten days, or none of them
    EXPECT_EQ(found[0][3], 1);
    deployments = found[0][0];
  }
  ASSERT_EQ(Run({"deploy", "store", kName}).status, 0);
}

}  // namespace
}  // namespace errmap
