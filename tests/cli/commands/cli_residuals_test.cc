// errmap residuals, and the blocks that results.json shares with it.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/distributions.h"
#include "tests/cli/cli_fixture.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class CliResiduals : public Cli {
 protected:
  static std::vector<std::string> AppendixBWith(
      const std::vector<std::string>& more) {
    std::vector<std::string> words{
        "residuals", kAppendixB, "--column", "residual_mm"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  Json AppendixBJson(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = AppendixBWith(more);
    words.insert(words.end(), {"--format", "json"});
    return RunJson(words);
  }

  /// Text and JSON of a file with the one column r.
  std::string TextOf(const std::vector<std::string>& values) const {
    std::string text = "r\n";
    for (const std::string& value : values) text += value + "\n";
    Write("r.csv", text);
    const Outcome outcome = Run({"residuals", "r.csv", "--column", "r"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const Outcome json = Run({"residuals",
                              "r.csv",
                              "--column",
                              "r",
                              "--format",
                              "json",
                              "--monte-carlo",
                              "50"});
    EXPECT_EQ(json.status, 0) << json.err;
    EXPECT_THAT(json.out, Not(HasSubstr(": nan")));
    return outcome.out;
  }
};

// The report saw p 0.0026, "not normal"; see tests/golden/normality.json and
// tests/golden/normality/serial_reference.csv for the figures.
TEST_F(CliResiduals, OneScreenSaysWhatTheReportSawAndWhatIsThere) {
  const Outcome outcome = Run(AppendixBWith({}));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(OneLine(outcome.out),
              AllOf(HasSubstr("So it calls them not normal"),
                    HasSubstr("K-S D 0.0915, not 0.0380"),
                    HasSubstr("the wrong divisors changed the verdict"),
                    HasSubstr("The shape is close to normal"),
                    HasSubstr("They are not independent"),
                    HasSubstr("mean depends on cycle, which explains 48 %")));
  const std::vector<std::string> lines = SplitLines(outcome.out);
  EXPECT_LE(lines.size(), 50U);
  for (std::size_t i = 1; i < lines.size(); ++i) {  // the first has the path
    EXPECT_LE(lines[i].size(), 80U) << lines[i];
  }
}

// Normal but for two outliers: the slip changes what Eq. 140 says of D, but it
// did not decide on the shape, which other tests reject.
TEST_F(CliResiduals, BlamesTheSlipOnlyWhereNoTestRejects) {
  std::vector<std::string> values{"-6", "6"};
  for (int i = 0; i < 1000; ++i) {
    values.push_back(std::to_string(stats::NormalQuantile((i + 0.5) / 1000.0)));
  }
  std::string text = TextOf(values);
  std::ranges::replace(text, '\n', ' ');
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("So it calls them not normal"),
            HasSubstr("by Lilliefors' test, but other tests reject at 1 %."),
            Not(HasSubstr("the wrong divisors changed the verdict"))));
}

// With the right divisors Eq. 140 says the same, so they are not to blame.
TEST_F(CliResiduals, BlamesTheGivenMeanAndSdWhereTheDivisorsChangeNothing) {
  std::vector<std::string> values;
  for (int i = 0; i < 25; ++i) {
    values.push_back(std::to_string(std::pow((i + 0.5) / 25.0, 3.0) - 0.2495));
  }
  std::string text = TextOf(values);
  std::ranges::replace(text, '\n', ' ');
  EXPECT_THAT(text,
              AllOf(HasSubstr("So it calls them normal, as it would with the "
                              "right divisors (p 0.3"),
                    HasSubstr("Lilliefors' test allows for their estimate"),
                    Not(HasSubstr("the wrong divisors changed the verdict"))));
}

TEST_F(CliResiduals, JsonHasEveryStatistic) {
  const Json json = AppendixBJson();
  const Json& normality = json["normality"];
  const auto near = [](const Json& value, double expected, double tolerance) {
    EXPECT_NEAR(value.get<double>(), expected, tolerance);
  };
  near(normality["ks"]["d"], 0.038008178957, 1e-11);
  near(normality["ks"]["p_given"], 0.6148791466, 1e-9);
  near(normality["ks"]["p_given_exact"], 0.6011511088032951, 1e-12);
  near(normality["lilliefors"]["p"], 0.182, 0.005);
  near(normality["shapiro_wilk"]["w"], 0.9919930077, 1e-7);
  near(normality["anderson_darling"]["a2"], 0.5307651391, 1e-9);
  near(normality["jarque_bera"]["jb"], 4.0320756785, 1e-9);
  near(normality["ppcc"]["r_normal"], 0.9960158206, 1e-9);
  near(normality["ppcc"]["lambda"], 0.0588706, 1e-6);
  EXPECT_GT(normality["ppcc"]["r_max"], normality["ppcc"]["r_normal"]);
  const Json& randomness = json["randomness"];
  EXPECT_EQ(randomness["order"], "file order");
  near(randomness["in_order"]["lag1"]["r"], 0.4642679996, 1e-9);
  EXPECT_EQ(randomness["in_order"]["runs"]["runs"], 127);
  EXPECT_EQ(randomness["within_groups"]["runs"]["runs"], 145);
  EXPECT_EQ(randomness["by_group"]["levels"].size(), 35U);
  EXPECT_EQ(randomness["by_position"]["levels"].size(), 17U);
  EXPECT_EQ(randomness["breusch_pagan"]["column"], "predicted_mm");
  EXPECT_EQ(json["plots"]["tukey_ppcc"]["lambda"].size(), 81U);
  EXPECT_EQ(json["plots"]["normal_probability_plot"]["value"].size(), 397U);
  EXPECT_EQ(json["plots"]["histogram"]["counts"].size(), 17U);
  EXPECT_EQ(
      AppendixBJson({"--bins", "5"})["plots"]["histogram"]["counts"].size(),
      5U);
}

TEST_F(CliResiduals, RowOrderChangesOnlyTheRandomness) {
  const Json as_measured = AppendixBJson();
  const Json by_position = AppendixBJson({"--order", "position_mm"});
  EXPECT_EQ(by_position["randomness"]["order"], "order of position_mm");
  EXPECT_EQ(by_position["normality"], as_measured["normality"]);
  EXPECT_EQ(by_position["randomness"]["by_group"]["f"].get<double>() -
                    as_measured["randomness"]["by_group"]["f"].get<double>() <
                1e-9,
            true);
  EXPECT_NE(by_position["randomness"]["in_order"],
            as_measured["randomness"]["in_order"]);
}

TEST_F(CliResiduals, OptionsNameOtherColumns) {
  const Json json = AppendixBJson({"--group",
                                   "position_mm",
                                   "--position",
                                   "cycle",
                                   "--fitted",
                                   "measured_mm"});
  EXPECT_EQ(json["randomness"]["by_group"]["levels"].size(), 17U);
  EXPECT_EQ(json["randomness"]["by_position"]["levels"].size(), 35U);
  EXPECT_EQ(json["randomness"]["breusch_pagan"]["column"], "measured_mm");
  for (const char* option : {"--order", "--group", "--position", "--fitted"}) {
    EXPECT_THAT(RefusalOf(Run(AppendixBWith({option, "t9"})), kUnusable),
                AllOf(HasSubstr("no column 't9'"), HasSubstr(option)));
  }
  EXPECT_THAT(
      RefusalOf(Run(AppendixBWith({"--monte-carlo", "-1"})), kWrongCommandLine),
      HasSubstr("--monte-carlo"));
}

TEST_F(CliResiduals, MonteCarloIsSeeded) {
  const auto p = [&](const char* seed) {
    return AppendixBJson({"--monte-carlo", "200", "--seed", seed});
  };
  const Json one = p("1");
  EXPECT_EQ(one["normality"]["monte_carlo"]["draws"], 200);
  EXPECT_EQ(one["randomness"]["in_order"]["shuffled"]["draws"], 200);
  EXPECT_EQ(one, p("1"));
  EXPECT_NE(one["normality"]["monte_carlo"],
            p("2")["normality"]["monte_carlo"]);
  EXPECT_THAT(Run(AppendixBWith({"--monte-carlo", "200"})).out,
              HasSubstr("by Monte Carlo"));
}

TEST_F(CliResiduals, DetailsShowBiasesHistogramAndCurve) {
  EXPECT_THAT(Run(AppendixBWith({"--details", "--bins", "4"})).out,
              AllOf(HasSubstr("histogram, 4 bins"),
                    HasSubstr("position_mm "),
                    HasSubstr("Tukey lambda")));
}

TEST_F(CliResiduals, FewOrEqualValuesAreAnsweredOrRefusedNeverNaN) {
  EXPECT_THAT(TextOf({"1"}), HasSubstr("needs at least 2 values, found 1"));
  EXPECT_THAT(TextOf({"1", "2"}),
              HasSubstr("needs at least 4 values, found 2"));
  EXPECT_THAT(TextOf({"1", "2", "4"}),
              HasSubstr("needs at least 4 values, found 3"));
  // "p < 1e-300" of three readings would be no finding.
  EXPECT_THAT(TextOf({"100", "101", "100"}),
              AllOf(HasSubstr("3 values are too few for any test of shape."),
                    Not(HasSubstr("1e-300"))));
  EXPECT_THAT(TextOf({"1", "2", "4", "8"}), HasSubstr("Shapiro-Wilk"));
  EXPECT_THAT(TextOf({"3", "3", "3", "3", "3"}),
              HasSubstr("the values do not vary"));
  for (const std::vector<std::string>& values :
       std::vector<std::vector<std::string>>{
           {"1"},
           {"1", "2"},
           {"1", "2", "4"},
           {"3", "3", "3", "3", "3"},
           {"0", "0", "0", "1e-300"},
           {"1e308", "-1e308", "1e308", "0"}}) {
    EXPECT_THAT(TextOf(values), Not(HasSubstr(": nan")));
  }
  Write("r.csv", "r\n1\ninf\n");
  EXPECT_THAT(
      RefusalOf(Run({"residuals", "r.csv", "--column", "r"}), kUnusable),
      HasSubstr("r.csv: line 3 (data row 1), column 'r'"));
}

// An instrument of 1 um on a scatter of 1 um: ties are not modes.
TEST_F(CliResiduals, RoundedReadingsAreComparedWithRoundedNormals) {
  std::vector<std::string> values;
  for (int i = 0; i < 400; ++i) {
    const double z = stats::NormalQuantile((0.5 + (i * 37) % 400) / 400.0);
    values.push_back(std::to_string(std::lround(z)));
  }
  std::string text = TextOf(values);
  std::ranges::replace(text, '\n', ' ');
  EXPECT_THAT(text,
              AllOf(HasSubstr("The values come in steps of 1"),
                    HasSubstr("consistent with a normal distribution"),
                    HasSubstr("for values without steps"),
                    Not(HasSubstr("more than one mode")),
                    Not(HasSubstr("not normal"))));
  const Json json =
      RunJson({"residuals", "r.csv", "--column", "r", "--format", "json"});
  EXPECT_NEAR(json["normality"]["step"].get<double>(), 1.0, 1e-9);
}

// Durbin and Watson's p is 0.006 here, all others are above 2 %.
TEST_F(CliResiduals, SaysThatNoMemoryShowsOnlyWhereNoTestShowsOne) {
  std::string text = TextOf({"21",
                             "13",
                             "-32",
                             "-28",
                             "-3",
                             "34",
                             "28",
                             "1",
                             "-35",
                             "-44",
                             "-6",
                             "2",
                             "50",
                             "132"});
  std::ranges::replace(text, '\n', ' ');
  EXPECT_THAT(text,
              AllOf(HasSubstr("They are not independent"),
                    HasSubstr("Tests that reject at 1 %: Durbin-Watson."),
                    Not(HasSubstr("The order shows no autocorrelation"))));
}

TEST_F(CliResiduals, DroppedRowsAreDroppedFromEveryColumn) {
  Write("r.csv",
        "r,cycle,position,predicted\n1,1,10,1\n,1,20,2\n3,1,,3\n4,2,10,4\n"
        "6,2,20,5\n9,2,10,6\n");
  const Json json = RunJson({"residuals",
                             "r.csv",
                             "--column",
                             "r",
                             "--missing",
                             "drop-rows",
                             "--format",
                             "json"});
  EXPECT_EQ(json["summary"]["n"], 4);
  EXPECT_EQ(json["randomness"]["by_group"]["levels"][0]["n"], 1);
}

TEST_F(CliResiduals, AColumnFoundByItselfThatIsOfNoUseIsLeftOut) {
  Write("r.csv", "r,position\n1,a\n2,b\n3,c\n5,d\n");
  const Outcome outcome = Run({"residuals", "r.csv", "--column", "r"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("position: left out"));
  EXPECT_THAT(RefusalOf(Run({"residuals",
                             "r.csv",
                             "--column",
                             "r",
                             "--position",
                             "position"}),
                        kUnusable),
              HasSubstr("position"));
}

// Held-out residuals, in the file's order, judged as `residuals` judges them.
TEST_F(CliResiduals, ResultsJsonHasTheSameBlocksForEveryModelAndHoldout) {
  const Json component =
      Compare({"--models", "mean,poly:eq8", "--out", "study"});
  for (const Json& model : component["models"]) {
    for (const char* holdout : {"every:3", "groups:5"}) {
      const Json& result = model["results"][holdout];
      for (const char* test : {"ks",
                               "lilliefors",
                               "shapiro_wilk",
                               "anderson_darling",
                               "jarque_bera",
                               "ppcc"}) {
        EXPECT_TRUE(result["normality"].contains(test)) << test;
      }
      for (const char* block :
           {"in_order", "within_groups", "by_group", "by_position"}) {
        EXPECT_TRUE(result["randomness"][block].is_object()) << block;
      }
    }
  }
  const auto rows = Records(Read("study/residuals.csv"));
  std::string text = "residual_mm,cycle\n";
  for (const auto& row : rows) {
    if (row.at("holdout") != "groups:5") continue;
    const double residual =
        std::stod(row.at("error_mm")) - std::stod(row.at("poly:eq8"));
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g", residual);
    text += std::string(digits) + "," + row.at("cycle") + "\n";
  }
  Write("r.csv", text);
  const Json again = RunJson(
      {"residuals", "r.csv", "--column", "residual_mm", "--format", "json"});
  const Json result = Model(component, "poly:eq8")["results"]["groups:5"];
  EXPECT_EQ(again["normality"], result["normality"]);
  EXPECT_EQ(again["randomness"]["within_groups"],
            result["randomness"]["within_groups"]);
  EXPECT_EQ(again["randomness"]["in_order"], result["randomness"]["in_order"]);
}

}  // namespace
}  // namespace errmap
