#include "models/export/program/controller.h"

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

#include "models/export/program/run_program.h"
#include "models/polynomial/polynomial_model.h"
#include "tests/numbers.h"

namespace errmap::models {
namespace {

using Eigen::Vector4d;

// error_um = position_mm / 100 + the sum of three thermometers less 15 degC,
// trained in 0 to 100 mm and `low` to 20 degC.
MapProgram LinearMap(double low = 10.0, const LimitOptions& options = {}) {
  PolynomialForm form;
  form.input_offset = Vector4d(0.0, 15.0, 15.0, 15.0);
  form.input_scale = Vector4d(0.01, 1.0, 1.0, 1.0);
  FittedModel fitted;
  fitted.name = "made";
  fitted.target = {"error_um", data::UnitOfSymbol("um")};
  for (const char* name : {"position_mm", "t1_degC", "t2_degC", "t3_degC"}) {
    const bool is_position = fitted.inputs.empty();
    const double min = is_position ? 0.0 : low;
    const double max = is_position ? 100.0 : 20.0;
    PolynomialTerm term{std::vector<int>(4, 0), 1.0};
    term.powers[fitted.inputs.size()] = 1;
    form.terms.push_back(term);
    fitted.inputs.push_back({{name, data::UnitOfColumn(name)},
                             min,
                             max,
                             0.5 * (min + max),
                             0.25 * (max - min)});
  }
  fitted.model = std::make_shared<PolynomialModel>(form, Eigen::Index{5});
  MapProgram program = MakeMapProgram(fitted);
  AddController({&fitted}, options, &program);
  return program;
}

constexpr double kLong = 1e6;  // s: no rate limits the first error

TEST(Controller, HoldsTheLastGoodErrorThenGoesToZero) {
  const MapProgram program = LinearMap();
  ControllerRun run(program, Precision::kDouble);
  double error = kNaN;
  EXPECT_EQ(run.Step(kLong, Vector4d(50.0, 16.0, 16.0, 16.0), &error), 0);
  EXPECT_DOUBLE_EQ(error, 3.5);
  for (const double dead : {0.0, -127.0, 85.0, 850.0, kNaN, 1e300}) {
    EXPECT_NE(
        run.Step(1.0, Vector4d(50.0, dead, 16.0, 16.0), &error) & kMapNotTaken,
        0);
    EXPECT_DOUBLE_EQ(error, 3.5);
  }
  const Vector4d dead(50.0, 0.0, 16.0, 16.0);
  EXPECT_NE(run.Step(60.0, dead, &error) & kMapFaded, 0);
  run.Step(1.0, dead, &error);
  EXPECT_DOUBLE_EQ(error, 0.0);
  run.Step(1.0, Vector4d(50.0, 16.0, 16.0, 16.0), &error);
  EXPECT_DOUBLE_EQ(error, 3.5);
}

TEST(Controller, BelievesAZeroThatWasTrained) {
  const MapProgram program = LinearMap(-10.0);
  ControllerRun run(program, Precision::kDouble);
  double error = kNaN;
  EXPECT_EQ(run.Step(kLong, Vector4d(50.0, 0.0, 1.0, 2.0), &error), 0);
  EXPECT_DOUBLE_EQ(error, -41.5);
}

TEST(Controller, KeepsToItsLimitsWhateverIsSet) {
  const MapProgram program =
      LinearMap(10.0, {.max_error = 2.0, .max_rate = 0.5});
  ControllerRun run(program, Precision::kDouble);
  double error = kNaN;
  const Vector4d warm(50.0, 20.0, 19.0, 18.0);
  EXPECT_EQ(run.Step(1.0, warm, &error), kMapLimited | kMapRamping);
  EXPECT_DOUBLE_EQ(error, 0.5);
  EXPECT_EQ(run.Step(kLong, warm, &error), kMapLimited);
  EXPECT_DOUBLE_EQ(error, 2.0);
  EXPECT_NE(run.Step(std::numeric_limits<double>::infinity(), warm, &error) &
                kMapInvalid,
            0);
  EXPECT_DOUBLE_EQ(error, 2.0);
}

TEST(Controller, LetsTheAxisMoveWithoutTime) {
  const MapProgram program = LinearMap();
  ControllerRun run(program, Precision::kDouble);
  double error = kNaN;
  run.Step(kLong, Vector4d(0.0, 16.0, 16.0, 16.0), &error);
  EXPECT_EQ(run.Step(0.0, Vector4d(100.0, 16.0, 16.0, 16.0), &error), 0);
  EXPECT_DOUBLE_EQ(error, 4.0);
  EXPECT_EQ(run.Step(0.0, Vector4d(100.0, 18.0, 16.0, 16.0), &error),
            kMapRamping);
  EXPECT_DOUBLE_EQ(error, 4.0);
}

TEST(Controller, NoticesASensorThatStandsStillWhileTheOthersMove) {
  const MapProgram program = LinearMap();
  ControllerRun run(program, Precision::kDouble);
  double error = kNaN;
  int status = 0;
  for (int i = 0; i <= 8; ++i) {
    status = run.Step(60.0, Vector4d(50.0, 11.0, 11.0 + i, 11.0 + i), &error);
    if (i < 5) {
      EXPECT_EQ(status & kMapFrozen, 0) << i;
    }
  }
  EXPECT_NE(status & kMapFrozen, 0);
  EXPECT_EQ(
      run.Step(60.0, Vector4d(50.0, 19.0, 19.0, 19.0), &error) & kMapNotTaken,
      0);
  // All at rest is rest.
  for (int i = 0; i < 20; ++i) {
    status = run.Step(60.0, Vector4d(50.0, 19.0, 19.0, 19.0), &error);
  }
  EXPECT_EQ(status, 0);
}

TEST(Controller, RefusesLimitsThatAreNone) {
  for (const double none : {0.0, -1.0, kNaN}) {
    EXPECT_THROW(LinearMap(10.0, {.max_error = none}), std::invalid_argument);
    EXPECT_THROW(LinearMap(10.0, {.max_rate = none}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace errmap::models
