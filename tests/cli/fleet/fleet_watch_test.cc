// Maps that are deployed and watched, as a user does it.

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/cli/fleet/fleet_fixture.h"
#include "tests/cli/one_line.h"

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
                                   "--seed",
                                   "3",
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
  EXPECT_THAT(OneLine(deployed.out),
              AllOf(HasSubstr("since 20"), HasSubstr("um RMSE")));
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
              AllOf(HasSubstr("an offset of "),
                    HasSubstr("errmap check store/maps/"),
                    HasSubstr("says whether to re-zero")));
  // What is to be done stands before the figures, and all in a table.
  const std::string page = Read("store/watch.html");
  const std::size_t command = page.find("errmap check store");
  EXPECT_LT(command, page.find("<svg"));
  EXPECT_LT(page.find("All components"), page.rfind("m1/x_displacement, down"));
  EXPECT_THAT(Run({"watch", "store", "later", "--format", "md"}).out,
              HasSubstr("| m1/x\\_displacement, down | worse |"));

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

// A map is worse or not by itself; of few rows errmap check tells more, and
// nothing that was judged is not health.
TEST_F(Watch, PartsOfADay) {
  ASSERT_EQ(Run({"deploy", "store", kName}).status, 0);
  Simulate("healthy", 11);
  WriteNewDays("healthy", "new");
  const std::string whole = Read("new/m1/x_displacement_down.csv");
  const auto give = [&](std::size_t rows) {
    const std::vector<std::string> lines = SplitLines(whole);
    std::string text;
    for (std::size_t i = 0; i <= rows; ++i) text += lines[i] + "\n";
    Write("new/m1/x_displacement_down.csv", text);
  };
  give(3);
  const Outcome few = Run({"watch", "store", "new"});
  EXPECT_EQ(few.status, kNothingJudged);
  EXPECT_THAT(OneLine(few.out),
              AllOf(HasSubstr("1 too few rows"),
                    HasSubstr("errmap check store/maps/")));
  EXPECT_THAT(few.err, HasSubstr("none of the maps could be judged"));
  give(40);
  EXPECT_EQ(Watched("new", 0)["status"], "as promised");
  // The day when it was whole takes the place of its parts.
  Write("new/m1/x_displacement_down.csv", whole);
  const Json day = Watched("new", 0);
  EXPECT_EQ(day["sessions"], 1);
  EXPECT_EQ(Rows("store", "SELECT rows FROM checks"),
            Json::array({Json::array({day["rows"]})}));
  EXPECT_THAT(Read("store/watch.html"),
              HasSubstr("<p class=\"sentence\">1 component, 1 as promised"));
}

// Of one session update makes nothing. Errors that alternate are no offset.
TEST_F(Watch, ProposesAnUpdateThatRuns) {
  ASSERT_EQ(Run({"deploy", "store", kName}).status, 0);
  Simulate("healthy", 11);
  WriteNewDays("healthy", "new");
  const std::vector<std::string> lines =
      SplitLines(Read("new/m1/x_displacement_down.csv"));
  const std::vector<std::string> names = SplitFields(lines.front());
  const auto error = std::ranges::find(names, "error_mm") - names.begin();
  std::string text = lines.front() + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::vector<std::string> fields = SplitFields(lines[i]);
    std::string& field = fields.at(static_cast<std::size_t>(error));
    field = fmt::format("{}", std::stod(field) + (i % 2 == 0 ? 0.009 : -0.009));
    text += fmt::format("{}\n", fmt::join(fields, ","));
  }
  Write("new/m1/x_displacement_down.csv", text);
  const Json one = Watched("new", kEveryFitFailed);
  EXPECT_THAT(one["proposal"].get<std::string>(),
              HasSubstr("until the file has two sessions or more"));
  for (const std::string& line :
       SplitLines(Run({"watch", "store", "new"}).out)) {
    if (line.find("  worse  ") == std::string::npos) continue;
    // No sensor is suspected, so none is named.
    EXPECT_THAT(line, HasSubstr("  -  "));
  }
}

// Several maps in one change of the store, all or none.
class Deploy : public FleetTest {
 protected:
  void SetUp() override {
    WriteFleet();
    ASSERT_EQ(Study("store").status, 0);
  }
  Json InUse() const {
    return Rows("store",
                "SELECT component FROM deployments WHERE until IS NULL "
                "ORDER BY component");
  }
};

TEST_F(Deploy, AllThatHaveAMapAreDeployedAtOnce) {
  const Outcome all = Run({"deploy", "store", "--all"});
  ASSERT_EQ(all.status, 0) << all.err;
  EXPECT_THAT(all.out, HasSubstr("8 maps deployed since 20"));
  EXPECT_EQ(InUse().size(), 8U);
  EXPECT_EQ(Rows("store",
                 "SELECT count(*) FROM deployments d JOIN maps m ON "
                 "m.component = d.component AND m.sha256 = d.map"),
            Json::parse("[[8]]"));
  // Again: each begins anew, one is in use.
  ASSERT_EQ(Run({"deploy", "store", "--all"}).status, 0);
  EXPECT_EQ(InUse().size(), 8U);
  EXPECT_EQ(Rows("store", "SELECT count(*) FROM deployments"),
            Json::parse("[[16]]"));
}

TEST_F(Deploy, ListsAreDeployedWholeOrNotAtAll) {
  RefusalOf(Run({"deploy", "store", "m01/x, down", "nobody"}),
            kWrongCommandLine);
  RefusalOf(Run({"deploy", "store", "m01/x, down", "m02/yaw"}), kUnusable);
  EXPECT_EQ(InUse(), Json::array());
  ASSERT_EQ(Run({"deploy", "store", "m01/x, down", "m02/z, up"}).status, 0);
  EXPECT_EQ(InUse(), Json::parse(R"([["m01/x, down"], ["m02/z, up"]])"));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"deploy", "store"},
        {"deploy", "store", "--all", "m01/x, down"},
        {"deploy", "store", "--all", "--model", "fleet.toml"}}) {
    RefusalOf(Run(words), kWrongCommandLine);
  }
}

TEST_F(Deploy, EachMachineHasAFolder) {
  std::size_t folders = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(scratch_ / "store/components")) {
    EXPECT_THAT(entry.path().filename().string(), ::testing::StartsWith("m0"));
    ++folders;
  }
  EXPECT_EQ(folders, 2U);
  const std::string folder =
      Rows("store",
           "SELECT folder FROM components WHERE name = 'm01/x, down'")[0][0];
  EXPECT_THAT(folder, ::testing::StartsWith("components/m01/x__down-"));
  EXPECT_TRUE(Exists("store/" + folder + "/summary.json"));
  // Where a component has its folder beside the others it stays there.
  const std::string flat = "components/m01_x__down-" + folder.substr(23);
  std::filesystem::rename(scratch_ / "store" / folder,
                          scratch_ / "store" / flat);
  ASSERT_EQ(Run({"merge", "store"}).status, 0);
  EXPECT_EQ(
      Rows("store", "SELECT folder FROM components WHERE name = 'm01/x, down'"),
      Json::array({Json::array({flat})}));
}

TEST_F(Deploy, SaysWhichMapsNobodyWillWatch) {
  WriteComponent("data/m01/short_up.csv", 5, 2);
  ASSERT_EQ(Study("store").status, 0);
  EXPECT_THAT(Run({"deploy", "store", "m01/short"}).err,
              HasSubstr("errmap watch will not judge 'm01/short'"));
  EXPECT_EQ(Run({"deploy", "store", "m01/x, down"}).err, "");
}

// Whose measurements a file has, and what becomes of those already kept.
class WatchedFiles : public FleetTest {
 protected:
  void SetUp() override {
    WriteFleet();
    WriteComponent("data/m01/w_up.csv", 20);  // m02 has none
    ASSERT_EQ(Study("store").status, 0);
    for (const char* name : {"m01/x, down", "m01/w"}) {
      ASSERT_EQ(Run({"deploy", "store", name}).status, 0) << name;
    }
  }

  // How many components have sessions, and how many sessions there are.
  Json Checked() const {
    return Rows("store",
                "SELECT count(DISTINCT deployment), count(*) FROM checks");
  }
};

TEST_F(WatchedFiles, AreOfTheirOwnMachineOnly) {
  for (const char* file : {"m02/x_down.csv", "m02/w_up.csv"}) {
    WriteComponent(std::string("new/") + file, 30);
    EXPECT_THAT(Run({"watch", "store", "new"}).err,
                HasSubstr("no file belongs to a component with a deployed map"))
        << file;
  }
  EXPECT_EQ(Run({"watch", "store", "new"}).status, kUnusable);
  WriteComponent("new/m01/x_down.csv", 31);
  EXPECT_EQ(Run({"watch", "store", "new"}).err,
            "errmap: 2 files of no component with a map deployed\n");
  EXPECT_EQ(Checked(), Json::parse("[[1, 4]]"));
  // A machine that is not in the study may be any; a folder that is none of
  // the study's tells nothing.
  WriteComponent("other/m03/x_down.csv", 32);
  WriteComponent("other/september/w_up.csv", 33);
  EXPECT_THAT(Run({"watch", "store", "other"}).err,
              HasSubstr("m03/x_down.csv may be of 'm01/x, down' or of "));
  EXPECT_EQ(Checked(), Json::parse("[[2, 8]]"));
}

TEST_F(WatchedFiles, ThatMayBeOfSeveralAreNamedButNotAll) {
  for (int i = 0; i < 9; ++i) {
    WriteComponent("other/m1" + std::to_string(i) + "/x_down.csv", 32);
  }
  const std::vector<std::string> lines =
      SplitLines(Run({"watch", "store", "other"}).err);
  EXPECT_THAT(lines, ::testing::SizeIs(8));
  EXPECT_THAT(lines[4], HasSubstr("may be of "));
  EXPECT_EQ(lines[5], "errmap: likewise 4 more");
}

TEST_F(WatchedFiles, ThatCannotBeReadChangeNothing) {
  WriteComponent("new/m01/x_down.csv", 31);
  WriteComponent("new/m01/w_up.csv", 32);
  ASSERT_NE(Run({"watch", "store", "new"}).status, kUnusable);
  const auto before = Content("store", {"checks"});
  Write("new/m01/x_down.csv", "day,position_mm,error_mm\n1,2,\n");
  const auto outcome =
      Run({"watch", "store", "new/m01/x_down.csv", "--format", "json"});
  EXPECT_EQ(outcome.status, kUnusable);
  const Json found = Json::parse(outcome.out);
  EXPECT_EQ(found["components"][0]["status"], "not judged");
  EXPECT_EQ(found["components"][0]["found"], nullptr);
  EXPECT_EQ(Content("store", {"checks"}), before);
  EXPECT_THAT(
      RefusalOf(Run({"watch", "store", "m01/w=missing.csv"}), kUnusable),
      HasSubstr("missing.csv"));
}

TEST_F(WatchedFiles, ThatWereStudiedAreNoNewMeasurements) {
  EXPECT_THAT(Run({"watch", "store", "data/m01"}).err,
              HasSubstr("2 files from the study itself"));
}

TEST_F(WatchedFiles, OfTheSameRowsInAnotherUnitAreKnown) {
  WriteComponent("new/m01/x_down.csv", 31);
  ASSERT_NE(Run({"watch", "store", "new"}).status, kUnusable);
  std::string text;
  for (const std::string& line : SplitLines(Read("new/m01/x_down.csv"))) {
    const std::size_t last = line.rfind(',') + 1;
    text += line.substr(0, last) +
            (text.empty()
                 ? "error_um"
                 : std::to_string(kUmPerMm * std::stod(line.substr(last)))) +
            "\n";
  }
  Write("new/m01/x_down.csv", text);
  ASSERT_NE(Run({"watch", "store", "new"}).status, kUnusable);
  EXPECT_EQ(Checked(), Json::parse("[[1, 4]]"));
}

TEST_F(Watch, FullDisksAndNewerSchemasChangeNothing) {
  ASSERT_EQ(Run({"deploy", "store", kName}).status, 0);
  const std::vector<std::vector<std::string>> commands{
      {"deploy", "store", kName},
      {"watch",
       "store",
       std::string(kName) + "=data/m1/x_displacement_down.csv",
       "--quiet"}};
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
                HasSubstr("store/errmap.sqlite has schema 99"))
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
