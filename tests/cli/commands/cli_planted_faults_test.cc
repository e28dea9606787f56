// Files as people have them, each with one fault planted, run as a new user
// would: each gives the right answer or one clear line.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
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
using ::testing::StartsWith;

// 120 rows of four warm-up days: five thermometers with noise of 0.02 degC and
// an error that is a plane in position and t1, but for 0.1 um.
class Measurements {
 public:
  Measurements() {
    header = {"cycle",
              "position_mm",
              "t1_degC",
              "t2_degC",
              "t3_degC",
              "t4_degC",
              "t5_degC",
              "error_mm"};
    std::mt19937_64 random(7);
    const auto noise = [&] {
      double sum = -6.0;
      for (int n = 0; n < 12; ++n) {
        sum += static_cast<double>(random() >> 11U) * 0x1p-53;
      }
      return sum;
    };
    for (int i = 0; i < 120; ++i) {
      const double hours = (i % 30) / 5.0;
      const double position = 25.0 * (i % 6);
      std::vector<double> row{1.0 + i / 6, position};
      for (int t = 1; t <= 5; ++t) {
        const double reading =
            20.0 + 0.2 * (i / 30) + t * (1.0 - std::exp(-hours / t));
        row.push_back(std::round(100.0 * (reading + 0.02 * noise())) / 100.0);
      }
      row.push_back(1e-5 * position + 2e-3 * row[2] + 1e-4 * noise());
      cells.emplace_back();
      for (const double value : row) cells.back().push_back(Text(value));
    }
  }

  static std::string Text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
  }

  /// Every value of a column through `change`.
  template <typename Edit>
  void Change(std::size_t column, const Edit& change) {
    for (auto& row : cells) row[column] = Text(change(std::stod(row[column])));
  }

  std::string Csv(char delimiter = ',') const {
    std::string text = Line(header, delimiter);
    for (const auto& row : cells) text += Line(row, delimiter);
    return text;
  }

  std::vector<std::string> header;
  std::vector<std::vector<std::string>> cells;

 private:
  static std::string Line(const std::vector<std::string>& fields,
                          char delimiter) {
    std::string line;
    for (const std::string& field : fields) {
      if (!line.empty()) line += delimiter;
      line += field;
    }
    return line + "\n";
  }
};

constexpr std::size_t kPosition = 1;
constexpr std::size_t kT1 = 2;
constexpr std::size_t kT3 = 4;
constexpr std::size_t kTarget = 7;

class CliPlantedFaults : public CliTest {
 protected:
  Outcome Compare(const std::string& text,
                  std::vector<std::string> more = {}) const {
    Write("d.csv", text);
    std::vector<std::string> words{"compare",
                                   "d.csv",
                                   "--models",
                                   "mean,poly:full:degree=1",
                                   "--holdout",
                                   "every:3",
                                   "--format",
                                   "json"};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }

  static Json Component(const Outcome& outcome) {
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    Json document = Json::parse(outcome.out, nullptr, false);
    return document.is_discarded() ? Json() : document["components"][0];
  }

  /// Held-out RMSE of the plane, in um.
  static double RmseUm(const Json& component) {
    double scale = kUmPerMm;
    if (component["data"]["unit"] == "um") scale = 1.0;
    for (const Json& model : component["models"]) {
      if (model["name"] != "poly:full:degree=1") continue;
      return scale * model["results"]["every:3"]["test"]["rmse"].get<double>();
    }
    ADD_FAILURE() << "no such model";
    return 0.0;
  }

  void FitMap(const std::string& text) const {
    Write("train.csv", text);
    const Outcome outcome = Run({"fit",
                                 "train.csv",
                                 "--model",
                                 "poly:full:degree=1",
                                 "-o",
                                 "m.json",
                                 "--quiet"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  const Measurements healthy_;
};

TEST_F(CliPlantedFaults, AHealthyFileGivesNoWarning) {
  const Outcome outcome = Compare(healthy_.Csv());
  EXPECT_EQ(outcome.err, "");
  const Json component = Component(outcome);
  EXPECT_NEAR(RmseUm(component), 0.1, 0.03);
  EXPECT_EQ(component["data"]["faults"], Json::array());
}

TEST_F(CliPlantedFaults, MicrometresHoweverWrittenGiveTheSameAnswer) {
  const double rmse = RmseUm(Component(Compare(healthy_.Csv())));
  for (const char* name : {"error [\u00b5m]",
                           "error (um)",
                           "error um",
                           "error_UM",
                           "error_microns"}) {
    Measurements um = healthy_;
    um.header[kTarget] = name;
    um.Change(kTarget, [](double mm) { return 1000.0 * mm; });
    const Json component = Component(Compare(um.Csv()));
    EXPECT_NEAR(RmseUm(component), rmse, 1e-4) << name;
    EXPECT_EQ(component["data"]["unit"], "um") << name;
  }
}

TEST_F(CliPlantedFaults, AnUnknownUnitIsRefusedWithOneThatWorks) {
  for (const std::string name :
       {"error [furlong] [um]", "error_furlong [um]", "error_m [m]"}) {
    Measurements file = healthy_;
    file.header[kTarget] = name.substr(0, name.rfind(' '));
    EXPECT_THAT(RefusalOf(Compare(file.Csv()), kUnusable), HasSubstr(name));
  }
  Measurements file = healthy_;
  file.header[kT1] = "t1 [brix]";
  EXPECT_THAT(
      Compare(file.Csv()).err,
      HasSubstr("errmap: no unit is read from 't1 [brix]': 'brix' is not a "
                "unit known here\n"));
  file.header[kT1] = "travel_m";
  EXPECT_THAT(Compare(file.Csv()).err,
              HasSubstr("errmap: no unit is read from 'travel_m': 'm' counts "
                        "as a unit in brackets or parentheses only\n"));
}

TEST_F(CliPlantedFaults, WithoutAUnitWhatIsAssumedIsSaid) {
  Measurements file = healthy_;
  file.header[kTarget] = "error";
  EXPECT_EQ(Compare(file.Csv()).err,
            "errmap: error: no unit in its name, taken as mm\n");
}

TEST_F(CliPlantedFaults, ATargetThatIsNoLengthIsNotToldInMicrometres) {
  Measurements file = healthy_;
  file.header[kTarget] = "error_NOx_mg_per_m3";
  const Json component = Component(Compare(file.Csv()));
  EXPECT_EQ(component["data"]["unit"], "mg/m3");
  Write("d.csv", file.Csv());
  EXPECT_THAT(Run({"compare", "d.csv", "--models", "mean"}).out,
              Not(HasSubstr(" um")));
}

TEST_F(CliPlantedFaults, SentinelsInTheTargetAreNamedAndCanBeLeftOut) {
  Measurements file = healthy_;
  file.cells[10][kTarget] = "9999";
  file.cells[77][kTarget] = "9999";
  const Outcome outcome = Compare(file.Csv());
  EXPECT_THAT(
      outcome.err,
      AllOf(HasSubstr("warning: error_mm 9999 mm in data rows 10, 77 is far "
                      "beyond all others"),
            HasSubstr("--faults drop-rows leaves these 2 rows out: a "
                      "linear map's error on the other rows is"),
            HasSubstr(" um RMSE with them, 0.")));
  const Json faults = Component(outcome)["data"]["faults"];
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0]["column"], "error_mm");
  EXPECT_EQ(faults[0]["rows"], Json::parse("[10,77]"));
  const Outcome dropped = Compare(file.Csv(), {"--faults", "drop-rows"});
  EXPECT_THAT(dropped.err,
              HasSubstr("errmap: 2 rows left out because of them\n"));
  const Json component = Component(dropped);
  EXPECT_EQ(component["data"]["rows"], 118);
  EXPECT_NEAR(RmseUm(component), 0.1, 0.03);
}

TEST_F(CliPlantedFaults, SpikesOfAThermometerAreNamed) {
  Measurements file = healthy_;
  file.cells[40][kT3] = "999.9";
  file.cells[63][kT3] = "0";
  EXPECT_THAT(Compare(file.Csv()).err,
              AllOf(HasSubstr("warning: t3_degC 999.9 degC in data row 40 is "
                              "beyond any thermometer"),
                    HasSubstr("warning: t3_degC jumps from "),
                    HasSubstr("to 0 degC and back in data row 63"),
                    HasSubstr("--faults drop-rows leaves these 2 rows out")));
  Write("study.toml",
        "models = [\"poly:full:degree=1\"]\nholdouts = [\"every:3\"]\n"
        "[[component]]\ndata = \"d.csv\"\nfaults = \"drop-rows\"\n");
  const Json component =
      Component(Run({"compare", "--config", "study.toml", "--format", "json"}));
  EXPECT_EQ(component["data"]["rows"], 118);
  EXPECT_NEAR(RmseUm(component), 0.1, 0.03);
}

TEST_F(CliPlantedFaults, AStuckThermometerIsNamedWithTheOptionForIt) {
  Measurements file = healthy_;
  for (std::size_t i = 30; i < 60; ++i) {
    file.cells[i][kT3] = file.cells[30][kT3];
  }
  EXPECT_THAT(Compare(file.Csv()).err,
              AllOf(HasSubstr("warning: t3_degC is stuck at "),
                    HasSubstr("from data row 30 to 59"),
                    HasSubstr("--exclude t3_degC leaves it out")));
}

TEST_F(CliPlantedFaults, KelvinUnderANameOfDegreesIsDoubted) {
  Measurements file = healthy_;
  file.Change(kT3, [](double t) { return t + 273.15; });
  EXPECT_THAT(Compare(file.Csv()).err,
              AllOf(HasSubstr("warning: t3_degC has 120 values that no "
                              "thermometer reads"),
                    HasSubstr("as if in K")));
}

TEST_F(CliPlantedFaults, ASensorWiredTwiceIsNamed) {
  Measurements file = healthy_;
  for (auto& row : file.cells) row[kT3] = row[kT1];
  const Outcome outcome = Compare(file.Csv());
  EXPECT_THAT(outcome.err,
              HasSubstr("input t3_degC repeats t1_degC value for value"));
  EXPECT_NEAR(RmseUm(Component(outcome)), 0.1, 0.03);
}

TEST_F(CliPlantedFaults, AnIndexColumnIsNoInput) {
  Measurements file = healthy_;
  for (std::size_t i = 0; i < file.cells.size(); ++i) {
    file.cells[i].insert(file.cells[i].begin(), std::to_string(i));
  }
  file.header.insert(file.header.begin(), "\"\"");
  const Outcome outcome = Compare(file.Csv());
  EXPECT_EQ(outcome.err,
            "errmap: column column_1 has no name in the header and is left "
            "out of the inputs\n");
  EXPECT_EQ(Component(outcome)["data"]["inputs"].size(), 6U);
  file.header.front() = "Unnamed: 0";
  EXPECT_THAT(Compare(file.Csv()).err, HasSubstr("is left out of the inputs"));
}

TEST_F(CliPlantedFaults, PositionsAsTextStopTheStudy) {
  const auto with_positions = [&](const auto& text_of) {
    Measurements file = healthy_;
    for (auto& row : file.cells) row[kPosition] = text_of(row[kPosition]);
    return file;
  };
  EXPECT_EQ(Compare(with_positions([](const std::string& text) {
                      return text + " mm";
                    }).Csv())
                .status,
            0);  // one unit in all cells is the column's
  EXPECT_THAT(RefusalOf(Compare(with_positions([](const std::string& text) {
                                  return "1." + text + "00,5";
                                }).Csv(';')),
                        kUnusable),
              HasSubstr("column 'position_mm'"));
  EXPECT_THAT(RefusalOf(Compare(with_positions([](const std::string& text) {
                                  return "\"1," + text + "00.5\"";
                                }).Csv()),
                        kUnusable),
              HasSubstr("column 'position_mm': "));
  EXPECT_THAT(RefusalOf(Compare(with_positions([](const std::string&) {
                                  return "left";
                                }).Csv()),
                        kUnusable),
              HasSubstr("column 'position_mm': 'left' is not a number"));
}

TEST_F(CliPlantedFaults, APositionInAnyCaseIsThePosition) {
  Measurements file = healthy_;
  file.header[kPosition] = "Position [mm]";
  Write("d.csv", file.Csv());
  EXPECT_EQ(
      Run({"fit", "d.csv", "--model", "poly:position", "-o", "m.json"}).status,
      0);
  EXPECT_THAT(Read("m.json"), HasSubstr("Position [mm]"));
}

TEST_F(CliPlantedFaults, GermanDecimalsGiveTheSameAnswer) {
  std::string german = healthy_.Csv(';');
  std::replace(german.begin(), german.end(), '.', ',');
  const Outcome outcome = Compare(german);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(RmseUm(Component(outcome)),
            RmseUm(Component(Compare(healthy_.Csv()))));
}

TEST_F(CliPlantedFaults, UnitsOfMapAndDataAreConverted) {
  FitMap(healthy_.Csv());
  const Json same =
      RunJson({"evaluate", "m.json", "train.csv", "--format", "json"});
  Measurements other = healthy_;
  other.header[kPosition] = "Position [m]";
  other.Change(kPosition, [](double mm) { return mm / 1000.0; });
  other.header[kT1] = "T1 (K)";
  other.Change(kT1, [](double t) { return t + 273.15; });
  other.header[kTarget] = "error_um";
  other.Change(kTarget, [](double mm) { return 1000.0 * mm; });
  Write("other.csv", other.Csv());
  const Outcome outcome =
      Run({"evaluate", "m.json", "other.csv", "--format", "json"});
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("errmap: position_mm is read from 'Position [m]' "
                              "and converted from m to mm\n"),
                    HasSubstr("errmap: t1_degC is read from 'T1 (K)' and "
                              "converted from K to degC\n"),
                    HasSubstr("errmap: error_mm is read from 'error_um' and "
                              "converted from um to mm\n")));
  const Json converted = Json::parse(outcome.out);
  EXPECT_EQ(converted["unit"], "mm");
  EXPECT_NEAR(converted["summary"]["rmse"].get<double>(),
              same["summary"]["rmse"].get<double>(),
              1e-9);
  const Outcome predicted = Run({"predict", "m.json", "other.csv"});
  EXPECT_EQ(predicted.status, 0);
  EXPECT_THAT(predicted.err, HasSubstr("converted from K to degC"));
  EXPECT_THAT(predicted.err, Not(HasSubstr("warning")));
}

TEST_F(CliPlantedFaults, UnitsThatCannotBeConvertedAreRefused) {
  FitMap(healthy_.Csv());
  Measurements other = healthy_;
  other.header[kT1] = "t1_bar";
  Write("other.csv", other.Csv());
  for (const char* command : {"predict", "evaluate"}) {
    EXPECT_THAT(RefusalOf(Run({command, "m.json", "other.csv"}), kUnusable),
                HasSubstr("column 't1_bar' is in bar, the map's 't1_degC' in "
                          "degC"));
  }
}

TEST_F(CliPlantedFaults, InputsFarFromTheTrainedRangeAreNamed) {
  FitMap(healthy_.Csv());
  Measurements other = healthy_;
  other.Change(kT1, [](double t) { return t + 273.15; });
  Write("other.csv", other.Csv());
  for (const char* command : {"predict", "evaluate"}) {
    const Outcome outcome = Run({command, "m.json", "other.csv"});
    EXPECT_EQ(outcome.status, 0) << command;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("warning: t1_degC is 293.17 to 294.78 degC, "
                                "trained 20.02 to 21.63: 120 rows outside; "
                                "as if in K"),
                      Not(HasSubstr("unlike those in training"))))
        << command;
    // Once.
    EXPECT_EQ(outcome.err.find("clipped") == std::string::npos,
              std::string(command) == "evaluate");
  }
  const Json document =
      RunJson({"evaluate", "m.json", "other.csv", "--format", "json"});
  EXPECT_EQ(document["outside"]["rows"], 120);
  EXPECT_EQ(document["outside"]["inputs"][0]["looks_like"], "K");
}

TEST_F(CliPlantedFaults, PredictionsThatAreNotFiniteAreCountedAndFail) {
  FitMap(healthy_.Csv());
  Measurements other = healthy_;
  Json map = Json::parse(Read("m.json"));
  map["polynomial"]["terms"][0]["coefficient"] = 1e308;
  map["polynomial"]["input_scale"][0] = 1e10;
  map["guards"] = nullptr;  // they would hold it within the trained errors
  WriteMapFile("m.json", map);
  Write("other.csv", other.Csv());
  const Outcome predicted = Run({"predict", "m.json", "other.csv", "--quiet"});
  EXPECT_EQ(predicted.status, kEveryFitFailed);
  EXPECT_THAT(predicted.err,
              AllOf(StartsWith("errmap: other.csv: "),
                    HasSubstr("of 120 predictions not finite, the first in "
                              "data row ")));
  EXPECT_THAT(predicted.out, Not(HasSubstr("inf")));
  EXPECT_THAT(predicted.out, HasSubstr(",,,,,,0,not finite,"));
  const Outcome judged = Run({"evaluate", "m.json", "other.csv", "--quiet"});
  EXPECT_EQ(judged.out, "");
  EXPECT_THAT(RefusalOf(judged, kEveryFitFailed), HasSubstr("not finite"));
  // Finite, but nothing that is said of it would be.
  map["polynomial"]["input_scale"][0] = 1e-2;
  WriteMapFile("m.json", map);
  const Outcome large = Run({"evaluate", "m.json", "other.csv", "--quiet"});
  EXPECT_EQ(large.out, "");
  EXPECT_THAT(RefusalOf(large, kEveryFitFailed),
              HasSubstr("too large to be squared"));
}

}  // namespace
}  // namespace errmap
