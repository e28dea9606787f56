#include "models/study/journal/fit_record.h"

#include <bit>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/input_error.h"
#include "data/sha256.h"
#include "models/history/history.h"
#include "models/polynomial/polynomial_model.h"
#include "models/recipe_catalog.h"
#include "models/regression_record.h"
#include "models/study/journal/kept_fits.h"
#include "tests/models/model_test_data.h"
#include "tests/numbers.h"

namespace errmap::models {
namespace {

constexpr std::string_view kKey = "key";

using errmap::testing::QuadraticData;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();
constexpr double kMost = std::numeric_limits<double>::max();

FitOutcome OutcomeOfInFitRecord(const std::string& spec,
                                const data::Dataset& dataset) {
  FitOutcome outcome;
  outcome.fitted = MakeRecipe(spec)->Fit(
      dataset, {.seed = 7, .explain = true, .keep_trace = true});
  outcome.seconds = 0.1;
  outcome.train_predictions = outcome.fitted->Predict(dataset);
  outcome.test_predictions = outcome.train_predictions.reverse();
  return outcome;
}

// An outcome in which every list has something.
FitOutcome FullOutcome() {
  FitOutcome outcome;
  FittedModel fitted;
  fitted.name = "poly:eq8";
  fitted.inputs.resize(1);
  PolynomialForm form;
  form.input_offset = form.input_scale = Eigen::VectorXd::Ones(1);
  form.terms = {{{2}, 0.25}};
  fitted.model = std::make_shared<PolynomialModel>(form, 2);
  fitted.summary.trace.resize(1);
  fitted.remarks = {"one"};
  fitted.choices = {{"wfactor", 1.5}};
  fitted.starts.resize(1);
  auto report = std::make_shared<RegressionRecord>();
  report->steps.resize(1);
  report->coefficients.resize(1);
  report->coefficients[0].of_term.value.emplace();
  report->penalised.value.emplace();
  LeastSquaresRecord& fit = report->least_squares.value.emplace();
  fit.excluded.resize(1);
  fit.aliased.resize(1);
  fitted.regression = report;
  fitted.history = std::make_shared<History>(
      History{.time_unit = "s",
              .session = "day",
              .derived = {Zeroed(fitted.inputs[0].column)},
              .form_inputs = {"zeroed()"}});
  fitted.guards = MakeClampLimits(fitted.inputs, Eigen::Vector2d(-1.0, 2.0));
  outcome.fitted = std::move(fitted);
  outcome.train_predictions = Eigen::VectorXd::LinSpaced(5, 0.1, 0.7);
  return outcome;
}

RegressionRecord& Report(FitOutcome* outcome) {
  auto copy = std::make_shared<RegressionRecord>(*outcome->fitted->regression);
  RegressionRecord& report = *copy;
  outcome->fitted->regression = std::move(copy);
  return report;
}

LeastSquaresRecord& Fit(FitOutcome* outcome) {
  return *Report(outcome).least_squares.value;
}

History& Memory(FitOutcome* outcome) {
  auto copy = std::make_shared<History>(*outcome->fitted->history);
  History& history = *copy;
  outcome->fitted->history = std::move(copy);
  return history;
}

TEST(FitRecord, BringsBackEveryKindOfModelToTheBit) {
  constexpr Eigen::Index kRows = 60;
  const data::Dataset dataset = QuadraticData(kRows);
  std::vector<std::string> specs = ModelTypes();
  specs.push_back("poly:formula=position_mm+t1_degC^2");
  specs.push_back("net:scg:hidden=3:iterations=20:starts=3");
  for (const std::string& spec : specs) {
    const FitOutcome outcome = OutcomeOfInFitRecord(spec, dataset);
    const std::string text = FitToBytes(kKey, outcome);
    const FitOutcome back = FitFromBytes(kKey, text);
    EXPECT_EQ(FitToBytes(kKey, back), text) << spec;
    EXPECT_EQ(back.fitted->Predict(dataset), outcome.train_predictions) << spec;
    EXPECT_EQ(back.train_predictions, outcome.train_predictions) << spec;
    EXPECT_EQ(back.test_predictions, outcome.test_predictions) << spec;
    EXPECT_EQ(back.fitted->summary.trace.size(),
              outcome.fitted->summary.trace.size())
        << spec;
    EXPECT_EQ(back.fitted->regression == nullptr,
              outcome.fitted->regression == nullptr)
        << spec;
    EXPECT_EQ(back.fitted->target, outcome.fitted->target) << spec;
  }
}

TEST(FitRecord, BringsBackAFailure) {
  FitOutcome failed;
  failed.why_failed = "20 coefficients need 21 rows, \"found\" 8\n";
  failed.seconds = 3.0;
  const FitOutcome back = FitFromBytes(kKey, FitToBytes(kKey, failed));
  EXPECT_FALSE(back.fitted.has_value());
  EXPECT_EQ(back.why_failed, failed.why_failed);
  EXPECT_EQ(back.seconds, failed.seconds);
  EXPECT_EQ(back.train_predictions.size(), 0);
}

TEST(FitRecord, KeepsTheBitsOfEveryNumber) {
  const std::vector<double> numbers = {0.0,
                                       -0.0,
                                       0.1,
                                       1.0 / 3.0,
                                       1e23,
                                       kDenormal,
                                       kMost,
                                       kInf,
                                       -kInf,
                                       kNaN,
                                       -kNaN,
                                       5e-324,
                                       123456789012345680.0};
  for (const double number : numbers) {
    FitOutcome outcome;
    outcome.seconds = number;
    outcome.train_predictions = Eigen::VectorXd::Constant(3, number);
    const FitOutcome back = FitFromBytes(kKey, FitToBytes(kKey, outcome));
    const auto bits = std::bit_cast<std::uint64_t>(number);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back.seconds), bits) << number;
    for (const double prediction : back.train_predictions) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(prediction), bits) << number;
    }
  }
}

TEST(FitRecord, KeepsVectorsOfEveryLength) {
  for (Eigen::Index size = 0; size < 12; ++size) {
    FitOutcome outcome;
    outcome.test_predictions = Eigen::VectorXd::LinSpaced(size, -1.0, 1e-3);
    EXPECT_EQ(FitFromBytes(kKey, FitToBytes(kKey, outcome)).test_predictions,
              outcome.test_predictions);
  }
}

TEST(FitRecord, KeepsTextsOfAnyBytes) {
  std::string bytes;
  for (int byte = 0; byte < 256; ++byte) bytes += static_cast<char>(byte);
  FitOutcome outcome;
  outcome.why_failed = bytes;
  EXPECT_EQ(FitFromBytes(kKey, FitToBytes(kKey, outcome)).why_failed, bytes);
}

using Mutation = std::function<void(FitOutcome*)>;

std::vector<Mutation> MutationsOfTheModel() {
  return {
      [](auto* o) { o->seconds = 2.0; },
      [](auto* o) { o->why_failed = "x"; },
      [](auto* o) { o->try_again = true; },
      [](auto* o) { o->train_predictions[2] += 1e-16; },
      [](auto* o) { o->test_predictions = Eigen::VectorXd::Zero(1); },
      [](auto* o) { o->fitted.reset(); },
      [](auto* o) { o->fitted->name += "x"; },
      [](auto* o) { o->fitted->kind = ModelKind::kNet; },
      [](auto* o) { o->fitted->target.name = "x"; },
      [](auto* o) { o->fitted->target.unit.symbol = "x"; },
      [](auto* o) { o->fitted->target.unit.display_scale = 2.0; },
      [](auto* o) { o->fitted->target.unit.display_symbol = "x"; },
      [](auto* o) { o->fitted->target.unit.quantity = data::Quantity::kAngle; },
      [](auto* o) { o->fitted->inputs[0].column.name = "x"; },
      [](auto* o) { o->fitted->inputs[0].min = -1.0; },
      [](auto* o) { o->fitted->inputs[0].max = 1.0; },
      [](auto* o) { o->fitted->inputs[0].mean = 1.0; },
      [](auto* o) { o->fitted->inputs[0].sd = 1.0; },
      [](auto* o) { o->fitted->model.reset(); },
      [](auto* o) { o->fitted->equation = "x"; },
      [](auto* o) { o->fitted->remarks.push_back("x"); },
      [](auto* o) { o->fitted->choices[0].key = "x"; },
      [](auto* o) { o->fitted->choices[0].value = std::int64_t{1}; },
      [](auto* o) { o->fitted->choices[0].value = "1.5"; },
      [](auto* o) { o->fitted->starts[0].seed = ~std::uint64_t{0}; },
      [](auto* o) { o->fitted->starts[0].final_cost = 1.0; },
      [](auto* o) {
        o->fitted->starts[0].stop = fitting::Termination::kGradient;
      },
      [](auto* o) { o->fitted->starts[0].iterations = 1; },
      [](auto* o) { o->fitted->starts[0].holdout_rmse = 1.0; },
      [](auto* o) { o->fitted->starts[0].chosen = true; },
      [](auto* o) { o->fitted->regression.reset(); },
      [](auto* o) { o->fitted->history.reset(); },
      [](auto* o) { Memory(o).time_unit = "rows"; },
      [](auto* o) { Memory(o).session = "x"; },
      [](auto* o) { Memory(o).time = "x"; },
      [](auto* o) { Memory(o).derived[0].column.name = "x"; },
      [](auto* o) { Memory(o).derived[0].of = "x"; },
      [](auto* o) { Memory(o).derived[0].filter = Filter::kSine; },
      [](auto* o) { Memory(o).derived[0].tau = 3.0; },
      [](auto* o) { Memory(o).form_inputs = {"x"}; },
      [](auto* o) { Memory(o).latest_start = 3.0; },
      [](auto* o) { o->fitted->align = data::Alignment::kFirst; },
      [](auto* o) { o->fitted->guards.reset(); },
      [](auto* o) { o->fitted->guards->input_margin = 3.0; },
      [](auto* o) { o->fitted->guards->error_margin = 3.0; },
      [](auto* o) { o->fitted->guards->input_min[0] = 3.0; },
      [](auto* o) { o->fitted->guards->input_max[0] = 3.0; },
      [](auto* o) { o->fitted->guards->error_min = 3.0; },
      [](auto* o) { o->fitted->guards->error_max = 3.0; },
  };
}

std::vector<Mutation> MutationsOfTheSummary() {
  using fitting::FitSummary;
  std::vector<Mutation> mutations;
  for (const auto member : {&FitSummary::initial_cost,
                            &FitSummary::final_cost,
                            &FitSummary::initial_gradient_norm,
                            &FitSummary::final_gradient_norm,
                            &FitSummary::seconds,
                            &FitSummary::mean_iteration_seconds,
                            &FitSummary::sd_iteration_seconds}) {
    mutations.push_back([=](auto* o) { o->fitted->summary.*member = 3.0; });
  }
  for (const auto member : {&FitSummary::iterations,
                            &FitSummary::value_evaluations,
                            &FitSummary::gradient_evaluations,
                            &FitSummary::curvature_evaluations}) {
    mutations.push_back([=](auto* o) { o->fitted->summary.*member = 3; });
  }
  const std::vector<Mutation> more = {
      [](auto* o) {
        o->fitted->summary.termination = fitting::Termination::kDirect;
      },
      [](auto* o) { o->fitted->summary.message = "x"; },
      [](auto* o) { o->fitted->summary.trace[0].iteration = 1; },
      [](auto* o) { o->fitted->summary.trace[0].rms_error = 1.0; },
      [](auto* o) { o->fitted->summary.trace[0].gradient_norm = 1.0; },
  };
  mutations.insert(mutations.end(), more.begin(), more.end());
  return mutations;
}

std::vector<Mutation> MutationsOfTheReport() {
  return {
      [](auto* o) { Report(o).method = "x"; },
      [](auto* o) { Report(o).candidates = 1; },
      [](auto* o) { Report(o).steps[0].term = "x"; },
      [](auto* o) { Report(o).steps[0].entered = true; },
      [](auto* o) { Report(o).steps[0].cv = 1.0; },
      [](auto* o) { Report(o).chosen_step = 1; },
      [](auto* o) { Report(o).ended = "x"; },
      [](auto* o) { Report(o).coefficients[0].t = 1.0; },
      [](auto* o) { Report(o).coefficients[0].ci95[1] = 1.0; },
      [](auto* o) { Report(o).coefficients[0].of_term.value->vif = 1.0; },
      [](auto* o) { Report(o).coefficients[0].of_term.value.reset(); },
      [](auto* o) {
        Report(o).centres = {{"x", 1.0}};
      },
      [](auto* o) { Report(o).penalised.value.reset(); },
      [](auto* o) { Report(o).penalised.value->penalty = 1.0; },
      [](auto* o) { Report(o).penalised.value->cross_validation.mse = {1.0}; },
      [](auto* o) { Fit(o).after_selection = true; },
      [](auto* o) { Fit(o).bootstrap.repetitions = 1; },
      [](auto* o) { Fit(o).bootstrap.unit = "x"; },
      [](auto* o) { Fit(o).excluded[0].f = 1.0; },
      [](auto* o) { Fit(o).aliased[0].why = "x"; },
      [](auto* o) { Fit(o).anova.p = 1.0; },
      [](auto* o) { Fit(o).anova.total_ss = kInf; },
      [](auto* o) { Fit(o).largest_residual_row = 1; },
      [](auto* o) { Fit(o).notes = {"x"}; },
  };
}

// That no member is forgotten is the compiler's care (MembersOf); this is that
// none is written and not read, or read into another one's place.
TEST(FitRecord, NoticesAndBringsBackEveryChange) {
  const std::string text = FitToBytes(kKey, FullOutcome());
  for (const auto& mutations : {MutationsOfTheModel(),
                                MutationsOfTheSummary(),
                                MutationsOfTheReport()}) {
    for (std::size_t i = 0; i < mutations.size(); ++i) {
      FitOutcome outcome = FullOutcome();
      mutations[i](&outcome);
      const std::string changed = FitToBytes(kKey, outcome);
      EXPECT_NE(changed, text) << i;
      EXPECT_EQ(FitToBytes(kKey, FitFromBytes(kKey, changed)), changed) << i;
    }
  }
}

// Bytes with the sum that goes with them, as a forger would write them.
std::string WithSum(const std::string& bytes) {
  data::Sha256Stream stream;
  stream.Add(kKey);
  stream.Add(bytes);
  return stream.Finish() + bytes;
}

std::string WithoutSum(const std::string& record) { return record.substr(32); }

TEST(FitRecord, RefusesWhatIsNoRecordOfThisFitAndVersion) {
  const std::string record = FitToBytes(kKey, FullOutcome());
  std::string damaged = record;
  damaged[damaged.size() / 2] ^= 1;
  for (const std::string& bad : {WithSum(WithoutSum(record) + "1"),
                                 record.substr(0, record.size() / 2),
                                 damaged,
                                 FitToBytes("another", FullOutcome()),
                                 std::string()}) {
    EXPECT_THAT([&] { FitFromBytes(kKey, bad); },
                ThrowsMessage<data::InputError>(HasSubstr("record of a fit")));
  }
}

TEST(FitRecord, RefusesOrReadsWhateverPieceOfOneThereIs) {
  const std::string bytes = WithoutSum(FitToBytes(kKey, FullOutcome()));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(FitFromBytes(kKey, WithSum(bytes.substr(0, size))),
                 data::InputError)
        << size;
  }
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string changed = bytes;
    changed[at] = '\xff';
    try {
      FitFromBytes(kKey, WithSum(changed));
    } catch (const data::InputError&) {
    }
  }
}

TEST(FitRecord, RefusesAModelThatCannotBe) {
  // The only power of the model, which must not be negative.
  const auto term = [](int power) {
    std::string bytes(sizeof power + sizeof(double), '\0');
    constexpr double kCoefficient = 0.25;
    std::memcpy(bytes.data(), &power, sizeof power);
    std::memcpy(bytes.data() + sizeof power, &kCoefficient, sizeof(double));
    return bytes;
  };
  std::string bytes = WithoutSum(FitToBytes(kKey, FullOutcome()));
  const std::size_t at = bytes.find(term(2));
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, term(2).size(), term(-2));
  EXPECT_THAT([&] { FitFromBytes(kKey, WithSum(bytes)); },
              ThrowsMessage<data::InputError>(HasSubstr("power")));
}

}  // namespace
}  // namespace errmap::models
