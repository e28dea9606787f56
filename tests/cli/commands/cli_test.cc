// The figures and files of the program.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// ---- Figures computed independently, and those of the report.

struct Expected {
  const char* model;
  double every_3;
  double groups_5;
  double tolerance_every_3;  // half a unit of the last digit stated
  double tolerance_groups_5;
};

TEST_F(Cli, ReproducesTheIndependentFiguresOfTheShippedMeasurements) {
  const std::vector<Expected> expected = {
      {"mean", 5.8805, 5.9359, 5e-5, 5e-5},
      {"poly:eq8", 1.5022, 2.6608, 5e-5, 5e-5},
      {"poly:eq9", 1.6516, 2.7504, 5e-5, 5e-5},
      {"poly:full:degree=3", 0.5460, 0.9378, 5e-5, 5e-5},
      {"poly:full:degree=6:clip=none", 0.487, 10.25, 5e-4, 5e-3}};
  std::string list;
  for (const Expected& row : expected) {
    list += (list.empty() ? "" : ",") + std::string(row.model);
  }
  const Json component = Compare({"--models", list});
  for (const Expected& row : expected) {
    const Json results = Model(component, row.model)["results"];
    const auto rmse_um = [&](const char* holdout) {
      return results[holdout]["test"]["rmse"].get<double>() * kUmPerMm;
    };
    EXPECT_NEAR(rmse_um("every:3"), row.every_3, row.tolerance_every_3)
        << row.model;
    EXPECT_NEAR(rmse_um("groups:5"), row.groups_5, row.tolerance_groups_5)
        << row.model;
    EXPECT_EQ(results["groups:5"]["test"]["n"], 397);
  }
  const Json eq8 = Model(component, "poly:eq8")["results"]["every:3"];
  constexpr double kHalfDigit = 5e-5;
  EXPECT_NEAR(
      eq8["train"]["rmse"].get<double>() * kUmPerMm, 1.5277, kHalfDigit);
  EXPECT_EQ(eq8["test"]["n"], 132);
  EXPECT_NEAR(
      eq8["test"]["mean"].get<double>() * kUmPerMm, -0.0042, kHalfDigit);
  EXPECT_NEAR(eq8["test"]["sd"].get<double>() * kUmPerMm, 1.5079, kHalfDigit);
  EXPECT_EQ(component["data"]["unit"], "mm");
}

TEST_F(Cli, Eq8FittedToAllRowsHasThePublishedCoefficients) {
  const Json model = Fit("poly:eq8", "m.json");
  EXPECT_EQ(model["schema"], "errmap-model-1");
  EXPECT_EQ(model["kind"], "polynomial");
  EXPECT_EQ(model["parameters"], 5);
  EXPECT_EQ(model["inputs"][0]["name"], "position_mm");
  EXPECT_EQ(model["inputs"][1]["name"], "elapsed_cycles");
  EXPECT_EQ(model["inputs"][0]["min"], -215.9);
  EXPECT_EQ(model["inputs"][1]["max"], 34.0);

  // From scaled inputs (x - a) s, (e - b) t to physical ones, then from
  // elapsed cycles e to T = e + 1.
  const Json& form = model["polynomial"];
  const double a = form["input_offset"][0];
  const double b = form["input_offset"][1];
  const double s = form["input_scale"][0];
  const double t = form["input_scale"][1];
  std::map<std::vector<int>, double> scaled;
  for (const Json& term : form["terms"]) {
    scaled[term["powers"].get<std::vector<int>>()] = term["coefficient"];
  }
  ASSERT_EQ(scaled.size(), 4U);
  const double xx = scaled.at({2, 0}) * s * s;
  const double xe = scaled.at({1, 1}) * s * t;
  const double x = scaled.at({1, 0}) * s - 2 * a * xx - b * xe;
  const double e = scaled.at({0, 1}) * t - a * xe;
  const double one = form["intercept"].get<double>() -
                     scaled.at({1, 0}) * s * a + xx * a * a -
                     scaled.at({0, 1}) * t * b + xe * a * b;
  // Half a unit of the ninth digit.
  EXPECT_NEAR(one - e, 3.79060810e-03, 5e-12);
  EXPECT_NEAR(x - xe, 1.81768672e-04, 5e-13);
  EXPECT_NEAR(xx, 3.34501809e-07, 5e-16);
  EXPECT_NEAR(e, -3.44191606e-05, 5e-14);
  EXPECT_NEAR(xe, -1.00389845e-06, 5e-15);
  // The constants above, less T = e + 1.
  EXPECT_EQ(form["equation"],
            "error_mm = 3.75618894e-03 + 1.80764773e-04*position_mm - "
            "3.44191606e-05*elapsed_cycles + 3.34501809e-07*position_mm^2 - "
            "1.00389845e-06*position_mm*elapsed_cycles");
}

TEST_F(Cli, ResidualsOfAppendixBHaveTheirTrueFigures) {
  const Json json = RunJson({"residuals",
                             kAppendixB,
                             "--column",
                             "residual_mm",
                             "--as-printed-1995",
                             "--format",
                             "json"});
  EXPECT_EQ(json["schema"], "errmap-residuals-1");
  EXPECT_EQ(json["unit"], "mm");
  const auto um = [](const Json& value) {
    return value.get<double>() * kUmPerMm;
  };
  EXPECT_EQ(json["summary"]["n"], 397);
  EXPECT_NEAR(um(json["summary"]["mean"]), 0.00507, 5e-6);
  EXPECT_NEAR(um(json["summary"]["sd"]), 0.24112, 5e-6);
  EXPECT_NEAR(json["normality"]["ks"]["d"].get<double>(), 0.03801, 5e-6);
  // What the report prints: 0.0025278, 0.1701827, 0.0915280, 0.0025838; from
  // residuals rounded to four digits these come out.
  const Json& printed = json["as_printed_1995"];
  EXPECT_NEAR(um(printed["mean"]), 0.002528, 5e-7);
  EXPECT_NEAR(um(printed["sd"]), 0.17018, 5e-6);
  EXPECT_NEAR(printed["ks"]["d"].get<double>(), 0.09154, 5e-6);
  EXPECT_NEAR(printed["ks"]["p_given"].get<double>(), 0.00258, 5e-6);
}

TEST_F(Cli, ResidualsTextSaysWhichDefinitionIsWhich) {
  const Outcome outcome = Run({"residuals",
                               kAppendixB,
                               "--column",
                               "residual_mm",
                               "--as-printed-1995"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("0.24112 um  (n - 1)"),
                    HasSubstr("0.03801"),
                    HasSubstr("0.170184 um"),
                    HasSubstr("mean and sd given; asymptotic")));
}

TEST_F(Cli, NetWithDefaultOptionsHasItsMedianBelowTheFloor) {
  constexpr int kSeeds = 20;
  constexpr double kFloorUm = 0.45;
  std::vector<double> rmse_um;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Json component = Compare({"--models",
                                    "net:scg",
                                    "--holdout",
                                    "every:3",
                                    "--seed",
                                    std::to_string(seed)});
    const Json& results = component["models"][0]["results"]["every:3"];
    rmse_um.push_back(results["test"]["rmse"].get<double>() * kUmPerMm);
  }
  std::sort(rmse_um.begin(), rmse_um.end());
  const double median = (rmse_um[kSeeds / 2 - 1] + rmse_um[kSeeds / 2]) / 2;
  EXPECT_LT(median, kFloorUm);
}

// ---- Same data, same seed, same answer.

struct Everything {
  std::string results;
  std::string residuals;
  std::map<std::string, std::string> models;
};

class CliRepeats : public Cli {
 protected:
  Everything CompareInto(const std::string& folder,
                         const std::string& jobs,
                         const std::string& seed) const {
    Json document = RunJson({"compare",
                             kDown,
                             "--models",
                             "mean,poly:eq8,poly:full:degree=6,poly:stepwise,"
                             "net:scg:iterations=100",
                             "--format",
                             "json",
                             "--jobs",
                             jobs,
                             "--seed",
                             seed,
                             "--out",
                             folder});
    Json written = Json::parse(Read(folder + "/results.json"));
    EXPECT_EQ(document.dump(), written.dump());
    DropTimes(&document);
    Everything all{document.dump(), Read(folder + "/residuals.csv"), {}};
    for (const auto& entry :
         std::filesystem::directory_iterator(scratch_ / (folder + "/models"))) {
      const std::string name = entry.path().filename().string();
      all.models[name] = Process::TextOf(entry.path());
    }
    return all;
  }
};

TEST_F(CliRepeats, NumberOfJobsChangesNoByte) {
  const Everything one = CompareInto("one", "1", "1");
  EXPECT_EQ(one.models.size(), 8U);  // three baselines are added
  for (const std::string jobs : {"2", "5"}) {
    const Everything other = CompareInto("jobs" + jobs, jobs, "1");
    EXPECT_EQ(one.results, other.results) << jobs;
    EXPECT_EQ(one.residuals, other.residuals) << jobs;
    EXPECT_EQ(one.models, other.models) << jobs;
  }
}

TEST_F(CliRepeats, AnotherSeedChangesTheNetOnly) {
  const Json a = Json::parse(CompareInto("a", "2", "1").results);
  const Json b = Json::parse(CompareInto("b", "2", "2").results);
  const Json& models_a = a["components"][0]["models"];
  const Json& models_b = b["components"][0]["models"];
  ASSERT_EQ(models_a.size(), 8U);
  for (std::size_t i = 0; i < models_a.size(); ++i) {
    const bool is_net = models_a[i]["kind"] == "net";
    for (const char* holdout : {"every:3", "groups:5"}) {
      // Intervals are resampled, so they follow the seed as well.
      EXPECT_EQ(models_a[i]["results"][holdout]["test"] !=
                    models_b[i]["results"][holdout]["test"],
                is_net)
          << models_a[i]["name"];
    }
  }
}

// ---- Saved maps.

TEST_F(Cli, SavedMapPredictsTheHeldOutRowsBitForBit) {
  // A map fitted to the training rows of every:3 alone must predict the held
  // out rows as the comparison did; a text of all digits shows every bit.
  const std::vector<std::string> lines = SplitLines(Process::TextOf(kDown));
  std::string train = lines[0] + "\n";
  std::string test = lines[0] + "\n";
  for (std::size_t row = 0; row + 1 < lines.size(); ++row) {
    (row % 3 == 2 ? test : train) += lines[row + 1] + "\n";
  }
  Write("train.csv", train);
  Write("test.csv", test);
  Compare({"--models",
           "poly:eq8,poly:full:degree=6",
           "--holdout",
           "every:3",
           "--out",
           "o"});
  const auto held_out = Records(Read("o/residuals.csv"));
  ASSERT_EQ(held_out.size(), 132U);
  for (const std::string model : {"poly:eq8", "poly:full:degree=6"}) {
    ASSERT_EQ(
        Run({"fit", "train.csv", "--model", model, "-o", "m.json"}).status, 0);
    const Outcome outcome = Run({"predict", "m.json", "test.csv"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto predicted = Records(outcome.out);
    ASSERT_EQ(predicted.size(), held_out.size());
    for (std::size_t i = 0; i < predicted.size(); ++i) {
      EXPECT_EQ(predicted[i].at("predicted"), held_out[i].at(model)) << i;
    }
  }
}

TEST_F(Cli, MapsOfOutFolderEqualThoseOfFit) {
  Compare({"--models",
           "poly:eq9,net:scg:iterations=60",
           "--holdout",
           "groups:5",
           "--out",
           "o"});
  const std::map<std::string, std::string> files = {
      {"poly:eq9", "o/models/poly_eq9.json"},
      {"net:scg:iterations=60", "o/models/net_scg_iterations=60.json"}};
  for (const auto& [model, file] : files) {
    Json fitted = Fit(model, "m.json");
    Json compared = Json::parse(Read(file));
    fitted.erase("provenance");
    compared.erase("provenance");
    // Of the provenance, too.
    fitted.erase("checksum");
    compared.erase("checksum");
    EXPECT_EQ(fitted.dump(), compared.dump());
    const std::string predicted = Run({"predict", "m.json", kDown}).out;
    EXPECT_EQ(predicted, Run({"predict", file, kDown}).out);
    EXPECT_EQ(SplitLines(predicted).size(), 398U);
  }
}

TEST_F(Cli, EvaluateReproducesTheTrainingFigures) {
  for (const std::string model : {"poly:eq8", "net:scg:iterations=60"}) {
    const Json fit = RunJson(
        {"fit", kDown, "--model", model, "-o", "m.json", "--format", "json"});
    const Json evaluated =
        RunJson({"evaluate", "m.json", kDown, "--format", "json"});
    EXPECT_EQ(fit["train"]["rmse"], evaluated["summary"]["rmse"]);
    EXPECT_EQ(fit["train"]["sd"], evaluated["summary"]["sd"]);
    EXPECT_EQ(evaluated["summary"]["n"], 397);
  }
}

TEST_F(Cli, PredictKeepsIdColumnsAndMarksExtrapolation) {
  Fit("poly:eq8", "m.json");
  Write("p.csv",
        "note,elapsed_cycles,record,position_mm\na,0,7,-12.7\nb,5,8,-300\n");
  const Outcome outcome = Run({"predict", "m.json", "p.csv"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(SplitLines(outcome.out)[0],
            "record,position_mm,predicted,lower_90,upper_90,lower_95,upper_95,"
            "inside,why,offender,unit");
  const auto records = Records(outcome.out);
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].at("record"), "7");
  EXPECT_EQ(records[0].at("position_mm"), "-12.7");
  EXPECT_EQ(records[0].at("unit"), "mm");
  const double promised = std::stod(records[0].at("predicted"));
  const double lower = std::stod(records[0].at("lower_90"));
  EXPECT_LT(lower, promised);
  EXPECT_NEAR(
      std::stod(records[0].at("upper_90")) - promised, promised - lower, 1e-12);
  EXPECT_LE(std::stod(records[0].at("lower_95")), lower);
  EXPECT_EQ(records[0].at("inside"), "1");
  EXPECT_EQ(records[1].at("inside"), "0");
  EXPECT_THAT(outcome.err, HasSubstr("trained -215.9 to -12.7: 1 row outside"));
  EXPECT_THAT(outcome.err, HasSubstr("the compensation is minus that"));
  EXPECT_EQ(Run({"predict", "m.json", "p.csv", "-o", "p.out"}).out, "");
  EXPECT_EQ(Read("p.out"), outcome.out);
  Write("q.csv", "position_mm\n-12.7\n");
  EXPECT_THAT(RefusalOf(Run({"predict", "m.json", "q.csv"}), kUnusable),
              HasSubstr("q.csv: no column 'elapsed_cycles'"));
}

// Cycles through five positions, with what stands before each row.
std::string Ways(const std::vector<std::string>& before_each_way) {
  std::string text;
  for (int cycle = 0; cycle < 6; ++cycle) {
    for (const std::string& before : before_each_way) {
      for (int i = 0; i < 5; ++i) {
        const bool up = &before == before_each_way.data();
        const int at = up ? i : 4 - i;
        text += before + std::to_string(cycle) + "," + std::to_string(50 * at) +
                "," + std::to_string(20 + cycle) + "," +
                std::to_string(2 * at + cycle % 3 + (up ? 0 : 5) + i % 2) +
                "\n";
      }
    }
  }
  return text;
}

// How many rows are answered with this reason.
int CountWhy(const std::string& predictions, const std::string& why) {
  const auto records = Records(predictions);
  return static_cast<int>(std::ranges::count_if(
      records, [&](const auto& row) { return row.at("why") == why; }));
}

TEST_F(Cli, PredictIsForTheWayThatTheMapWasFittedTo) {
  const std::string names = "cycle,position_mm,t1_degC,error_um\n";
  Write("up.csv", names + Ways({""}));
  Write("both.csv", names + Ways({"", ""}));
  Write("named.csv", "direction," + names + Ways({"+,", "-,"}));
  Write("words.csv", "direction," + names + Ways({"up,", "down,"}));
  Write("other.csv", "approach," + names + Ways({"+,", "-,"}));
  Write("forth.csv", "direction," + names + Ways({"forward,", "reverse,"}));
  ASSERT_EQ(
      Run({"fit", "up.csv", "--model", "poly:eq8", "-o", "up.json"}).status, 0);
  ASSERT_EQ(Run({"fit",
                 "words.csv",
                 "--direction",
                 "up",
                 "--model",
                 "poly:eq8",
                 "-o",
                 "filtered.json"})
                .status,
            0);
  EXPECT_EQ(CountWhy(Run({"predict", "up.json", "up.csv"}).out, "where"), 0);
  for (const char* map : {"up.json", "filtered.json"}) {
    for (const char* file :
         {"both.csv", "named.csv", "words.csv", "other.csv", "forth.csv"}) {
      const Outcome outcome = Run({"predict", map, file});
      EXPECT_EQ(CountWhy(outcome.out, "where"), 30) << map << " " << file;
      EXPECT_THAT(outcome.err, HasSubstr("30 of 60 rows have direction"));
    }
  }
}

TEST_F(Cli, PredictWarnsWhereAMemoryCountsOtherRows) {
  const auto log = [](int step) {
    std::string text = "day,cycle,position_mm,t1_degC,error_um\n";
    for (int row = 0; row < 3 * 6 * 9; ++row) {
      if (row % 9 % step != 0) continue;
      const int cycle = row / 9 % 6;
      const double warm = 3.0 * (1.0 - std::exp(-cycle / 2.0));
      text += fmt::format("{},{},{},{:.2f},{:.2f}\n",
                          row / 54,
                          cycle,
                          50 * (row % 9),
                          20.0 + warm,
                          4.0 * warm + row % 9 + 0.1 * (row % 7));
    }
    return text;
  };
  Write("train.csv", log(1));
  Write("fewer.csv", log(2));
  ASSERT_EQ(Run({"fit",
                 "train.csv",
                 "--model",
                 "poly:ridge:view=history",
                 "-o",
                 "rows.json"})
                .status,
            0);
  EXPECT_THAT(Run({"predict", "rows.json", "fewer.csv"}).err,
              HasSubstr("9 in a cycle when it was fitted, 5 here"));
  EXPECT_THAT(Run({"predict", "rows.json", "train.csv"}).err,
              ::testing::Not(HasSubstr("counting rows")));
}

TEST_F(Cli, FitPromisesWhatUnseenCyclesShow) {
  const Outcome fit =
      Run({"fit", kDown, "--model", "poly:eq8", "-o", "promise.json"});
  EXPECT_THAT(fit.out, HasSubstr("90 % of the errors on an unseen cycle lie"));
  EXPECT_THAT(fit.out, HasSubstr("Found on 35 cycles (groups:5)"));
  const Json interval = Json::parse(Read("promise.json"))["interval"];
  EXPECT_EQ(interval["holdout"], "groups:5");
  EXPECT_EQ(interval["unit"], "cycle");
  EXPECT_EQ(interval["groups"], 35);
  EXPECT_EQ(interval["at_least"], Json::array());
  EXPECT_LT(interval["90"], interval["95"]);
  // The study of compare promises the same.
  ASSERT_EQ(
      Run({"compare", kDown, "--models", "poly:eq8", "--out", "study"}).status,
      0);
  EXPECT_EQ(Json::parse(Read("study/models/poly_eq8.json"))["interval"],
            interval);
  ASSERT_EQ(Run({"fit",
                 kDown,
                 "--model",
                 "poly:eq8",
                 "--no-interval",
                 "-o",
                 "none.json"})
                .status,
            0);
  EXPECT_EQ(Json::parse(Read("none.json"))["interval"], nullptr);
  const auto records = Records(Run({"predict", "none.json", kDown}).out);
  EXPECT_EQ(records[0].at("lower_90"), "");
  EXPECT_EQ(records[0].at("upper_95"), "");
}

class CliModelFile : public Cli {
 protected:
  std::string Refusal(const std::string& text) const {
    Write("bad.json", text);
    const std::string message =
        RefusalOf(Run({"predict", "bad.json", kDown}), kUnusable);
    EXPECT_THAT(message, HasSubstr("bad.json: "));
    EXPECT_EQ(RefusalOf(Run({"evaluate", "bad.json", kDown}), kUnusable),
              message);
    return message;
  }

  template <typename Change>
  std::string RefusalAfter(Json model, const Change& change) const {
    change(&model);
    model.erase("checksum");  // files of before have none
    return Refusal(model.dump());
  }
};

TEST_F(CliModelFile, BadPolynomialsAreRefusedByKey) {
  const Json m = Fit("poly:eq8", "m.json");
  EXPECT_THAT(
      RefusalAfter(m, [](Json* j) { (*j)["schema"] = "errmap-model-9"; }),
      AllOf(HasSubstr("key 'schema'"), HasSubstr("errmap-model-9")));
  EXPECT_THAT(RefusalAfter(m, [](Json* j) { j->erase("kind"); }),
              HasSubstr("has no key 'kind'"));
  EXPECT_THAT(RefusalAfter(m, [](Json* j) { (*j)["kind"] = "tree"; }),
              HasSubstr("key 'kind': unknown kind of model 'tree'"));
  EXPECT_THAT(
      RefusalAfter(m, [](Json* j) { (*j)["polynomial"].erase("terms"); }),
      HasSubstr("key 'polynomial': has no key 'terms'"));
  EXPECT_THAT(
      RefusalAfter(m,
                   [](Json* j) { (*j)["polynomial"]["intercept"] = nullptr; }),
      HasSubstr("key 'polynomial.intercept': must be a finite number"));
  EXPECT_THAT(RefusalAfter(m,
                           [](Json* j) {
                             (*j)["polynomial"]["terms"][1]["coefficient"] =
                                 nullptr;
                           }),
              HasSubstr("key 'polynomial.terms[1].coefficient'"));
  EXPECT_THAT(
      RefusalAfter(
          m, [](Json* j) { (*j)["polynomial"]["terms"][0]["powers"] = {1}; }),
      HasSubstr("key 'polynomial'"));
  EXPECT_THAT(
      RefusalAfter(m,
                   [](Json* j) { (*j)["polynomial"]["input_scale"] = {1.0}; }),
      HasSubstr("input_scale"));
  EXPECT_THAT(RefusalAfter(m, [](Json* j) { (*j)["inputs"].erase(1); }),
              HasSubstr("key 'inputs'"));
}

TEST_F(CliModelFile, BadNetsAreRefusedByKey) {
  const Json m = Fit("net:scg:iterations=5", "m.json");
  EXPECT_THAT(RefusalAfter(m, [](Json* j) { (*j)["net"]["w1"][3].erase(0); }),
              HasSubstr("key 'net.w1[3]'"));
  EXPECT_THAT(RefusalAfter(m, [](Json* j) { (*j)["net"]["w1"].erase(0); }),
              HasSubstr("key 'net"));
  EXPECT_THAT(
      RefusalAfter(m, [](Json* j) { (*j)["net"]["w2"][0][2] = nullptr; }),
      HasSubstr("key 'net.w2[0][2]': must be a finite number"));
  EXPECT_THAT(RefusalAfter(m, [](Json* j) { (*j)["net"]["output"] = "cubic"; }),
              HasSubstr("key 'net.output'"));
  EXPECT_THAT(RefusalAfter(m, [](Json* j) { (*j)["parameters"] = 7; }),
              HasSubstr("key 'parameters'"));
}

TEST_F(CliModelFile, BrokenJsonIsRefused) {
  const std::string text = Fit("poly:eq8", "m.json").dump();
  Refusal(text.substr(0, text.size() / 2));
  Refusal("");
  Refusal("[]");
  const std::string key = "\"intercept\":";
  const std::size_t at = text.find(key) + key.size();
  for (const std::string number : {"NaN", "1e999", "Infinity"}) {
    std::string bad = text;
    Refusal(bad.replace(at, text.find(',', at) - at, number));
  }
}

}  // namespace
}  // namespace errmap
