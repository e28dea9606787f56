#include "models/export/program/map_program.h"

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"
#include "models/averaged_model.h"
#include "models/export/export_map.h"
#include "models/export/program/run_program.h"
#include "models/export/program/self_test.h"
#include "models/history/history.h"
#include "models/net/feedforward_net.h"
#include "models/polynomial/polynomial_model.h"
#include "tests/numbers.h"

namespace errmap::models {
namespace {

using Eigen::Index;

data::ColumnInfo Column(const std::string& name) {
  return {name, data::UnitOfColumn(name)};
}

// Inputs x0_mm, x1_degC, ... in 10 to 20.
std::vector<TrainedInput> Inputs(std::size_t count) {
  std::vector<TrainedInput> inputs;
  for (std::size_t i = 0; i < count; ++i) {
    inputs.push_back(
        {Column("x" + std::to_string(i) + "_degC"), 10.0, 20.0, 15.0, 3.0});
  }
  return inputs;
}

PolynomialForm Cubic(std::size_t inputs) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  PolynomialForm form;
  const auto p = static_cast<Index>(inputs);
  form.input_offset = Eigen::VectorXd::Constant(p, 15.0);
  form.input_scale = Eigen::VectorXd::Constant(p, 0.2);
  form.intercept = uniform(random);
  std::vector<int> powers(inputs, 0);
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    std::vector<int> of(inputs, 0);
    ++of[a];
    if (b < inputs) ++of[b];
    if (c < inputs) ++of[c];
    form.terms.push_back({of, uniform(random)});
  };
  for (std::size_t a = 0; a < inputs; ++a) {
    add(a, inputs, inputs);
    for (std::size_t b = a; b < inputs; ++b) {
      add(a, b, inputs);
      for (std::size_t c = b; c < inputs; ++c) add(a, b, c);
    }
  }
  return form;
}

NetForm Net(Index inputs, Index hidden, OutputFunction output) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  NetForm form;
  form.input_offset = Eigen::VectorXd::Constant(inputs, 15.0);
  form.input_scale = Eigen::VectorXd::Constant(inputs, 0.2);
  form.w1 = Eigen::MatrixXd::NullaryExpr(
      hidden, inputs + 1, [&] { return uniform(random); });
  form.w2 = Eigen::MatrixXd::NullaryExpr(
      1, hidden + 1, [&] { return uniform(random); });
  form.output = output;
  form.target_slope = Eigen::VectorXd::Constant(1, 40.0);
  form.target_offset = Eigen::VectorXd::Constant(1, 0.5);
  return form;
}

FittedModel Map(std::shared_ptr<const ErrorModel> model) {
  FittedModel fitted;
  fitted.name = "made";
  fitted.target = Column("error_mm");
  fitted.inputs = Inputs(static_cast<std::size_t>(model->num_inputs()));
  fitted.model = std::move(model);
  return fitted;
}

FittedModel PolynomialMap(std::size_t inputs) {
  PolynomialForm form = Cubic(inputs);
  const auto parameters = static_cast<Index>(form.terms.size()) + 1;
  return Map(std::make_shared<PolynomialModel>(std::move(form), parameters));
}

ClampLimits Narrow(Index inputs) {
  return {.input_min = Eigen::VectorXd::Constant(inputs, 10.0),
          .input_max = Eigen::VectorXd::Constant(inputs, 20.0),
          .error_min = -0.5,
          .error_max = 0.5};
}

// Filters of both kinds, zeros of both kinds, a filter of a zero, and an angle.
FittedModel MapWithMemory() {
  FittedModel fitted = PolynomialMap(6);
  fitted.inputs = Inputs(2);
  fitted.inputs.push_back({Column("c_deg"), -180.0, 180.0, 0.0, 100.0});
  const DerivedInput slow = Ema(fitted.inputs[0].column, 1800.0, "s");
  const DerivedInput zeroed = Zeroed(fitted.inputs[1].column);
  const DerivedInput slow_zero = Zeroed(slow.column);
  const DerivedInput slow_of_zero = Ema(zeroed.column, 60.0, "s");
  DerivedInput held = Ema(fitted.inputs[0].column, 240.0, "s");
  held.between = Between::kHeld;
  const DerivedInput sine = SineOf(fitted.inputs[2].column);
  fitted.history = std::make_shared<History>(
      History{.time_unit = "s",
              .session = "day",
              .derived = {slow, zeroed, slow_zero, slow_of_zero, held, sine},
              .form_inputs = {slow.column.name,
                              slow_zero.column.name,
                              slow_of_zero.column.name,
                              held.column.name,
                              sine.column.name,
                              fitted.inputs[0].column.name}});
  return fitted;
}

double DeviationOf(const FittedModel& fitted,
                   Precision precision = Precision::kDouble) {
  const MapProgram program = MakeMapProgram(fitted);
  const std::vector<SelfTestRow> rows = SelfTestRows(fitted, program);
  EXPECT_EQ(rows.size(), 24);
  return FindDeviations(program, precision, rows, ErrorRange(fitted, rows))
      .anywhere;
}

TEST(NestedPolynomial, FormsNoPower) {
  // 1 + 2 x + 3 x^2 + 4 x^3 by Horner: three products, three sums.
  PolynomialForm form;
  form.input_offset = Eigen::VectorXd::Zero(1);
  form.input_scale = Eigen::VectorXd::Ones(1);
  form.intercept = 1.0;
  form.terms = {{{1}, 2.0}, {{3}, 4.0}, {{2}, 3.0}};
  std::vector<Op> ops;
  for (const Instruction& it : NestedPolynomial(form)) ops.push_back(it.op);
  EXPECT_THAT(ops,
              ::testing::ElementsAre(
                  Op::kSet, Op::kTimesPlus, Op::kTimesPlus, Op::kTimesPlus));
}

TEST(MapProgram, AgreesWithPolynomials) {
  for (const std::size_t inputs : {1, 2, 3, 6}) {
    EXPECT_LT(DeviationOf(PolynomialMap(inputs)), 1e-14) << inputs;
  }
}

TEST(MapProgram, AgreesWithPolynomialsThatBendWithinARange) {
  PolynomialForm form = Cubic(3);
  form.bends_within = {{.input = 2, .min = 13.0, .max = 16.0},
                       {.input = 0, .min = 12.0, .max = 17.0}};
  const auto parameters = static_cast<Index>(form.terms.size()) + 1;
  const FittedModel held =
      Map(std::make_shared<PolynomialModel>(form, parameters));
  EXPECT_LT(DeviationOf(held), 1e-14);
  // The rows that both are shown lie beyond these ranges, too.
  const std::vector<SelfTestRow> rows =
      SelfTestRows(held, MakeMapProgram(held));
  EXPECT_GT(FindDeviations(MakeMapProgram(PolynomialMap(3)),
                           Precision::kDouble,
                           rows,
                           ErrorRange(held, rows))
                .anywhere,
            0.1);
}

TEST(MapProgram, AgreesWithAThousandTerms) {
  const FittedModel fitted = PolynomialMap(17);  // 1139 terms
  ASSERT_GT(fitted.model->num_parameters(), 1000);
  EXPECT_LT(DeviationOf(fitted), 1e-13);
}

TEST(MapProgram, AgreesWithNets) {
  for (const OutputFunction output :
       {OutputFunction::kSigmoid, OutputFunction::kLinear}) {
    const FittedModel fitted =
        Map(std::make_shared<FeedforwardNet>(Net(4, 7, output)));
    EXPECT_LT(DeviationOf(fitted), 1e-13) << ToString(output);
    EXPECT_LT(DeviationOf(fitted, Precision::kSingle), 1e-5);
  }
}

TEST(MapProgram, AgreesWithBlendsWhoseMembersAreBounded) {
  const auto polynomial =
      std::make_shared<PolynomialModel>(Cubic(2), Index{10});
  const auto net =
      std::make_shared<FeedforwardNet>(Net(3, 4, OutputFunction::kLinear));
  const double infinity = std::numeric_limits<double>::infinity();
  const FittedModel fitted = Map(std::make_shared<AveragedModel>(
      4,
      "power4",
      std::vector<AveragedMember>{
          {"a", 3.0, {3, 1}, -0.2, 0.3, polynomial},
          {"b", 1.0, {0, 2, 3}, -infinity, infinity, net}}));
  EXPECT_LT(DeviationOf(fitted), 1e-14);
}

TEST(MapProgram, ClipsAsPredictDoes) {
  FittedModel fitted = PolynomialMap(3);
  fitted.guards = Narrow(3);
  EXPECT_LT(DeviationOf(fitted), 1e-14);
  const MapProgram program = MakeMapProgram(fitted);
  ProgramRun run(program, Precision::kDouble);
  double error = kNaN;
  run.Step(0.0, Eigen::VectorXd::Constant(3, 15.0), &error);
  EXPECT_EQ(run.Step(0.0, Eigen::VectorXd::Constant(3, 90.0), &error),
            kMapClipped);
  EXPECT_LE(std::fabs(error), 0.5 + fitted.guards->error_margin + 1e-12);
}

TEST(MapProgram, RunsFiltersAndZerosAsPredictDoes) {
  EXPECT_LT(DeviationOf(MapWithMemory()), 1e-13);
  EXPECT_LT(DeviationOf(MapWithMemory(), Precision::kSingle), 1e-5);
}

TEST(MapProgram, TakesTheZeroAnew) {
  const FittedModel fitted = MapWithMemory();
  const MapProgram program = MakeMapProgram(fitted);
  EXPECT_EQ(program.size(Space::kState), 7);
  ProgramRun run(program, Precision::kDouble);
  ProgramRun fresh(program, Precision::kDouble);
  const Eigen::Vector3d cold(12.0, 13.0, 30.0);
  const Eigen::Vector3d warm(17.0, 18.0, 30.0);
  double error = kNaN;
  run.Begin(cold);
  run.Step(1.0, warm, &error);
  run.Step(1e9, warm, &error);  // all filters have arrived
  run.Zero(warm);
  run.Step(1e9, warm, &error);  // and forgotten the old zero
  double of_fresh = kNaN;
  fresh.Begin(warm);
  fresh.Step(0.0, warm, &of_fresh);
  EXPECT_NEAR(error, of_fresh, 1e-12);
}

TEST(MapProgram, KeepsItsStateWhereAReadingIsMissing) {
  const MapProgram program = MakeMapProgram(MapWithMemory());
  ProgramRun run(program, Precision::kDouble);
  ProgramRun spared(program, Precision::kDouble);
  const Eigen::Vector3d cold(12.0, 13.0, 30.0);
  const Eigen::Vector3d warm(17.0, 18.0, 30.0);
  double error = 7.0;
  EXPECT_EQ(run.Begin(Eigen::Vector3d(kNaN, 13.0, 30.0)), kMapInvalid);
  run.Begin(cold);
  spared.Begin(cold);
  EXPECT_EQ(run.Step(60.0, Eigen::Vector3d(kNaN, 13.0, 30.0), &error),
            kMapInvalid);
  EXPECT_NE(run.Step(-1.0, warm, &error) & kMapInvalid, 0);
  EXPECT_EQ(error, 7.0);
  double of_spared = kNaN;
  run.Step(120.0, warm, &error);
  spared.Step(120.0, warm, &of_spared);
  EXPECT_EQ(error, of_spared);
}

TEST(MapProgram, RefusesFiltersThatRunInRows) {
  FittedModel fitted = PolynomialMap(1);
  const DerivedInput slow = Ema(fitted.inputs[0].column, 5.0, "rows");
  fitted.history =
      std::make_shared<History>(History{.time_unit = "rows",
                                        .session = "",
                                        .derived = {slow},
                                        .form_inputs = {slow.column.name}});
  try {
    MakeMapProgram(fitted);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(),
                ::testing::HasSubstr("counts rows, and a controller seconds"));
  }
}

TEST(PrepareExport, RefusesSinglePrecisionWhereItLosesTooMuch) {
  // An offset a million times what varies: a float keeps seven digits.
  PolynomialForm form;
  form.input_offset = Eigen::VectorXd::Zero(1);
  form.input_scale = Eigen::VectorXd::Ones(1);
  form.intercept = 1e7;
  form.terms = {{{1}, 1.0}};
  const FittedModel fitted =
      Map(std::make_shared<PolynomialModel>(form, Index{2}));
  EXPECT_THROW(PrepareExport({&fitted}, "name", Precision::kSingle),
               std::invalid_argument);
  EXPECT_LT(
      PrepareExport({&fitted}, "name", Precision::kDouble).deviations.anywhere,
      1e-9);
  EXPECT_THROW(PrepareExport({&fitted}, "na me", Precision::kDouble),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::models
