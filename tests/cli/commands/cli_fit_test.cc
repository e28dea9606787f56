// What `errmap fit` prints of a regression.
#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::HasSubstr;

class CliFit : public Cli {
 protected:
  std::string Print(const std::string& model,
                    const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{
        "fit", kDown, "--model", model, "-o", "m.json"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = Run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  }
};

TEST_F(CliFit, PrintsWhatAStatisticianExpects) {
  const std::string text =
      OneLine(Print("poly:stepwise:degree=4", {"--correlations", "--details"}));
  for (const char* part : {"chosen by forward BIC",
                           "correlation",
                           "Steps (+ entered, - left, * chosen)",
                           "+ position_mm*elapsed_cycles^2",
                           "AIC = n ln(RSS/n) + 2k",
                           "std. error",
                           "95 % from",
                           "standardised",
                           "VIF",
                           "chosen in",
                           "position_mm + 114.3, elapsed_cycles - 17",
                           "Analysis of variance",
                           "adjusted R2 0.991075",
                           "Predicted R2 0.990800",
                           "terms taken as given",
                           "Largest residual 1.439 um (row 60)",
                           "Condition number",
                           "effective rank 9 of 9",
                           "F if it entered",
                           "position_mm*elapsed_cycles^3",
                           "are optimistic",
                           "200 bootstrap repetitions (each cycle"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST_F(CliFit, TimesAllThatTheFitDoes) {
  const auto fit = [&](const std::string& model) {
    return RunJson({"fit",
                    kDown,
                    "--model",
                    model,
                    "-o",
                    "m.json",
                    "--no-interval",
                    "--format",
                    "json"});
  };
  // A regression has no iterations to be timed; a net's tuning is not in those
  // of its last fit.
  EXPECT_GT(fit("poly:eq8").at("fit_seconds"), 0.0);
  const Json tuned = fit("net:scg:wfactor=cv");
  const double last = tuned.at("iterations").get<double>() *
                      tuned.at("mean_iteration_seconds").get<double>();
  EXPECT_GT(tuned.at("fit_seconds"), last);
}

TEST_F(CliFit, GivesTheSameAsJson) {
  const Json json = RunJson({"fit",
                             kDown,
                             "--model",
                             "poly:stepwise:degree=4:criterion=aic:direction="
                             "both:bootstrap=10",
                             "-o",
                             "m.json",
                             "--correlations",
                             "--format",
                             "json"});
  const Json& regression = json["regression"];
  // R 4.2.2, step(): tests/golden/stepwise/shipped.json, "both AIC".
  const Json& last = regression["steps"].back();
  EXPECT_NEAR(last["aic"].get<double>(), -5948.752357795844, 1e-8);
  EXPECT_EQ(regression["coefficients"].size(), 10U);
  EXPECT_EQ(regression["excluded"].size(), 5U);
  EXPECT_EQ(regression["bootstrap"]["repetitions"], 10);
  EXPECT_EQ(json["correlations"]["columns"].size(), 3U);
  EXPECT_EQ(json["correlations"]["matrix"][2][2], 1.0);
  EXPECT_EQ(json["parameters"], 10);
}

TEST_F(CliFit, ShrunkenFitsShowNoPValues) {
  const std::string text = OneLine(Print("poly:ridge"));
  EXPECT_THAT(text, HasSubstr("by cross-validation over groups:5 of cycle"));
  EXPECT_THAT(text, HasSubstr("no valid standard errors or p-values"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("std. error")));
}

// The printed equation alone, read by a calculator, gives the predictions.
TEST_F(CliFit, TheEquationHasEnoughDigits) {
  const Json json = RunJson({"fit",
                             kDown,
                             "--model",
                             "poly:full:degree=6",
                             "-o",
                             "m.json",
                             "--format",
                             "json"});
  std::string equation = json["equation"];
  equation = equation.substr(equation.find('=') + 1);
  const auto value_at = [&](double x, double c) {
    double sum = 0.0;
    double sign = 1.0;
    std::istringstream stream(equation);
    for (std::string word; stream >> word;) {
      if (word == "+" || word == "-") {
        sign = word == "+" ? 1.0 : -1.0;
        continue;
      }
      std::size_t used = 0;
      double term = std::stod(word, &used);
      std::istringstream factors(word.substr(used));
      for (std::string factor; std::getline(factors, factor, '*');) {
        if (factor.empty()) continue;
        const std::size_t caret = factor.find('^');
        const double base = factor.starts_with("position") ? x : c;
        term *= std::pow(base,
                         caret == std::string::npos
                             ? 1
                             : std::stoi(factor.substr(caret + 1)));
      }
      sum += sign * term;
    }
    return sum;
  };
  Write("p.csv", "position_mm,elapsed_cycles\n-215.9,34\n-12.7,0\n-100,20\n");
  const auto records = Records(Run({"predict", "m.json", "p.csv"}).out);
  ASSERT_EQ(records.size(), 3U);
  constexpr double kNanometre = 1e-6;  // mm
  EXPECT_NEAR(value_at(-215.9, 34.0),
              std::stod(records[0].at("predicted")),
              kNanometre);
  EXPECT_NEAR(
      value_at(-12.7, 0.0), std::stod(records[1].at("predicted")), kNanometre);
  EXPECT_NEAR(value_at(-100.0, 20.0),
              std::stod(records[2].at("predicted")),
              kNanometre);
}

TEST_F(CliFit, WeightsEnterAndTemperaturesNeedNoPosition) {
  std::string table = "t1,t2,weight,error_mm\n";
  for (int i = 0; i < 40; ++i) {
    table += std::to_string(20 + (i * 7) % 11) + "," +
             std::to_string(22 + (i * 5) % 13) + "," +
             std::to_string(1 + i % 3) + "," +
             std::to_string(0.001 * ((i * 7) % 11) + 1e-4 * (i % 4)) + "\n";
  }
  Write("drift.csv", table);
  const Outcome outcome = Run({"fit",
                               "drift.csv",
                               "--weight",
                               "weight",
                               "--model",
                               "poly:stepwise:degree=1",
                               "-o",
                               "m.json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Analysis of variance (weighted)"));
  EXPECT_THAT(OneLine(outcome.out), HasSubstr("(each row drawn"));
}

TEST_F(CliFit, RefusesBadSpecsInOneClearLine) {
  const auto refusal = [&](const std::string& model, int status) {
    const Outcome outcome =
        Run({"fit", kDown, "--model", model, "-o", "m.json", "--quiet"});
    EXPECT_EQ(outcome.status, status) << model;
    EXPECT_EQ(SplitLines(outcome.err).size(), 1U) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(refusal("poly:formula=position_mm+", kWrongCommandLine),
              HasSubstr("position 13"));
  EXPECT_THAT(refusal("poly:stepwise:degree=0", kWrongCommandLine),
              HasSubstr("degree must be"));
  EXPECT_THAT(refusal("poly:stepwise:criterion=p:enter=2", kWrongCommandLine),
              HasSubstr("enter must be a number from 0 to 1"));
  EXPECT_THAT(refusal("poly:stepwise:include=t9", kEveryFitFailed),
              HasSubstr("'t9' is not an input; there are position_mm"));
}

TEST_F(CliFit, ShowsEveryStartAndTheirSpread) {
  const std::string model = "net:scg:starts=3:iterations=5";
  const std::string text = Print(model);
  for (const char* part : {"3 starts, * chosen: lowest cost",
                           "held-out RMSE",
                           "iteration_limit",
                           "costs from "}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  const Json json = RunJson(
      {"fit", kDown, "--model", model, "-o", "m.json", "--format", "json"});
  const Json& table = json.at("starts").at("table");
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(table[0].at("seed"), 1);
  EXPECT_EQ(table[0].at("stop"), "iteration_limit");
  double least = table[0].at("final_cost");
  for (const Json& start : table) {
    least = std::min(least, start.at("final_cost").get<double>());
    EXPECT_GT(start.at("holdout_rmse").get<double>(), 0.0);
  }
  EXPECT_EQ(json.at("starts").at("spread").at("min"), least);
  EXPECT_EQ(json.at("final_cost"), least);
}

TEST_F(CliFit, ShowsTheWfactorThatDiscrepancyFound) {
  const Json json = RunJson({"fit",
                             kDown,
                             "--model",
                             "net:scg:discrepancy=0.001:iterations=300",
                             "-o",
                             "m.json",
                             "--format",
                             "json"});
  EXPECT_GT(json.at("choices").at("wfactor").get<double>(), 0.0);
  EXPECT_EQ(json.at("choices").at("discrepancy_reached"), "yes");
  EXPECT_LE(json.at("train").at("rmse").get<double>(), 0.001 * (1.0 + 1e-9));
}

}  // namespace
}  // namespace errmap
