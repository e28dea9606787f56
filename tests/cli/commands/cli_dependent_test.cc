// Sensors that repeat each other and positions too few for a degree, through
// the program: sane numbers, and every output tells the same.

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::HasSubstr;

class CliDependent : public Cli {
 protected:
  // The shipped measurement with a column more, made from a record.
  template <typename MakeCell>
  void WriteWith(const std::string& file,
                 const std::string& name,
                 const MakeCell& make_cell) const {
    std::string text;
    std::string header;
    for (const std::string& line : SplitLines(Slurp(kDown))) {
      if (line.starts_with('#')) continue;
      if (header.empty()) {
        header = line;
        text = name + "," + line + "\n";
        continue;
      }
      const auto record = Records(header + "\n" + line + "\n").front();
      text += make_cell(record) + "," + line + "\n";
    }
    // The added column last: of copies the later one is left out.
    std::string moved;
    for (const std::string& line : SplitLines(text)) {
      const std::size_t comma = line.find(',');
      moved += line.substr(comma + 1) + "," + line.substr(0, comma) + "\n";
    }
    Write(file, moved);
  }

  static std::string Slurp(const std::string& path) {
    std::ifstream stream(path);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  static std::string Kelvin(const std::map<std::string, std::string>& record) {
    return std::to_string(std::stod(record.at("elapsed_cycles")) + 273.15);
  }

  Json FitTo(const std::string& file, const std::string& model) const {
    return RunJson(
        {"fit", file, "--model", model, "-o", "map.json", "--format", "json"});
  }
};

// 0.938 um is the cubic's figure on whole cycles; it was 1.6e14 um.
TEST_F(CliDependent, ASensorWiredTwiceChangesNoFigure) {
  WriteWith("twice.csv", "t2_degC", [](const auto& record) {
    return record.at("elapsed_cycles");
  });
  WriteWith("kelvin.csv", "t2_K", Kelvin);
  const auto rmse = [&](const std::string& file) {
    const Json document = RunJson({"compare",
                                   file,
                                   "--models",
                                   "poly:full:degree=3,poly:full:degree=5",
                                   "--holdout",
                                   "groups:5",
                                   "--quiet",
                                   "--format",
                                   "json"});
    std::vector<double> figures;
    for (const char* model : {"poly:full:degree=3", "poly:full:degree=5"}) {
      const Json result = Model(document["components"][0], model);
      figures.push_back(
          result["results"]["groups:5"]["test"]["rmse"].get<double>());
    }
    return figures;
  };
  const std::vector<double> alone = rmse(kDown);
  EXPECT_NEAR(kUmPerMm * alone[0], 0.938, 5e-4);
  for (const char* file : {"twice.csv", "kelvin.csv"}) {
    const std::vector<double> doubled = rmse(file);
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_NEAR(doubled[i], alone[i], 1e-9 * alone[i]) << file;
    }
  }
}

TEST_F(CliDependent, FitNamesTheCopyAndItsTableIsTheMaps) {
  WriteWith("kelvin.csv", "t2_K", Kelvin);
  const Json alone = FitTo(kDown, "poly:full:degree=3");
  const Json fitted = FitTo("kelvin.csv", "poly:full:degree=3");
  const double rmse = fitted["train"]["rmse"];
  EXPECT_NEAR(rmse, alone["train"]["rmse"].get<double>(), 1e-9 * rmse);
  EXPECT_EQ(fitted["parameters"], alone["parameters"]);
  const Json& regression = fitted["regression"];
  EXPECT_NEAR(regression["anova"]["residual_ss"].get<double>(),
              rmse * rmse * 397.0,
              1e-9 * rmse * rmse * 397.0);
  ASSERT_EQ(regression["aliased"].size(), 10U);
  EXPECT_EQ(regression["aliased"][0]["term"], "t2_K");
  EXPECT_EQ(regression["aliased"][0]["why"], "repeats elapsed_cycles");
  EXPECT_THAT(fitted["remarks"][0].get<std::string>(),
              HasSubstr("10 of 19 terms follow from the others"));
  // Every figure of a term that stays is that of the fit without the copy.
  for (const Json& term : alone["regression"]["coefficients"]) {
    bool found = false;
    for (const Json& other : regression["coefficients"]) {
      if (other["term"] != term["term"]) continue;
      found = true;
      const double estimate = term["estimate"];
      EXPECT_NEAR(
          other["estimate"].get<double>(), estimate, 1e-9 * std::abs(estimate));
    }
    EXPECT_TRUE(found) << term;
  }
  const Outcome text =
      Run({"fit", "kelvin.csv", "--model", "poly:full:degree=3", "-o", "m"});
  EXPECT_THAT(text.out, HasSubstr("Aliased terms (10)"));
  EXPECT_THAT(text.out,
              ::testing::ContainsRegex("t2_K +repeats elapsed_cycles"));
}

TEST_F(CliDependent, FivePositionsUnderAHighDegreeStaySane) {
  std::string text = "position_mm,t1_degC,cycle,error_mm\n";
  for (int i = 0; i < 200; ++i) {
    const double x = 100.0 * (i % 5);
    const double t = 20.0 + 0.02 * i + 0.3 * std::sin(0.7 * i);
    text += std::to_string(x) + "," + std::to_string(t) + "," +
            std::to_string(i / 20) + "," +
            std::to_string(0.002 * std::sin(0.01 * x) + 1e-4 * t) + "\n";
  }
  Write("five.csv", text);
  const Json document = RunJson({"compare",
                                 "five.csv",
                                 "--models",
                                 "poly:full:degree=4,poly:full:degree=5,"
                                 "poly:full:degree=6",
                                 "--holdout",
                                 "every:3",
                                 "--format",
                                 "json",
                                 "--quiet"});
  int judged = 0;
  for (const Json& model : document["components"][0]["models"]) {
    if (!model["name"].get<std::string>().starts_with("poly:full")) continue;
    const double rmse = model["results"]["every:3"]["test"]["rmse"];
    EXPECT_LT(rmse, 1e-6) << model["name"];  // mm, the rounding of the file
    ++judged;
  }
  EXPECT_EQ(judged, 3);
  const Json fitted = FitTo("five.csv", "poly:full:degree=6");
  const double rmse = fitted["train"]["rmse"];
  EXPECT_NEAR(fitted["regression"]["anova"]["residual_ss"].get<double>(),
              rmse * rmse * 200.0,
              1e-9 * rmse * rmse * 200.0);
  EXPECT_EQ(fitted["regression"]["aliased"][0]["term"], "position_mm^5");
}

TEST_F(CliDependent, SaysThatTheConditionIsLarge) {
  std::string text = "x,error_mm\n";
  for (int i = 0; i < 40; ++i) {
    const double x = 1000.0 + 0.25 * i;
    text += std::to_string(x) + "," + std::to_string(std::sin(x)) + "\n";
  }
  Write("far.csv", text);
  const Outcome raw = Run({"fit",
                           "far.csv",
                           "--model",
                           "poly:formula=x+x^2+x^3:centred=no",
                           "-o",
                           "m.json"});
  EXPECT_EQ(raw.status, 0) << raw.err;
  EXPECT_THAT(OneLine(raw.out),
              HasSubstr("condition number 4.8e+08: single "
                        "coefficients follow the last digits"));
  const Outcome centred = Run(
      {"fit", "far.csv", "--model", "poly:formula=x+x^2+x^3", "-o", "m.json"});
  EXPECT_THAT(centred.out, ::testing::Not(HasSubstr("single coefficients")));
}

}  // namespace
}  // namespace errmap
