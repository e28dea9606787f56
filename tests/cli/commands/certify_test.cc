// errmap certify, run as a user runs it.

#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::HasSubstr;

class Certify : public Cli {
 protected:
  // A problem of data/sets/nist_strd as a user's CSV: the line of columns and
  // the lines after "data", commas for blanks.
  static std::string CsvOf(const std::string& problem) {
    std::ifstream stream(tests::SourceDir() + "/data/sets/nist_strd/" +
                         problem + ".txt");
    std::string text;
    bool is_data = false;
    for (std::string line; std::getline(stream, line);) {
      const std::string columns = "columns ";
      if (line.starts_with(columns))
        line.erase(0, columns.size());
      else if (line == "data") {
        is_data = true;
        continue;
      } else if (!is_data)
        continue;
      std::replace(line.begin(), line.end(), ' ', ',');
      text += line + "\n";
    }
    return text;
  }

  // One run serves all tests of it: it takes some seconds.
  const Json& Nist() const {
    static const Json kDocument =
        RunJson({"certify", "nist", "--format", "json"});
    return kDocument;
  }
};

// The floors of the issue that asked for the command: digits, shares.
constexpr double kParameters = 10.0;
constexpr double kMeanParameters = 10.6;
constexpr double kLinear = 13.0;
constexpr double kNumAcc4Sd = 8.0;
constexpr double kObjective = 1e-8;
constexpr double kPredictions = 1e-6;

TEST_F(Certify, NistFiguresReachTheirFloors) {
  const Json& document = Nist();
  EXPECT_EQ(document["schema"], "errmap-certify-1");
  EXPECT_EQ(document["passed"], true);
  int runs = 0;
  for (const Json& row : document["nonlinear"]) {
    if (row["solver"] != "lm") continue;
    ++runs;
    EXPECT_GE(row["lre_parameters"], kParameters) << row;
    EXPECT_GE(row["lre_sd"], kParameters) << row;
    EXPECT_GE(row["lre_rss"], kParameters) << row;
  }
  EXPECT_EQ(runs, 54);
  const Json& best = document["nonlinear_summary"][0];
  EXPECT_EQ(best["solver"], "lm");
  EXPECT_EQ(best["solved"], 54);
  EXPECT_GE(best["mean_lre_parameters"], kMeanParameters);
  ASSERT_EQ(document["linear"].size(), 11U);
  for (const Json& row : document["linear"]) {
    EXPECT_GE(row["lre_coefficients"], kLinear) << row;
    EXPECT_GE(row["lre_sd"], kLinear) << row;
    EXPECT_GE(row["lre_rss"], kLinear) << row;
    if (row["problem"] == "Filip") {
      EXPECT_GE(row["bits"], 106);
    }
  }
  ASSERT_EQ(document["univariate"].size(), 9U);
  for (const Json& row : document["univariate"]) {
    EXPECT_GE(row["lre_mean"], kLinear) << row;
    EXPECT_GE(row["lre_sd"], row["problem"] == "NumAcc4" ? kNumAcc4Sd : kLinear)
        << row;
    EXPECT_GE(row["lre_autocorrelation"], kLinear) << row;
  }
}

// The proof is of what a user runs: errmap fit on the CSV of a problem's data
// says, to the last bit, what certify judges.
TEST_F(Certify, LinearFiguresAreThoseOfFit) {
  std::map<std::string, Json> rows;
  for (const Json& row : Nist()["linear"])
    rows[row["problem"].get<std::string>()] = row;
  for (const std::string problem :
       {"Filip", "Longley", "Norris", "NoInt1", "Wampler2", "Wampler5"}) {
    const Json& row = rows.at(problem);
    const std::string text = CsvOf(problem);
    Write("data.csv", text);
    // All of them, a year that only counts on, too.
    const std::string inputs =
        text.substr(2, text.find('\n') - 2);  // after "y,"
    const Json fitted = RunJson({"fit",
                                 "data.csv",
                                 "--target",
                                 "y",
                                 "--inputs",
                                 inputs,
                                 "--model",
                                 row["model"].get<std::string>(),
                                 "-o",
                                 "map.json",
                                 "--quiet",
                                 "--format",
                                 "json"});
    const Json& terms = fitted["regression"]["coefficients"];
    ASSERT_EQ(terms.size(), row["estimates"].size()) << problem;
    for (std::size_t j = 0; j < terms.size(); ++j) {
      const Json& found = row["estimates"][j];
      EXPECT_EQ(terms[j]["term"], found["name"]);
      EXPECT_EQ(terms[j]["estimate"], found["estimate"]) << problem;
      EXPECT_EQ(terms[j]["standard_error"], found["standard_deviation"]);
    }
    EXPECT_EQ(fitted["regression"]["anova"]["residual_ss"], row["rss"]);
  }
  // Certified: NIST StRD, Filip's B10 and its standard deviation.
  const Json& last = rows.at("Filip")["estimates"][10];
  EXPECT_NEAR(last["estimate"].get<double>(),
              -0.402962525080404E-04,
              1e-13 * 0.402962525080404E-04);
  EXPECT_NEAR(last["standard_deviation"].get<double>(),
              0.896632837373868E-05,
              1e-13 * 0.896632837373868E-05);
}

// Which solver a command uses is said.
TEST_F(Certify, SaysWhichModelsASolverFits) {
  for (const Json& row : Nist()["nonlinear_summary"]) {
    const std::string solver = row["solver"];
    if (solver == "lm") {
      EXPECT_TRUE(row["fits"].is_null());
    } else {
      EXPECT_EQ(row["fits"], "net:" + solver.substr(0, solver.find(':')));
    }
  }
  for (const Json& row : Nist()["nonlinear"]) {
    if (row["solver"] != "lm") continue;
    EXPECT_FALSE(row["estimates"].empty()) << row;
  }
}

TEST_F(Certify, HoldsEverySolverToAFloor) {
  for (const Json& row : Nist()["nonlinear_summary"]) {
    EXPECT_GT(row["floor_solved"], 0) << row;
    EXPECT_GT(row["floor_mean_lre_parameters"], 0.0) << row;
    EXPECT_GE(row["solved"], row["floor_solved"]) << row;
  }
}

// A claim of fewer digits is made only where another minimum is known.
TEST_F(Certify, BelievesNoClaimOfAMinimumWithoutDigits) {
  int claims = 0;
  for (const Json& row : Nist()["nonlinear"]) {
    if (!row["claims_minimum"]) continue;
    ++claims;
    if (row["other_minimum"] != "") continue;
    EXPECT_GE(row["lre_rss"], 4.0) << row;
  }
  EXPECT_GT(claims, 100);
}

// A solver that stops at a limit must not be said to have converged.
TEST_F(Certify, ShowsEverySolverAsItIs) {
  const Json& document = Nist();
  const std::size_t solvers = document["nonlinear_summary"].size();
  EXPECT_EQ(document["nonlinear"].size(), 54 * solvers);
  int limited = 0;
  for (const Json& row : document["nonlinear"]) {
    EXPECT_NE(row["message"], "") << row;
    if (row["stop"] == "iteration_limit") ++limited;
  }
  EXPECT_GT(limited, 0);
}

TEST_F(Certify, GradientsAndAgreementHold) {
  const Json gradients = RunJson({"certify", "gradients", "--format", "json"});
  EXPECT_GE(gradients["gradients"].size(), 60U);
  EXPECT_TRUE(gradients["linear"].empty());
  for (const Json& row : gradients["gradients"]) {
    EXPECT_LE(row["worst_relative_error"], 1e-6) << row;
  }
  const Json agreement = RunJson({"certify", "agreement", "--format", "json"});
  EXPECT_EQ(agreement["agreement"].size(), 16U);
  for (const Json& row : agreement["agreement"]) {
    EXPECT_LE(row["difference"], row["most_difference"]) << row;
    EXPECT_LE(row["prediction_difference"], row["most_prediction_difference"])
        << row;
    // The steps of the one stay conservative, those of the other too short.
    if (row["solver"] == "nlopt:mma" || row["solver"] == "backprop") continue;
    EXPECT_LE(row["difference"], kObjective) << row;
    EXPECT_LE(row["prediction_difference"], kPredictions) << row;
  }
}

TEST_F(Certify, TableNamesFloorsAndEndsWithAVerdict) {
  const Outcome outcome = Run({"certify", "agreement"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Beside their floors"));
  EXPECT_THAT(outcome.out, HasSubstr("Passed: every floor is reached."));
  const Outcome details = Run({"certify", "gradients", "--details"});
  EXPECT_THAT(details.out, HasSubstr("Thurber, at the minimum"));
}

TEST_F(Certify, TheSameRunTwiceGivesTheSameBytes) {
  const std::vector<std::string> words{
      "certify", "agreement", "--format", "json"};
  EXPECT_EQ(Run(words).out, Run(words).out);
}

TEST_F(Certify, RefusesAnUnknownPart) {
  EXPECT_THAT(RefusalOf(Run({"certify", "everything"}), kWrongCommandLine),
              HasSubstr("everything"));
}

}  // namespace
}  // namespace errmap
