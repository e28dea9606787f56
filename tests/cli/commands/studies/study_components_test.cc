// Study files: their components, run by the program.

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/commands/studies/study_of_both_ways.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class StudyComponents : public StudyOfBothWays {};

TEST_F(StudyComponents, MapsEachDirectionOfOneFileAsAComponent) {
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
TEST_F(StudyComponents, DrawsRowsThatAHoldOutTests) {
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

TEST_F(StudyComponents, ProvenanceHoldsConfigurationAndHashesOfEveryFile) {
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
TEST_F(StudyComponents, AMapKnowsTheRowsThatItIsMadeFor) {
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

TEST_F(StudyComponents, TableNamesTheComponentsAndCsvHasARowPerModel) {
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

TEST_F(StudyComponents, LeaderboardHasTheFiguresOfTheJson) {
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

TEST_F(StudyComponents, PathsAreRelativeToTheStudyFile) {
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
TEST_F(StudyComponents, EachComponentRefusesOrLeavesOutRowsOfAnotherLength) {
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
TEST_F(StudyComponents, NamesTheWaysByTheFilesOfTheirRows) {
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

TEST_F(StudyComponents, TheWholePageOfOneComponentIsDrawnOnRequest) {
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

}  // namespace
}  // namespace errmap
