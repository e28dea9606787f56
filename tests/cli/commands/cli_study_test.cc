// Study files: read, overridden, planned, written and run by the program.

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class CliStudy : public Cli {
 protected:
  /// Ten cycles of six positions, up and down, with hysteresis.
  static std::string BothWays(const std::string& position = "position_mm") {
    std::string text = "cycle,direction," + position + ",error_mm\n";
    for (int cycle = 1; cycle <= 10; ++cycle) {
      for (int i = 0; i < 12; ++i) {
        const bool up = i % 2 == 1;
        const int x = 10 * (i / 2);
        const double error =
            1e-4 * x + 1e-5 * ((7 * i + 3 * cycle) % 11) + (up ? 0.002 : 0.0);
        text += std::to_string(cycle) + (up ? ",up," : ",down,") +
                std::to_string(x) + "," + std::to_string(error) + "\n";
      }
    }
    return text;
  }

  void WriteStudy() const {
    Write("both.csv", BothWays());
    Write("study.toml",
          "seed = 3\n"
          "holdouts = [\"every:3\"]\n"
          "models = [\"mean\"]\n"
          "[[component]]\n"
          "name = \"x, down\"\n"
          "data = \"both.csv\"\n"
          "where = { direction = \"down\" }\n"
          "goal = 0.001\n"
          "[[component]]\n"
          "name = \"x, up\"\n"
          "data = \"both.csv\"\n"
          "where = { direction = \"up\" }\n"
          "[[model]]\n"
          "use = \"poly:full\"\n"
          "degree = 2\n");
  }

  Json RunStudy(std::vector<std::string> more) const {
    more.insert(more.begin(),
                {"compare", "--config", "study.toml", "--format", "json"});
    return RunJson(more);
  }

  std::string Refusal(const std::string& text, int status = kUnusable) const {
    Write("study.toml", text);
    return RefusalOf(Run({"compare", "--config", "study.toml"}), status);
  }
};

TEST_F(CliStudy, MapsEachDirectionOfOneFileAsAComponent) {
  WriteStudy();
  const Json document = RunStudy({"--out", "o"});
  EXPECT_EQ(document["seed"], 3);
  ASSERT_EQ(document["components"].size(), 2U);
  const Json& down = document["components"][0];
  const Json& up = document["components"][1];
  EXPECT_EQ(down["name"], "x, down");
  EXPECT_EQ(down["data"]["rows"], 60);
  EXPECT_EQ(down["data"]["inputs"], Json::array({"position_mm"}));
  EXPECT_EQ(down["goal"], 0.001);
  EXPECT_EQ(up["goal"], nullptr);
  EXPECT_EQ(down["models"][1]["name"], "poly:full:degree=2");
  // Rows keep their numbers in the file: the down ones are even.
  for (const Json& row : down["holdouts"][0]["test_rows"][0]) {
    EXPECT_EQ(row.get<int>() % 2, 0);
  }
  EXPECT_TRUE(Exists("o/results.json"));
  EXPECT_TRUE(Exists("o/residuals/x__down.csv"));
  EXPECT_TRUE(Exists("o/models/x__up/poly_full_degree=2.json"));
  EXPECT_FALSE(Exists("o/residuals.csv"));
}

// Of 10,000 rows figures show 5,000; every second row is held out.
TEST_F(CliStudy, DrawsRowsThatAHoldOutTests) {
  std::string text = "position_mm,error_um\n";
  for (int i = 0; i < 10'000; ++i) {
    text +=
        std::to_string(i % 20) + ',' + std::to_string(i % 20 + i % 7) + '\n';
  }
  Write("long.csv", text);
  RunJson({"compare",
           "long.csv",
           "--models",
           "mean,poly:position",
           "--holdout",
           "every:2",
           "--out",
           "long",
           "--format",
           "json"});
  EXPECT_TRUE(Exists("long/report.html"));
  const Json document = Json::parse(Read("long/results.json"));
  const Json& figures = document["components"][0]["figures"];
  int drawn = 0;
  for (const Json& value :
       figures["holdouts"][0]["predictions"]["poly:position"]) {
    drawn += value.is_null() ? 0 : 1;
  }
  EXPECT_GT(drawn, 2000);
}

TEST_F(CliStudy, ProvenanceHoldsConfigurationAndHashesOfEveryFile) {
  WriteStudy();
  const Json provenance = RunStudy({})["provenance"];
  ASSERT_EQ(provenance["inputs"].size(), 2U);
  EXPECT_EQ(provenance["inputs"][0]["file"], "study.toml");
  EXPECT_EQ(provenance["inputs"][1]["file"], "both.csv");
  EXPECT_EQ(provenance["inputs"][1]["sha256"].get<std::string>().size(), 64U);
  const Json& configuration = provenance["configuration"];
  EXPECT_EQ(configuration["seed"], 3);
  EXPECT_EQ(
      configuration["models"],
      Json::array({"mean", "poly:full:degree=2", "zero", "poly:position"}));
  EXPECT_EQ(configuration["component"][1]["where"]["direction"], "up");
  EXPECT_EQ(configuration["component"][1]["target"], "error_mm");
}

// A map of one direction is held against the rows of that direction.
TEST_F(CliStudy, AMapKnowsTheRowsThatItIsMadeFor) {
  WriteStudy();
  RunStudy({"--out", "o"});
  const std::string map = "o/models/x__up/poly_full_degree=2.json";
  ASSERT_TRUE(Exists(map));
  EXPECT_EQ(Json::parse(Read(map))["where"],
            Json::parse(R"([{"column": "direction", "text": "up"}])"));
  const Json judged =
      RunJson({"evaluate", map, "both.csv", "--format", "json"});
  EXPECT_EQ(judged["summary"]["n"], 60);
  EXPECT_LT(judged["summary"]["rmse"].get<double>(), 1e-3);
  const Outcome text = Run({"evaluate", map, "both.csv"});
  EXPECT_THAT(text.err,
              HasSubstr("60 of 120 rows have direction up, for which the map "
                        "is made"));
  // Predictions have a row for each of the file's.
  const Outcome predicted = Run({"predict", map, "both.csv"});
  EXPECT_EQ(SplitLines(predicted.out).size(), 121U);
  EXPECT_THAT(predicted.err, HasSubstr("warning: 60 of 120 rows have"));
  EXPECT_THAT(SplitLines(predicted.out)[1], HasSubstr(",0,where,"));
  EXPECT_THAT(SplitLines(predicted.out)[2], HasSubstr(",1,,"));
  // A file of one direction, or without the column, is taken whole.
  Write("up.csv", "position_mm,error_mm\n0,0.002\n10,0.003\n20,0.004\n");
  const Outcome whole = Run({"evaluate", map, "up.csv"});
  EXPECT_EQ(whole.status, 0) << whole.err;
  EXPECT_THAT(whole.err, Not(HasSubstr("is made")));
  Write("down.csv",
        "direction,position_mm,error_mm\ndown,0,0.002\ndown,10,0.003\n");
  const Outcome none = Run({"predict", map, "down.csv"});
  EXPECT_EQ(none.status, 0) << none.err;
  EXPECT_THAT(none.err,
              HasSubstr("warning: 0 of 2 rows have direction of motion up"));
  EXPECT_THAT(RefusalOf(Run({"evaluate", map, "down.csv"}), kUnusable),
              HasSubstr("no row is left where 'direction of motion' is 'up'"));
}

TEST_F(CliStudy, TableNamesTheComponentsAndCsvHasARowPerModel) {
  WriteStudy();
  const Outcome table = Run({"compare", "--config", "study.toml"});
  EXPECT_EQ(table.status, 0) << table.err;
  EXPECT_THAT(table.out, AllOf(HasSubstr("\nx, down "), HasSubstr("\nx, up ")));
  const Outcome blocks =
      Run({"compare", "--config", "study.toml", "--details"});
  EXPECT_THAT(blocks.out,
              AllOf(HasSubstr("== x, down =="), HasSubstr("== x, up ==")));
  const Outcome csv =
      Run({"compare", "--config", "study.toml", "--format", "csv"});
  EXPECT_EQ(SplitLines(csv.out).size(), 1U + 2U * 4U);
  EXPECT_THAT(csv.out, HasSubstr("\"x, up\",every:3,poly:full:degree=2,"));
  const Outcome md =
      Run({"compare", "--config", "study.toml", "--format", "md"});
  const std::vector<std::string> lines = SplitLines(md.out);
  ASSERT_EQ(lines.size(), 2U + 2U * 4U);
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), '|'),
            std::count(lines[5].begin(), lines[5].end(), '|'));
}

TEST_F(CliStudy, LeaderboardHasTheFiguresOfTheJson) {
  const std::vector<std::string> words = {
      "compare", kDown, "--models", "poly:eq8", "--format"};
  std::vector<std::string> as_csv = words;
  as_csv.emplace_back("csv");
  const auto records = Records(Run(as_csv).out);
  ASSERT_EQ(records.size(), 10U);  // four baselines are added
  const Json test = Model(Compare({"--models", "poly:eq8"}),
                          "poly:eq8")["results"]["groups:5"]["test"];
  const auto found = std::ranges::find_if(records, [](const auto& record) {
    return record.at("holdout") == "groups:5" &&
           record.at("model") == "poly:eq8";
  });
  ASSERT_NE(found, records.end());
  EXPECT_EQ(std::stod(found->at("test_rmse")), test["rmse"].get<double>());
  EXPECT_EQ(std::stod(found->at("test_sd")), test["sd"].get<double>());
  EXPECT_EQ(found->at("test_n"), "397");
  EXPECT_EQ(records[1].at("unit"), "mm");
}

TEST_F(CliStudy, PathsAreRelativeToTheStudyFile) {
  std::filesystem::create_directory(scratch_ / "sub");
  Write("sub/both.csv", BothWays());
  Write("sub/study.toml",
        "models = [\"mean\"]\nholdouts = [\"file:both.csv\"]\n"
        "[[component]]\ndata = \"both.csv\"\n"
        "where = { direction = \"up\" }\n");
  const Json document =
      RunJson({"compare", "--config", "sub/study.toml", "--format", "json"});
  const Json& component = document["components"][0];
  EXPECT_EQ(component["name"], "both, up");
  EXPECT_EQ(component["data"]["file"], "sub/both.csv");
  EXPECT_EQ(component["holdouts"][0]["name"], "file:sub/both.csv");
  EXPECT_EQ(component["holdouts"][0]["test_rows"][0].size(), 60U);
}

// Of one file, too, and whichever comes first.
TEST_F(CliStudy, EachComponentRefusesOrLeavesOutRowsOfAnotherLength) {
  const std::vector<std::string> rules = {"missing = \"drop-rows\"\n", ""};
  const auto compare = [&](const std::string& more, std::size_t first) {
    Write("both.csv", BothWays() + more);
    std::string study = "models = [\"mean\"]\n";
    for (const std::size_t i : {first, 1 - first}) {
      study += "[[component]]\ndata = \"both.csv\"\n" + rules[i] +
               "where = { direction = \"" + (i == 0 ? "up" : "down") + "\" }\n";
    }
    Write("study.toml", study);
    return Run(
        {"compare", "--config", "study.toml", "--format", "json", "--quiet"});
  };
  for (const std::size_t first : {0U, 1U}) {
    EXPECT_THAT(RefusalOf(compare("11,up,0\n", first), kUnusable),
                HasSubstr("line 122 (data row 120): 3 fields where the header "
                          "has 4"));
    const Outcome done = compare("", first);
    ASSERT_EQ(done.status, 0) << done.err;
    const Json inputs = Json::parse(done.out)["provenance"]["inputs"];
    EXPECT_EQ(std::ranges::count(inputs,
                                 "both.csv",
                                 [](const Json& input) {
                                   return input["file"].get<std::string>();
                                 }),
              1);
  }
}

// Each way in a file of its own: by the name of that file, whichever is first.
TEST_F(CliStudy, NamesTheWaysByTheFilesOfTheirRows) {
  std::map<std::string, std::string> files;
  for (const std::string& line : SplitLines(BothWays())) {
    for (const char* way : {"up", "down"}) {
      const bool is_header = line.starts_with("cycle,");
      if (is_header || line.find(std::string(",") + way) != line.npos) {
        files[way] += line + "\n";
      }
    }
  }
  Write("forth.csv", files["up"]);
  Write("back.csv", files["down"]);
  const Json document = RunJson({"compare",
                                 "back.csv",
                                 "forth.csv",
                                 "--models",
                                 "mean",
                                 "--format",
                                 "json"});
  std::set<std::string> names;
  for (const Json& component : document["components"]) {
    names.insert(component["name"]);
  }
  EXPECT_EQ(names, (std::set<std::string>{"back", "forth"}));
  ASSERT_EQ(Run({"fit",
                 "back.csv",
                 "forth.csv",
                 "--model",
                 "mean",
                 "-o",
                 "maps/",
                 "--quiet"})
                .status,
            0);
  // Up errs by 2 um more.
  const auto mean = [&](const char* map) {
    return RunJson({"evaluate",
                    map,
                    "forth.csv",
                    "--format",
                    "json"})["summary"]["mean"]
        .get<double>();
  };
  EXPECT_NEAR(mean("maps/forth.json"), 0.0, 1e-9);
  EXPECT_FALSE(Exists("maps/back_up.json"));
  EXPECT_TRUE(Exists("maps/back.json"));
}

// ---- Overrides.

TEST_F(CliStudy, SetReplacesAnyKey) {
  WriteStudy();
  const Json document = RunStudy({"--set",
                                  "seed=7",
                                  "--set",
                                  "component.\"x, up\".goal=0.25",
                                  "--set",
                                  "component.0.name=x displacement",
                                  "--set",
                                  "model.0.degree=3",
                                  "--set",
                                  "component.1.where.cycle=2",
                                  "--set",
                                  "holdouts=[\"kfold:2\"]"});
  EXPECT_EQ(document["seed"], 7);
  EXPECT_EQ(document["components"][0]["name"], "x displacement");
  EXPECT_EQ(document["components"][1]["goal"], 0.25);
  EXPECT_EQ(document["components"][1]["data"]["rows"], 6);
  EXPECT_EQ(document["components"][0]["models"][1]["name"],
            "poly:full:degree=3");
  EXPECT_EQ(document["components"][0]["holdouts"][0]["name"], "kfold:2");
}

TEST_F(CliStudy, SetSaysWhatItCannotDo) {
  WriteStudy();
  const auto refusal = [&](const std::string& change) {
    return RefusalOf(
        Run({"compare", "--config", "study.toml", "--set", change}),
        kWrongCommandLine);
  };
  EXPECT_THAT(refusal("seed=many"),
              HasSubstr("--set seed=many: 'seed' in the study must be a whole "
                        "number from 0, found text ('many')"));
  EXPECT_THAT(
      refusal("sed=1"),
      HasSubstr("unknown key 'sed' in the study; did you mean 'seed'?"));
  EXPECT_THAT(refusal("component.5.goal=1"),
              HasSubstr("no component '5'; the study file has 0 to 1"));
  EXPECT_THAT(refusal("seed"), HasSubstr("--set must be KEY=VALUE"));
  EXPECT_THAT(refusal("a b=1"), HasSubstr("--set 'a b=1'"));
  EXPECT_THAT(
      RefusalOf(Run({"compare", kDown, "--set", "seed=1"}), kWrongCommandLine),
      HasSubstr("--config"));
}

TEST_F(CliStudy, FlagsOverrideTheFileAndThoseThatCannotAreRefused) {
  WriteStudy();
  const Json document = RunStudy({"--seed",
                                  "9",
                                  "--goal",
                                  "0.5",
                                  "--holdout",
                                  "every:4",
                                  "--models",
                                  "zero"});
  EXPECT_EQ(document["seed"], 9);
  EXPECT_EQ(document["components"][0]["goal"], 0.5);
  EXPECT_EQ(document["components"][0]["holdouts"][0]["name"], "every:4");
  EXPECT_EQ(document["components"][1]["models"].size(), 3U);
  EXPECT_THAT(RefusalOf(Run({"compare", kDown, "--config", "study.toml"}),
                        kWrongCommandLine),
              HasSubstr("DATA and --config exclude each other"));
  EXPECT_THAT(
      RefusalOf(
          Run({"compare", "--config", "study.toml", "--target", "position_mm"}),
          kWrongCommandLine),
      HasSubstr("--target is for one component, and study.toml has 2"));
}

TEST_F(CliStudy, GoalsHaveUnitsOfTheirOwn) {
  WriteStudy();
  const Json document = RunStudy({"--set",
                                  "goal=2um",
                                  "--set",
                                  "component.0.goal=1500 nm",
                                  "--set",
                                  "indifference = \"1e-4 mm\""});
  EXPECT_EQ(document["components"][0]["goal"], 0.0015);
  EXPECT_EQ(document["components"][1]["goal"], 0.002);
  EXPECT_EQ(document["components"][1]["indifference"], 1e-4);
  // What was carried out is in the targets' units.
  const Json configuration = document["provenance"]["configuration"];
  EXPECT_FALSE(configuration.contains("goal"));
  EXPECT_EQ(configuration["component"][1]["goal"], 0.002);
  EXPECT_THAT(
      Run({"compare", "--config", "study.toml", "--set", "goal=1deg"}).err,
      HasSubstr("both.csv: goal is 1 deg, and the target is in mm"));
}

TEST_F(CliStudy, TheWholePageOfOneComponentIsDrawnOnRequest) {
  WriteStudy();
  RunStudy({"--out", "o"});
  const Outcome drawn = Run({"report", "o", "--component", "x, up"});
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  const std::string path = drawn.out.substr(0, drawn.out.find('\n'));
  EXPECT_THAT(path, HasSubstr("o/components/x"));
  EXPECT_THAT(
      Read(path),
      AllOf(HasSubstr("Error map of x, up"), Not(HasSubstr("x, down"))));
  EXPECT_EQ(
      Run({"report", "o", "--component", "x, up", "--format", "html"}).out,
      Read(path));
  EXPECT_THAT(RefusalOf(Run({"report", "o", "--component", "x, pu"}),
                        kWrongCommandLine),
              HasSubstr("no component 'x, pu' in the study; did you mean "
                        "'x, up'?"));
}

// ---- What is wrong with a file, and where.

TEST_F(CliStudy, UnknownKeysAreNamedWithLineColumnAndWhatIsAllowed) {
  EXPECT_THAT(Refusal("seed = 1\n[[component]]\n  targt = \"e\"\n"),
              AllOf(HasSubstr("study.toml:3:3: unknown key 'targt' in "
                              "[[component]]; did you mean 'target'?"),
                    HasSubstr("allowed are name, data, where, target")));
  EXPECT_THAT(Refusal("sead = 1\n"),
              HasSubstr("study.toml:1:1: unknown key 'sead' in the study"));
}

TEST_F(CliStudy, WrongTypesAndValuesAreNamedWithLineAndColumn) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"seed = \"one\"", ":1:8: 'seed' in the study must be a whole number"},
      {"seed = -1", ":1:8: 'seed' in the study must be a whole number from 0"},
      {"seed = 1.5", "found a number (1.5)"},
      {"goal = true",
       ":1:8: 'goal' in the study must be a number or a text such as "
       "\"2um\", found true"},
      {"goal = 0", ":1:8: 'goal' must be above 0, found 0"},
      {"goal = nan",
       ":1:8: 'goal' must be a finite number such as 0.002, or one with its "
       "unit such as 2um, found 'nan'"},
      {"goal = \"2 furlongs\"", ":1:8: 'goal' has no unit 'furlongs'"},
      {"indifference = -1", "'indifference' must be at least 0"},
      {"holdouts = \"every:3\"", "must be a list of texts such as"},
      {"holdouts = [\n  \"every:3\",\n  \"evry:3\"]", ":3:3: "},
      {"holdouts = [\"every:3\", \"every:3\"]", "'every:3' twice"},
      {"models = [1]", ":1:11: 'models' in the study must be a list of texts"},
      {"models = [\"nope\"]", ":1:11: model 'nope': unknown"},
      {"component = 1", "must be tables, each headed [[component]]"},
      {"[component]\ndata = \"x\"", "must be tables, each headed"},
      {"[[component]]\nname = \"a\"", ":1:1: [[component]]: needs data"},
      {"[[component]]\ndata = \"\"", ":2:8: 'data' must not be empty"},
      {"[[component]]\ndata = 3", "must be text in quotes"},
      {"[[component]]\ndata = \"x\"\nwhere = \"down\"", ":3:9: 'where'"},
      {"[[component]]\ndata = \"x\"\nwhere = { a = true }",
       "'a' in where must be text in quotes or a number, found true"},
      {"[[component]]\ndata = \"x\"\nmissing = \"skip\"",
       "must be \"error\" or \"drop-rows\", found text ('skip')"},
      {"[[component]]\ndata = \"x\"\nkeep_dead = 1", "must be true or false"},
      {"[[component]]\ndata = 2024-01-01", "found a date or time"},
      {"[[model]]\ndegree = 2", ":1:1: [[model]]: needs use"},
      {"\n[[model]]\nuse = \"poly:full\"\ndegre = 2", ":2:1: model "},
      {"seed = 1", "no [[component]]"},
      {"seed = ", ":1:"},
      {"seed = 1\nseed = 2", "study.toml:2:"}};
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(Refusal(text), HasSubstr(expected)) << text;
  }
  EXPECT_THAT(RefusalOf(Run({"compare", "--config", "none.toml"}), kUnusable),
              HasSubstr("none.toml: cannot be read"));
}

TEST_F(CliStudy, WhereThatFitsNoRowAndEqualNamesAreRefused) {
  Write("both.csv", BothWays());
  const std::string component = "[[component]]\ndata = \"both.csv\"\n";
  EXPECT_THAT(Refusal(component + "where = { direction = \"left\" }\n"),
              HasSubstr("no row is left where 'direction' is 'left'; the "
                        "column has 'down', 'up'"));
  EXPECT_THAT(Refusal(component + component),
              HasSubstr("two components are named 'both, "));
}

// ---- Plans.

TEST_F(CliStudy, DryRunShowsThePlanAndTouchesNothing) {
  WriteStudy();
  const Outcome outcome =
      Run({"compare", "--config", "study.toml", "--dry-run", "--out", "o"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("component x, down"),
                    HasSubstr("both.csv where direction = up"),
                    HasSubstr("60 rows, 10 groups (cycle)"),
                    HasSubstr("every:3 (1 fold)"),
                    HasSubstr("mean, poly:full:degree=2"),
                    HasSubstr("16 fits in all, seed 3; roughly a second"),
                    HasSubstr("models/COMPONENT/MODEL.json")));
  EXPECT_FALSE(Exists("o"));
  const Outcome plain = Run({"compare", kDown, "--dry-run"});
  EXPECT_THAT(plain.out, HasSubstr("126 fits in all"));
}

// ---- init.

TEST_F(CliStudy, InitWritesAFileThatDoesWhatTheDataFileAloneDoes) {
  const std::vector<std::string> quick = {
      "--models", "mean,poly:eq8", "--format", "json"};
  ASSERT_EQ(Run({"init", kDown}).status, 0);
  std::vector<std::string> words = {"compare", "--config", "study.toml"};
  words.insert(words.end(), quick.begin(), quick.end());
  Json from_file = RunJson(words)["components"];
  words = {"compare", kDown};
  words.insert(words.end(), quick.begin(), quick.end());
  Json from_data = RunJson(words)["components"];
  DropTimes(&from_file);
  DropTimes(&from_data);
  // Here the file names the roles, there the values tell them.
  from_file[0]["data"].erase("reading");
  from_data[0]["data"].erase("reading");
  EXPECT_EQ(from_file.dump(), from_data.dump());
  // The models it writes are those that the data alone would get.
  const Outcome plan = Run({"compare", "--config", "study.toml", "--dry-run"});
  const Outcome plan_of_data = Run({"compare", kDown, "--dry-run"});
  EXPECT_EQ(plan.out, plan_of_data.out);
}

TEST_F(CliStudy, InitNamesDroppedSensorsAndRefusesToOverwrite) {
  const std::string data = SetPath("turning_centre/x_displacement_down.csv");
  const Outcome outcome = Run({"init", data, "-o", "s.toml"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string text = Read("s.toml");
  EXPECT_THAT(text,
              AllOf(HasSubstr("# t03_degC is left out: is dead (0 in all 1190"),
                    HasSubstr("target = \"error_mm\""),
                    HasSubstr("group = \"cycle\""),
                    Not(HasSubstr("\ngoal ="))));
  EXPECT_THAT(RefusalOf(Run({"init", data, "-o", "s.toml"}), kWrongCommandLine),
              HasSubstr("s.toml is there already"));
  EXPECT_EQ(Read("s.toml"), text);
  EXPECT_EQ(Run({"init", data, "-o", "s.toml", "--force"}).status, 0);
}

TEST_F(CliStudy, InitMakesAComponentOfEachDirection) {
  Write("both.csv", BothWays());
  ASSERT_EQ(Run({"init", "both.csv"}).status, 0);
  const Json components = RunStudy({"--models", "mean"})["components"];
  ASSERT_EQ(components.size(), 2U);
  EXPECT_EQ(components[0]["name"], "both, down");
  EXPECT_EQ(components[1]["name"], "both, up");
  EXPECT_EQ(components[1]["data"]["rows"], 60);
}

TEST_F(CliStudy, HostileNamesSurviveInitAndCompare) {
  const std::vector<std::string> names = {"quo\"ted",
                                          "new\nline",
                                          "a = 1 # not a comment",
                                          "back\\slash",
                                          "tab\there",
                                          "\xE2\x80\xAEright to left",
                                          "'single'",
                                          "]] [[model]]",
                                          std::string(200, 'n')};
  for (const std::string& name : names) {
    std::string field = "\"";
    for (const char c : name) field += c == '"' ? "\"\"" : std::string(1, c);
    Write("data.csv", BothWays(field + "\""));
    const Outcome init = Run({"init", "data.csv", "--force"});
    ASSERT_EQ(init.status, 0) << init.err;
    const Json component = RunStudy({"--models", "mean"})["components"][0];
    EXPECT_EQ(component["data"]["inputs"], Json::array({name})) << name;
    // Named outright they come back the same.
    std::string text = Read("study.toml");
    for (std::size_t at = 0; (at = text.find("# inputs", at)) != text.npos;) {
      text.erase(at, 2);
    }
    for (std::size_t at = 0; (at = text.find("\n#   \"", at)) != text.npos;) {
      text.erase(at + 1, 2);
    }
    for (std::size_t at = 0; (at = text.find("\n# ]", at)) != text.npos;) {
      text.erase(at + 1, 2);
    }
    Write("study.toml", text);
    EXPECT_EQ(RunStudy({"--models", "mean"})["components"][0]["data"]["inputs"],
              Json::array({name}))
        << text;
  }
}

TEST_F(CliStudy, HostileValuesAndFileNamesSurviveInit) {
  std::string text = BothWays();
  const std::string odd = "\"do\"\"wn; $(id) `id`\"";
  for (std::size_t at = 0; (at = text.find(",down,", at)) != text.npos;) {
    text.replace(at, 6, "," + odd + ",");
  }
  Write("it's \"odd\".csv", text);
  ASSERT_EQ(Run({"init", "it's \"odd\".csv"}).status, 0);
  const Json components =
      RunStudy({"--models", "mean", "--out", "o"})["components"];
  ASSERT_EQ(components.size(), 2U);
  EXPECT_EQ(components[0]["data"]["rows"], 60);
  EXPECT_EQ(components[0]["data"]["file"], "it's \"odd\".csv");
}

}  // namespace
}  // namespace errmap
