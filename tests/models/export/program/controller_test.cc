#include "models/export/program/controller.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "data/column_header.h"
#include "models/export/program/run_program.h"
#include "models/map_experience.h"
#include "models/polynomial/polynomial_model.h"
#include "tests/numbers.h"

namespace errmap::models {
namespace {

using Eigen::Vector4d;

// error_um = position_mm / 100 + the sum of three thermometers less 15 degC,
// trained in 0 to 100 mm and `low` to 20 degC.
MapProgram LinearMap(double low = 10.0,
                     const LimitOptions& options = {},
                     std::shared_ptr<const Applicability> trained = nullptr,
                     std::optional<double> input_margin = std::nullopt) {
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
  fitted.applicability = std::move(trained);
  if (input_margin) {
    fitted.guards = {.input_margin = *input_margin,
                     .input_min = Vector4d(0.0, low, low, low),
                     .input_max = Vector4d(100.0, 20.0, 20.0, 20.0),
                     .error_min = -20.0,
                     .error_max = 20.0};
  }
  MapProgram program = MakeMapProgram(fitted);
  AddController({&fitted}, options, &program);
  DropIdleGuards(&program);
  return program;
}

// Of its thermometers, with no limit but those of standing still.
std::shared_ptr<const Applicability> Standing(double others_move,
                                              double silence,
                                              double quiet = 0.0,
                                              double jump = 0.0) {
  constexpr double kNone = 1e9;
  Applicability trained;
  trained.columns = {1, 2, 3};
  trained.rows = 10;
  trained.mean = Eigen::Vector3d::Constant(15.0);
  trained.scale = Eigen::Vector3d::Constant(3.0);
  trained.directions = Eigen::Vector3d::Constant(0.9);
  trained.rest = Eigen::Vector3d::Constant(0.2);
  trained.states = Eigen::MatrixXd::Zero(1, 1);
  trained.distance_limit = kNone;
  trained.leverage_limit = kNone;
  trained.relation_limit = Eigen::Vector3d::Constant(kNone);
  trained.standing = {.others_move = Eigen::Vector3d::Constant(others_move),
                      .resolution = Eigen::Vector3d::Constant(0.01),
                      .quiet = Eigen::Vector3d::Constant(quiet),
                      .jump = Eigen::Vector3d::Constant(jump),
                      .pace = Eigen::Vector3d::Constant(0.001),
                      .silence = silence};
  return std::make_shared<const Applicability>(std::move(trained));
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

// Half a range for each kelvin that the two others rise.
TEST(Controller, NoticesASensorThatStandsStillWhileTheOthersMove) {
  const MapProgram program = LinearMap(10.0, {}, Standing(0.25, 0.0));
  ControllerRun run(program, Precision::kDouble);
  double error = kNaN;
  const auto step = [&](double stands, double others) {
    return run.Step(60.0, Vector4d(50.0, stands, others, others), &error);
  };
  for (int i = 0; i <= 8; ++i) {
    const double others = 11.0 + 0.4 * i;
    EXPECT_EQ((step(11.0, others) & kMapFrozen) != 0, i > 6) << i;
  }
  EXPECT_EQ(step(14.5, 14.5) & kMapNotTaken, 0);
  // All at rest is rest.
  for (int i = 0; i < 20; ++i) EXPECT_EQ(step(14.5, 14.5) & kMapFrozen, 0);
}

// The others warm up by more than two steps of its resolution, or have but
// noise.
TEST(Controller, NoticesThatTheNoiseOfASensorIsGone) {
  for (const bool warms : {true, false}) {
    const MapProgram program = LinearMap(10.0, {}, Standing(0.25, 0.0, 300.0));
    ControllerRun run(program, Precision::kDouble);
    double error = kNaN;
    for (int i = 0; i <= 20; ++i) {
      const double others = 16.0 + 0.02 * (i % 2) + (warms ? 0.05 * i : 0.0);
      const int status =
          run.Step(60.0, Vector4d(50.0, 16.0, others, others), &error);
      EXPECT_EQ((status & kMapFrozen) != 0, warms && i >= 10) << i;
    }
  }
}

TEST(Controller, NoticesThatAllSensorsStandStillForLongerThanInTraining) {
  const MapProgram program = LinearMap(10.0, {}, Standing(0.25, 30.0));
  for (const double dt : {1.0, 4.0, 100.0}) {
    ControllerRun run(program, Precision::kDouble);
    double error = kNaN;
    double passed = 0.0;
    const auto step = [&](double all) {
      return run.Step(dt, Vector4d(50.0, all, all, all), &error);
    };
    step(16.0);
    for (int i = 1; i <= 40; ++i) {
      passed += std::min(dt, 6.0);
      EXPECT_EQ((step(16.0) & kMapFrozen) != 0, passed > 30.0)
          << dt << ' ' << i;
    }
    EXPECT_EQ(step(16.5) & kMapFrozen, 0);
  }
}

// By 2 K at once, and by 0.01 K more in each second.
TEST(Controller, RefusesASensorThatJumpedUntilItIsBack) {
  const MapProgram program = LinearMap(10.0, {}, Standing(0.25, 0.0, 0.0, 0.2));
  ControllerRun run(program, Precision::kDouble);
  double error = kNaN;
  const auto jumped = [&](double dt, double sensor) {
    const int status = run.Step(dt, Vector4d(50.0, sensor, 16.0, 16.0), &error);
    EXPECT_EQ((status & kMapUnhealthy) != 0, (status & kMapJumped) != 0);
    return (status & kMapJumped) != 0;
  };
  EXPECT_FALSE(jumped(kLong, 16.0));
  EXPECT_FALSE(jumped(1.0, 18.0));
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(jumped(1.0, 13.0 + 0.01 * (i % 2))) << i;
  }
  EXPECT_FALSE(jumped(1.0, 17.0));
  // Much may change while nothing is read, and before a session.
  EXPECT_FALSE(jumped(1000.0, 12.0));
  EXPECT_TRUE(jumped(1.0, 15.0));
  run.Begin();
  EXPECT_FALSE(jumped(1.0, 15.0));
}

TEST(Controller, HoldsTheLastGoodReadingsWhereTheAxisIs) {
  const MapProgram program = LinearMap();
  ControllerRun run(program, Precision::kDouble);
  double error = kNaN;
  run.Step(kLong, Vector4d(50.0, 16.0, 16.0, 16.0), &error);
  const int status = run.Step(1.0, Vector4d(90.0, kNaN, 18.0, 16.0), &error);
  EXPECT_NE(status & kMapInvalid, 0);
  EXPECT_NE(status & kMapUnhealthy, 0);
  EXPECT_DOUBLE_EQ(error, 3.9);
  // Where the position itself is not a number it stays.
  run.Step(1.0, Vector4d(kNaN, 16.0, 16.0, 16.0), &error);
  EXPECT_DOUBLE_EQ(error, 3.9);
}

TEST(Controller, TakesThePositionBeyondTheTravelForItsEndAndThenRefusesIt) {
  const MapProgram program = LinearMap();
  ControllerRun run(program, Precision::kDouble);
  double error = kNaN;
  const auto step = [&](double position) {
    return run.Step(kLong, Vector4d(position, 16.0, 16.0, 16.0), &error);
  };
  EXPECT_EQ(step(199.0), kMapOutside);
  EXPECT_DOUBLE_EQ(error, 4.0);
  EXPECT_EQ(step(-99.0), kMapOutside);
  EXPECT_DOUBLE_EQ(error, 3.0);
  EXPECT_NE(step(-101.0) & kMapFar, 0);
  EXPECT_NE(step(-101.0) & kMapUnhealthy, 0);
}

TEST(Controller, GivesTheLimitTheLastWord) {
  const MapProgram program = LinearMap();
  ControllerRun run(program, Precision::kDouble);
  const double own = program.limits.max_error;
  const Vector4d warm(50.0, 19.0, 19.0, 19.0);  // 12.5 um
  double error = kNaN;
  run.Step(kLong, warm, &error);
  EXPECT_DOUBLE_EQ(error, 12.5);
  run.SetLimits(2.0, 0.1);
  EXPECT_NE(run.Step(0.0, warm, &error) & kMapLimited, 0);
  EXPECT_DOUBLE_EQ(error, 2.0);
  for (const double none :
       {0.0, -1.0, kNaN, 1e3 * own, std::numeric_limits<double>::infinity()}) {
    run.SetLimits(none, none);
    const int status = run.Step(kLong, warm, &error);
    EXPECT_NE(status & kMapParameter, 0) << none;
    EXPECT_NE(status & kMapUnhealthy, 0) << none;
    EXPECT_LE(std::fabs(error), own) << none;
  }
  run.SetLimits(own, 10.0);
  EXPECT_EQ(run.Step(kLong, warm, &error), 0);
}

// A reading is refused, and a position held, before the guards act.
TEST(Controller, LeavesOutGuardsThatNoBelievedReadingReaches) {
  const auto guards_of_inputs = [](double margin) {
    const MapProgram program = LinearMap(10.0, {}, nullptr, margin);
    return std::ranges::count_if(
        program.forms[0].evaluate, [](const Instruction& it) {
          return it.guards && it.to.space == Space::kForm;
        });
  };
  EXPECT_EQ(guards_of_inputs(2.0), 0);
  // Thermometers are believed 8 K beyond their range of 10 K.
  EXPECT_EQ(guards_of_inputs(0.8), 0);
  EXPECT_EQ(guards_of_inputs(0.7), 6);
  const MapProgram near = LinearMap(10.0, {}, nullptr, 0.1);
  ControllerRun run(near, Precision::kDouble);
  double error = kNaN;
  EXPECT_NE(
      run.Step(kLong, Vector4d(50.0, 22.0, 16.0, 16.0), &error) & kMapClipped,
      0);
  EXPECT_DOUBLE_EQ(error, 0.5 + 6.0 + 1.0 + 1.0);
}

TEST(Controller, RefusesLimitsThatAreNone) {
  for (const double none : {0.0, -1.0, kNaN}) {
    EXPECT_THROW(LinearMap(10.0, {.max_error = none}), std::invalid_argument);
    EXPECT_THROW(LinearMap(10.0, {.max_rate = none}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace errmap::models
