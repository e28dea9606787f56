// Stepwise selection and its coefficient table against R's step() and
// summary(lm): tests/golden/stepwise/make_golden.R.
#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "fitting/least_squares/regression_diagnostics.h"
#include "fitting/selection/stepwise_selection.h"
#include "models/polynomial/polynomial_basis.h"
#include "tests/fitting/stepwise_data.h"
#include "tests/models/model_test_data.h"
#include "tests/places.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// What two orthogonalisations of the same columns may differ by.
constexpr double kAic = 1e-9;
constexpr double kTable = 1e-10;

nlohmann::json ReadCases(const std::string& name) {
  nlohmann::json json;
  std::ifstream(tests::TestDir() + "/golden/stepwise/" + name) >> json;
  return json["cases"];
}

void ExpectRelative(double found,
                    double expected,
                    double relative,
                    const std::string& what) {
  EXPECT_NEAR(found, expected, relative * std::abs(expected)) << what;
}

// "+c41" or "-c41" of a step.
std::string NameOf(const SelectionStep& step) {
  if (step.candidate < 0) return "";
  return (step.entered ? "+c" : "-c") + std::to_string(step.candidate);
}

void ExpectAsInR(const nlohmann::json& golden,
                 const MatrixXd& candidates,
                 const VectorXd& response,
                 const VectorXd& weights) {
  SCOPED_TRACE(golden["name"].get<std::string>());
  StepwiseOptions options;
  const bool is_aic = golden["k"] == 2.0;
  options.select = is_aic ? Criterion::kAic : Criterion::kBic;
  options.stop = options.choose = options.select;
  const std::string direction = golden["direction"];
  options.direction = direction == "forward"    ? Direction::kForward
                      : direction == "backward" ? Direction::kBackward
                                                : Direction::kBoth;
  const RegressionProblem problem{candidates, response, weights};
  const SelectionResult result = SelectStepwise(problem, {}, options);
  ASSERT_EQ(result.steps.size(), golden["steps"].size());
  for (std::size_t i = 0; i < result.steps.size(); ++i) {
    const SelectionStep& step = result.steps[i];
    EXPECT_EQ(NameOf(step), golden["steps"][i]);
    ExpectRelative(step.residual_sum_of_squares, golden["rss"][i], kAic, "rss");
    // Absolute: 1e-13 of the figure, which is several thousand.
    EXPECT_NEAR(
        is_aic ? step.aic : step.bic, golden["aic"][i].get<double>(), kAic);
  }
  EXPECT_EQ(result.chosen_step, result.steps.size() - 1);
  MatrixXd terms(response.size(), static_cast<Index>(golden["terms"].size()));
  for (std::size_t j = 0; j < golden["terms"].size(); ++j) {
    const std::string name = golden["terms"][j];
    terms.col(static_cast<Index>(j)) =
        candidates.col(std::stol(name.substr(1)));
  }
  const RegressionDiagnostics fit = Diagnose({terms, response, weights});
  ASSERT_TRUE(fit.aliased.empty());
  const auto check = [&](const CoefficientEstimate& line, std::size_t i) {
    const std::string which = " of coefficient " + std::to_string(i);
    ExpectRelative(
        line.estimate, golden["estimate"][i], kTable, "estimate" + which);
    ExpectRelative(line.standard_error,
                   golden["standard_error"][i],
                   kTable,
                   "standard error" + which);
    ExpectRelative(line.t, golden["t"][i], kTable, "t" + which);
    // d ln p / d ln t is about -t^2 far out, so p loses what t^2 magnifies.
    const double magnified = 1.0 + line.t * line.t;
    ExpectRelative(line.p, golden["p"][i], kTable * magnified, "p" + which);
    ExpectRelative(line.lower, golden["lower"][i], kTable, "lower" + which);
    ExpectRelative(line.upper, golden["upper"][i], kTable, "upper" + which);
  };
  check(fit.intercept, 0);
  for (std::size_t j = 0; j < fit.coefficients.size(); ++j) {
    check(fit.coefficients[j], j + 1);
    ExpectRelative(fit.coefficients[j].vif, golden["vif"][j], kTable, "VIF");
  }
  ExpectRelative(fit.s, golden["s"], kTable, "s");
  ExpectRelative(fit.r2, golden["r2"], kTable, "R2");
  ExpectRelative(fit.adjusted_r2, golden["adjusted_r2"], kTable, "adj R2");
  ExpectRelative(fit.f, golden["f"], kTable, "F");
  RowDiagnostics rows;
  rows.Add(fit, terms, response, weights);
  ExpectRelative(rows.press, golden["press"], kTable, "PRESS");
  // The same PRESS is logged at the last step.
  ExpectRelative(
      result.steps.back().press, golden["press"], 1e-9, "logged PRESS");
}

TEST(StepwiseGolden, QuadraticTermsOf41InputsAreChosenAsInR) {
  const auto data = errmap::testing::ReadTurningCentre();
  ASSERT_EQ(data.inputs.rows(), 595);
  for (const auto& golden : ReadCases("quadratic.json")) {
    const bool centred =
        golden["name"].get<std::string>().starts_with("centred");
    const MatrixXd candidates = errmap::testing::QuadraticTerms(
        centred ? errmap::testing::Centred(data.inputs) : data.inputs);
    ASSERT_EQ(candidates.cols(), 902);
    ExpectAsInR(golden, candidates, data.error, VectorXd());
  }
}

TEST(StepwiseGolden, EveryDirectionWithAndWithoutWeightsGoesAsInR) {
  const data::Dataset shipped = errmap::testing::ShippedMeasurements();
  const MatrixXd candidates = models::TermMatrix(
      errmap::testing::Centred(shipped.input_values()), models::AllTerms(2, 4));
  VectorXd cycling(shipped.num_rows());
  for (Index i = 0; i < cycling.size(); ++i) {
    cycling[i] = 1.0 + static_cast<double>(i % 3);
  }
  for (const auto& golden : ReadCases("shipped.json")) {
    const bool weighted =
        golden["name"].get<std::string>().ends_with("weighted");
    ExpectAsInR(golden,
                candidates,
                shipped.target_values(),
                weighted ? cycling : VectorXd());
  }
}

}  // namespace
}  // namespace errmap::fitting
