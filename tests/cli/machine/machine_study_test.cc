// errmap compare --machine, as a user runs it.

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/both_ways.h"
#include "tests/cli/cli_fixture.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class MachineStudy : public Cli {
 protected:
  // Six short days with 40 poses each.
  void Simulate() const {
    ASSERT_EQ(Run({"simulate",
                   "turning-centre",
                   "-o",
                   "s",
                   "--days",
                   "6",
                   "--cycles",
                   "6",
                   "--points",
                   "40",
                   "--dead",
                   "3,4,16,19",
                   "--quiet"})
                  .status,
              0);
  }

  std::vector<std::string> Words(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"compare",
                                      "--machine",
                                      "s/machine.toml",
                                      "s",
                                      "--holdout",
                                      "sessions:4"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  // Length in X and Z of errors along both, by pose of the later days.
  static std::vector<double> Lengths(
      const std::vector<std::map<std::string, std::string>>& points,
      const std::vector<std::map<std::string, std::string>>& less) {
    std::vector<double> lengths;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::stoi(points[i].at("day")) < 5) continue;
      const auto rest = [&](const char* column) {
        return std::stod(points[i].at(column)) -
               (less.empty() ? 0.0 : std::stod(less[i].at(column)));
      };
      lengths.push_back(std::hypot(rest("error_x_mm"), rest("error_z_mm")));
    }
    return lengths;
  }

  static double Rms(const std::vector<double>& values) {
    double squares = 0.0;
    for (const double value : values) squares += value * value;
    return std::sqrt(squares / static_cast<double>(values.size()));
  }
};

TEST_F(MachineStudy, SaysWhatCompensationIsWorthOnDaysThatNoFitSaw) {
  Simulate();
  const Json document =
      RunJson(Words({"--later",
                     "2",
                     "--models",
                     "poly:ridge:view=raw,net:scg:hidden=2:iterations=60",
                     "--format",
                     "json",
                     "--out",
                     "study",
                     "--quiet"}));
  ASSERT_EQ(document["components"].size(), 15U);
  for (const Json& component : document["components"]) {
    // Four days of six cycles train, of 17 positions or 4 readings each.
    const int rows = component["data"]["rows"];
    EXPECT_TRUE(rows == 4 * 6 * 17 || rows == 4 * 6 * 4) << rows;
  }
  const Json& machine = document["machine"];
  EXPECT_EQ(machine["unit"], "mm");
  EXPECT_EQ(machine["sensitive"], "XZ");
  EXPECT_THAT(machine["later"], ElementsAre("5", "6"));
  std::vector<std::string> names;
  for (const Json& choice : machine["choices"]) {
    names.push_back(choice["name"]);
    EXPECT_TRUE(choice["why"].is_null()) << choice["why"];
    EXPECT_EQ(choice["points"], 80);
    EXPECT_EQ(choice["days"].size(), 2U);
    EXPECT_EQ(choice["positioning"].size(), 2U);  // EXX and EZZ
    EXPECT_LE(choice["p95_ci95"][0], choice["p95_ci95"][1]);
  }
  EXPECT_THAT(
      names,
      ElementsAre("uncompensated", "polynomial", "neural", "recommended"));
  const Json& before = machine["choices"][0];
  const Json& polynomial = machine["choices"][1];
  EXPECT_EQ(before["maps"].size(), 0U);
  EXPECT_EQ(polynomial["maps"].size(), 15U);
  EXPECT_LT(polynomial["p95"].get<double>(), before["p95"].get<double>() / 4.0);
  // Backlash is in the maps of both directions.
  EXPECT_EQ(before["positioning"][1]["component"], "EXX");
  EXPECT_GT(before["positioning"][1]["reversal"], 0.002);
  EXPECT_LT(polynomial["positioning"][1]["reversal"], 0.001);

  // Four body diagonals would be of three axes; the face has two.
  ASSERT_EQ(before["diagonals"].size(), 2U);
  EXPECT_EQ(before["diagonals"][0]["component"], "p0p");
  EXPECT_EQ(before["diagonals"][1]["component"], "p0n");
  for (std::size_t i = 0; i < 2; ++i) {
    for (const char* figure : {"systematic", "accuracy"}) {
      EXPECT_GT(polynomial["diagonals"][i][figure].get<double>(), 0.0);
      EXPECT_LT(polynomial["diagonals"][i][figure].get<double>(),
                before["diagonals"][i][figure].get<double>() / 2.0)
          << figure;
    }
  }

  // Every component has its part, the largest first.
  ASSERT_EQ(polynomial["parts"].size(), 13U);
  EXPECT_GE(polynomial["parts"][0]["rms"], polynomial["parts"][12]["rms"]);
  EXPECT_LT(polynomial["parts"][0]["rms"], before["parts"][0]["rms"]);

  // Cells of the plane hold every pose once.
  EXPECT_EQ(machine["plane"]["across"], "Z");
  EXPECT_EQ(machine["plane"]["up"], "X");
  int in_cells = 0;
  double squares = 0.0;
  for (const Json& cell : before["cells"]) {
    in_cells += cell["points"].get<int>();
    squares +=
        cell["points"].get<double>() * std::pow(cell["rms"].get<double>(), 2);
  }
  EXPECT_EQ(in_cells, 80);
  EXPECT_NEAR(std::sqrt(squares / 80.0), before["rms"], 1e-12);

  // The same from the other side: the poses and errmap volumetric.
  const auto points = Records(Read("s/tool_tip.csv"));
  EXPECT_NEAR(Rms(Lengths(points, {})), before["rms"], 1e-12);
  std::string toml = Read("s/machine.toml");
  for (const Json& map : polynomial["maps"]) {
    const std::string stem = map["component"];
    std::string model;
    for (const auto& entry : std::filesystem::directory_iterator(
             scratch_ / ("study/models/" + stem))) {
      const std::string path = entry.path().filename();
      const Json saved = Json::parse(Read("study/models/" + stem + "/" + path));
      if (saved["name"] == map["model"]) model = path;
    }
    const std::string from = "\"" + stem + ".json\"";
    toml.replace(toml.find(from),
                 from.size(),
                 "\"study/models/" + stem + "/" + model + "\"");
  }
  Write("fitted.toml", toml);
  const Outcome outcome = Run({"volumetric",
                               "fitted.toml",
                               "--at",
                               "s/tool_tip.csv",
                               "--after",
                               "s/temperatures.csv",
                               "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NEAR(
      Rms(Lengths(points, Records(outcome.out))), polynomial["rms"], 1e-12);

  EXPECT_THAT(Read("study/report.html"),
              AllOf(HasSubstr("<p class=\"sentence\">Without maps the tool "
                              "is off by up to "),
                    HasSubstr("Error at the tool of turning centre"),
                    HasSubstr("Positioning by ISO 230-2:2014"),
                    HasSubstr("Diagonals of the work volume, ISO 230-6:2002"),
                    HasSubstr("What each component leaves at the tool"),
                    HasSubstr("id=\"machine-arrows-before-t\""),
                    HasSubstr("id=\"machine-grid-after-t\""),
                    HasSubstr("href=\"#machine\"")));
  EXPECT_THAT(Read("study/report.md"),
              HasSubstr("Error at the tool of turning centre"));
}

// Two days decide nothing about maps, but tell how far days are apart.
TEST_F(MachineStudy, StatesIntervalsFromWholeDays) {
  ASSERT_EQ(Run({"simulate",
                 "turning-centre",
                 "-o",
                 "s",
                 "--days",
                 "3",
                 "--cycles",
                 "12",
                 "--points",
                 "60",
                 "--dead",
                 "3,4,16,19",
                 "--quiet"})
                .status,
            0);
  const Json document = RunJson({"compare",
                                 "--machine",
                                 "s/machine.toml",
                                 "s",
                                 "--models",
                                 "poly:ridge:view=raw",
                                 "--format",
                                 "json",
                                 "--quiet"});
  const Json& advised = document["machine"]["choices"][3];
  ASSERT_TRUE(advised["why"].is_null());
  for (const std::size_t d : {0U, 2U}) {
    EXPECT_GT(advised["within_90"][d], 0.8) << d;
  }
}

// The slide is read where it errs by its place alone, but at the tool another
// 3 um come and go with the days, which no reading of it shows.
TEST_F(MachineStudy, StatesIntervalsByTheToolOnSessionsHeldOut) {
  std::filesystem::create_directory(scratch_ / "one");
  std::string readings = "day,time_s,position_mm,error_mm\n";
  std::string points = "day,time_s,x_mm,error_x_mm,error_y_mm,error_z_mm\n";
  for (int day = 1; day <= 5; ++day) {
    for (int i = 0; i < 20; ++i) {
      const double x = -10.0 * (1 + i % 10);
      const double wobble = 1e-4 * ((day + 3 * i) % 5 - 2);
      const double time = 86400.0 * day + 60.0 * i;
      readings += fmt::format("{},{},{},{}\n", day, time, x, 1e-4 * x + wobble);
      points += fmt::format("{},{},{},{},0,0\n",
                            day,
                            time + 30.0,
                            x,
                            1e-4 * x + (day % 2 == 0 ? 0.003 : -0.003));
    }
  }
  Write("one/x.csv", readings);
  Write("one/tool_tip.csv", points);
  Write("one.toml",
        "[[link]]\nname = \"X\"\nbranch = \"tool\"\njoint = \"linear\"\n"
        "axis = [1, 0, 0]\ncoordinate = \"x_mm\"\n"
        "errors = { EXX = \"x.json\" }\n");
  const Json document = RunJson({"compare",
                                 "--machine",
                                 "one.toml",
                                 "one",
                                 "--models",
                                 "poly:position",
                                 "--format",
                                 "json",
                                 "--quiet"});
  const Json& advised = document["machine"]["choices"][3];
  ASSERT_TRUE(advised["why"].is_null()) << advised["why"];
  EXPECT_NEAR(advised["rms"], 0.003, 1e-4);
  // By the readings alone it would be 0.25 um, and no pose within.
  EXPECT_EQ(advised["within_90"][0], 1.0);
  EXPECT_NEAR(advised["half_width_90"][0], 1.645 * 0.003, 2e-4);
  EXPECT_THAT(advised["held_out"], ElementsAre("1", "2", "3", "4"));
  // Nothing errs along Y, and nothing is said to.
  EXPECT_EQ(advised["within_90"][1], 1.0);
  EXPECT_EQ(advised["half_width_90"][1], 0.0);
  const Outcome screen = Run({"compare",
                              "--machine",
                              "one.toml",
                              "one",
                              "--models",
                              "poly:position",
                              "--quiet"});
  EXPECT_THAT(OneLine(screen.out),
              AllOf(HasSubstr("Stated 90 % intervals of the error at the tool"),
                    HasSubstr("from the errors at the tool in sessions "
                              "1, 2, 3, 4, each held out in turn")));
}

// The folder by an absolute path, which the record does not keep.
TEST_F(MachineStudy, NeedsNoDiagonalsAndKeepsNoPath) {
  Simulate();
  std::filesystem::remove(scratch_ / "s/diagonals.csv");
  const std::string folder = (scratch_ / "s").string();
  const Json document = RunJson({"compare",
                                 "--machine",
                                 folder + "/machine.toml",
                                 folder,
                                 "--models",
                                 "poly:ridge:view=raw",
                                 "--format",
                                 "json",
                                 "--quiet"});
  EXPECT_EQ(document["machine"]["file"], "machine.toml");
  EXPECT_EQ(document["machine"]["points"], "tool_tip.csv");
  for (const Json& choice : document["machine"]["choices"]) {
    EXPECT_EQ(choice["diagonals"].size(), 0U);
  }
}

TEST_F(MachineStudy, SaysWhyAChoiceHasNoFigures) {
  Simulate();
  const Outcome outcome = Run(Words({"--models", "poly:ridge:view=raw"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(OneLine(outcome.out),
              AllOf(HasSubstr("The recommended maps leave "),
                    HasSubstr("Error at the tool of turning centre, um"),
                    HasSubstr("neural: no neural map of parallelism"),
                    HasSubstr("recommended"),
                    // Of one day there is no interval over days.
                    Not(HasSubstr("Over days"))));
}

TEST_F(MachineStudy, RefusesWhatCannotBeJudged) {
  Simulate();
  Write("empty.toml",
        "[[link]]\nname = \"T\"\nbranch = \"tool\"\njoint = \"fixed\"\n"
        "errors = { EXT = 0.001 }\n");
  std::filesystem::create_directory(scratch_ / "bare");
  Write("bare.toml",
        "[[link]]\nname = \"X\"\nbranch = \"tool\"\njoint = \"linear\"\n"
        "axis = [1, 0, 0]\ncoordinate = \"x_mm\"\n"
        "errors = { EXX = \"x.json\" }\n");
  Write("turned.toml",
        "[[link]]\nname = \"X\"\nbranch = \"tool\"\njoint = \"linear\"\n"
        "axis = [1, 0, 0]\ncoordinate = \"x_mm\"\n"
        "errors = { EBX = \"x_straightness.json\" }\n");
  for (const char* folder : {"fewer", "askew"}) {
    std::filesystem::create_directory(scratch_ / folder);
    Write(std::string(folder) + "/tool_tip.csv",
          folder == std::string("askew")
              ? "day,x_mm,error_x_mm,error_y_mm,error_z_mm\n1,1,0,0,0\n"
                "2,1,0,0,0\n"
              : "day,x_mm,error_x_mm,error_y_mm\n1,1,0,0\n2,1,0,0\n");
  }
  Write("askew/diagonals.csv",
        "day,diagonal,diagonal_direction,x_mm,error_x_mm,error_y_mm,"
        "error_z_mm\n1,up,forward,1,0,0,0\n");
  std::filesystem::create_directory(scratch_ / "named");
  Write("named/tool_tip.csv", Read("askew/tool_tip.csv"));
  std::string readings = "day,time_s,position_mm,error_mm\n";
  for (int i = 0; i < 20; ++i) {
    readings += fmt::format("{},{},{},{}\n",
                            i < 10 ? "Monday" : "Tuesday",
                            60 * i,
                            -10 * i,
                            0.001 * (i % 3));
  }
  Write("named/x.csv", readings);
  std::filesystem::create_directory(scratch_ / "ways");
  Write("ways/tool_tip.csv", Read("askew/tool_tip.csv"));
  Write("ways/x.csv", RowsOfBothWays());
  struct Case {
    std::vector<std::string> words;
    int status;
    const char* says;
  };
  const std::vector<Case> cases = {
      {{"compare", "s/x_yaw.csv", "--later", "2"},
       kWrongCommandLine,
       "--later needs --machine"},
      {{"compare", "--machine", "s/machine.toml"},
       kWrongCommandLine,
       "--machine needs the folder"},
      {Words({"--target", "error_mm"}),
       kWrongCommandLine,
       "--target is for one"},
      {Words({"--later", "6"}),
       kUnusable,
       "s/tool_tip.csv: 6 sessions by 'day', and --later 6"},
      {{"compare", "--machine", "s/machine.toml", "bare"},
       kUnusable,
       "bare/tool_tip.csv"},
      {{"compare", "--machine", "empty.toml", "s"},
       kUnusable,
       "empty.toml: names no map"},
      {{"compare", "--machine", "turned.toml", "s", "--quiet"},
       kUnusable,
       "s/x_straightness.csv: 'error_mm' is in mm, and EBX of turned.toml is "
       "an angle"},
      {{"compare", "--machine", "bare.toml", "named", "--quiet"},
       kUnusable,
       "named/x.csv: none of its sessions ('Monday', 'Tuesday') is one of "
       "named/tool_tip.csv ('1', '2'), so those that judge cannot be kept from "
       "the fits; name them alike"},
      {{"compare", "--machine", "bare.toml", "ways", "--quiet"},
       kUnusable,
       "ways/x.csv: its rows go both ways, and bare.toml asks for one map of "
       "them, x.json"},
      {{"compare", "--machine", "bare.toml", "fewer"},
       kUnusable,
       "fewer/tool_tip.csv: no column 'error_z_mm'"},
      {{"compare", "--machine", "bare.toml", "askew"},
       kUnusable,
       "askew/diagonals.csv: line 2 (data row 0), column 'diagonal': 'up' is "
       "not a diagonal"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(::testing::PrintToString(c.words));
    EXPECT_THAT(RefusalOf(Run(c.words), c.status), HasSubstr(c.says));
  }
}

}  // namespace
}  // namespace errmap
