#include "models/kinematics/kinematic_chain.h"

#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/turning_centre/component_errors.h"
#include "cli/turning_centre/simulation.h"
#include "stats/random.h"
#include "tests/models/kinematics/lathe_chain.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

using enum ErrorDirection;

// Sums of products near 0.1 mm: a millionth of a nanometre.
constexpr double kKinematicChainRounding = 1e-12;

std::vector<ErrorDirection> AllSix() { return {kX, kY, kZ, kA, kB, kC}; }

KinematicLink Slide(const std::string& name, Branch branch, Vector3d axis) {
  return {.name = name,
          .branch = branch,
          .joint = Joint::kLinear,
          .axis = axis,
          .errors = AllSix()};
}

KinematicLink Fixed(const std::string& name,
                    Branch branch,
                    const Vector3d& offset,
                    std::vector<ErrorDirection> errors = {}) {
  return {.name = name,
          .branch = branch,
          .joint = Joint::kFixed,
          .offset = offset,
          .errors = std::move(errors)};
}

// Numbers in [-1, 1].
VectorXd Draw(stats::Random* random, Index size) {
  VectorXd values(size);
  for (double& value : values) value = 2.0 * random->Uniform() - 1.0;
  return values;
}

// mm and rad as machines have them.
VectorXd DrawErrors(stats::Random* random, const KinematicChain& chain) {
  VectorXd errors = Draw(random, chain.num_errors());
  for (Index k = 0; k < errors.size(); ++k) {
    const auto& place = chain.errors()[static_cast<std::size_t>(k)];
    errors[k] *= IsRotation(place.direction) ? 50e-6 : 50e-3;
  }
  return errors;
}

// Two rotary and three linear axes over both branches, askew.
KinematicChain FiveAxes() {
  KinematicLink table = Slide("C", Branch::kWork, {0.1, -0.2, 1.0});
  table.joint = Joint::kRotary;
  table.offset = {30.0, -20.0, 110.0};
  KinematicLink head = Slide("B", Branch::kTool, {0.0, 1.0, 0.05});
  head.joint = Joint::kRotary;
  head.offset = {0.0, 10.0, 250.0};
  KinematicLink y = Slide("Y", Branch::kWork, {0.0, -1.0, 0.0});
  y.offset = {1.0, 2.0, 3.0};
  return KinematicChain({y,
                         table,
                         Slide("X", Branch::kTool, {1.0, 0.02, 0.0}),
                         Fixed("0Z", Branch::kTool, {5.0, 0.0, 0.0}, {kA, kB}),
                         Slide("Z", Branch::kTool, {0.0, 0.0, -1.0}),
                         head,
                         Fixed("tool", Branch::kTool, {3.0, -4.0, -120.0})});
}

VectorXd DrawFiveAxes(stats::Random* random) {
  VectorXd coordinates = 300.0 * Draw(random, 5);
  coordinates[1] *= std::numbers::pi / 300.0;  // C, rad
  coordinates[4] *= std::numbers::pi / 300.0;  // B
  return coordinates;
}

TEST(KinematicChain, NoErrorsNoErrorAtTheTool) {
  const KinematicChain chain = FiveAxes();
  stats::Random random(1);
  const VectorXd none = VectorXd::Zero(chain.num_errors());
  const VectorXd pose = DrawFiveAxes(&random);
  EXPECT_LT(chain.ExactError(pose, none).norm(), kKinematicChainRounding);
}

TEST(KinematicChain, SensitivitiesAreTheDerivativesOfTheExactForm) {
  const KinematicChain chain = FiveAxes();
  stats::Random random(3);
  for (int i = 0; i < 20; ++i) {
    const VectorXd pose = DrawFiveAxes(&random);
    const Matrix3Xd sensitivities = chain.Sensitivities(pose);
    for (Index k = 0; k < chain.num_errors(); ++k) {
      // Central differences: truncation 1e-10 of the arm, rounding 1e-8.
      constexpr double kStep = 1e-5;
      VectorXd error = VectorXd::Zero(chain.num_errors());
      error[k] = kStep;
      const Vector3d slope =
          (chain.ExactError(pose, error) - chain.ExactError(pose, -error)) /
          (2.0 * kStep);
      EXPECT_LT((slope - sensitivities.col(k)).norm(), 2e-7) << k;
    }
  }
}

TEST(KinematicChain, ExactAndFirstOrderDifferInSecondOrder) {
  const KinematicChain chain = FiveAxes();
  stats::Random random(4);
  for (int i = 0; i < 20; ++i) {
    const VectorXd pose = DrawFiveAxes(&random);
    // Large enough for the difference to stand above rounding.
    const VectorXd errors = 100.0 * DrawErrors(&random, chain);
    const auto difference = [&](double scale) {
      return (chain.ExactError(pose, scale * errors) -
              chain.Sensitivities(pose) * (scale * errors))
          .norm();
    };
    // The third order bends it by a share of the angle, 0.005 rad.
    EXPECT_NEAR(difference(1.0) / difference(0.5), 4.0, 0.15);
    EXPECT_NEAR(difference(0.5) / difference(0.25), 4.0, 0.08);
  }
}

// A table that goes to -x puts the tool at +x on the work.
TEST(KinematicChain, NominalReachIsThePlaceOnTheWork) {
  KinematicLink column = Slide("Z", Branch::kTool, {0.0, 0.0, 1.0});
  column.offset = {0.0, 0.0, 500.0};
  const KinematicChain chain({column,
                              Fixed("tool", Branch::kTool, {0.0, 0.0, -150.0}),
                              Slide("X", Branch::kWork, {-1.0, 0.0, 0.0})});
  EXPECT_LT(
      (chain.NominalReach(Vector2d(20.0, 70.0)) - Vector3d(70.0, 0.0, 370.0))
          .norm(),
      kKinematicChainRounding);
  EXPECT_THROW(chain.NominalReach(VectorXd::Zero(1)), std::invalid_argument);
}

TEST(KinematicChain, ATipThatIsTooFarIsPositive) {
  const KinematicChain chain({Slide("X", Branch::kTool, {1.0, 0.0, 0.0})});
  VectorXd errors = VectorXd::Zero(6);
  errors[0] = 0.003;  // EXX
  const VectorXd pose = VectorXd::Constant(1, 100.0);
  EXPECT_NEAR(
      chain.ExactError(pose, errors).x(), 0.003, kKinematicChainRounding);
}

// ---- The simulated lathe: an independent summation.

TEST(KinematicChain, FirstOrderWithTrueErrorsIsTheSimulatorsToolTip) {
  namespace tc = turning_centre;
  const KinematicChain chain = tests::LatheChain();
  const tc::Simulation simulation =
      tc::Simulate({.seed = 3, .days = 3, .points_per_day = 200});
  double worst_first = 0.0;
  double worst_exact = 0.0;
  double worst_difference = 0.0;
  for (const tc::ToolTipPoint& point : simulation.points) {
    const tc::TemperatureRise& rise = simulation.stops[point.stop].rise;
    const VectorXd errors = tests::TrueLatheErrors(point, rise);
    const VectorXd pose = tests::LatheCoordinates(point);
    const tc::ToolTipError truth = tc::ToolTipErrorAt(
        point.x, point.x_direction, point.z, point.z_direction, rise);
    const Vector3d expected(truth.x, truth.y, truth.z);
    const Vector3d exact = chain.ExactError(pose, errors);
    const Vector3d first = chain.Sensitivities(pose) * errors;
    worst_first = std::max(worst_first, (first - expected).norm());
    worst_exact = std::max(worst_exact, (exact - expected).norm());
    worst_difference = std::max(worst_difference, (exact - first).norm());
  }
  EXPECT_LT(worst_first, 1e-12);
  EXPECT_LT(worst_exact, 1e-5);
  // They are two forms indeed.
  EXPECT_GT(worst_difference, 1e-8);
}

// What the sign is for: told to go where the error is not, the simulated tool
// is where it should be; told the other way, it is twice as far off.
TEST(KinematicChain, MinusTheErrorTakesTheSimulatedToolWhereItShouldBe) {
  namespace tc = turning_centre;
  const KinematicChain chain = tests::LatheChain();
  const tc::Simulation simulation =
      tc::Simulate({.seed = 4, .days = 2, .points_per_day = 100});
  for (const tc::ToolTipPoint& point : simulation.points) {
    const tc::TemperatureRise& rise = simulation.stops[point.stop].rise;
    const Vector3d error = chain.ExactError(
        tests::LatheCoordinates(point), tests::TrueLatheErrors(point, rise));
    // Where the tool is in X and Z, less where it should be.
    const auto rest = [&](double sign) {
      const double x = point.x + sign * error.x();
      const double z = point.z + sign * error.z();
      const tc::ToolTipError there =
          tc::ToolTipErrorAt(x, point.x_direction, z, point.z_direction, rise);
      return Vector2d(x + there.x - point.x, z + there.z - point.z);
    };
    const Vector2d before(error.x(), error.z());
    // Errors change by less than 1e-3 of the way.
    EXPECT_LT(rest(-1.0).norm(), 2e-3 * before.norm() + 1e-5);
    EXPECT_NEAR(rest(1.0).norm(), 2.0 * before.norm(), 2e-3 * before.norm());
  }
}

// By hand, from a drawing: the tip at (386 + x, 600 + z - 120) in X and Z; a
// turn b about Y moves what is dz further right by b dz in X and what is dx
// higher by -b dx in Z.
TEST(KinematicChain, AgreesWithALatheWorkedOutByHand) {
  const KinematicChain chain = tests::LatheChain();
  const Vector2d pose(-300.0, -100.0);  // z, x in the order of the links
  // In the order of the links: EB0Z; EZZ, EXZ, EBZ; EB0X; EXX, EZX, EBX;
  // EZ0C, EX0C, EY0C, EB0C, EA0C. mm and rad.
  const VectorXd errors{{8e-6,
                         0.004,
                         -0.001,
                         -3e-6,
                         -15e-6,
                         -0.012,
                         0.002,
                         6e-6,
                         0.007,
                         0.020,
                         0.001,
                         30e-6,
                         5e-6}};
  // X: 8e-6 * 180 - 0.001 + (-3e-6 - 15e-6 + 6e-6) * (-120) - 0.012
  //    - 0.020 - 30e-6 * 180
  // Y: -0.001 + 5e-6 * 180
  // Z: -8e-6 * 286 + 0.004 + (3e-6 + 15e-6) * 286 + 0.002 - 0.007
  //    + 30e-6 * 286
  const Vector3d by_hand(-0.03552, -0.0001, 0.01044);
  EXPECT_LT((chain.Sensitivities(pose) * errors - by_hand).norm(),
            kKinematicChainRounding);
}

// ---- A textbook machine.

// Three axes on the tool's side, X carrying Y carrying Z (Zhang et al. 1985
// give this sum for coordinate measuring machines): every translation, and each
// angle times the arm from its slide to the tip.
TEST(KinematicChain, AgreesWithThe21ErrorsOfThreeAxes) {
  const KinematicChain chain(
      {Slide("X", Branch::kTool, {1.0, 0.0, 0.0}),
       Fixed("0Y", Branch::kTool, {0.0, 0.0, 0.0}, {kC}),
       Slide("Y", Branch::kTool, {0.0, 1.0, 0.0}),
       Fixed("0Z", Branch::kTool, {0.0, 0.0, 0.0}, {kA, kB}),
       Slide("Z", Branch::kTool, {0.0, 0.0, 1.0}),
       Fixed("tool", Branch::kTool, {0.0, 0.0, -150.0})});
  ASSERT_EQ(chain.num_errors(), 21);
  stats::Random random(6);
  for (int i = 0; i < 50; ++i) {
    const VectorXd e = DrawErrors(&random, chain);
    const Vector3d pose = 400.0 * Draw(&random, 3);
    const double y = pose.y();
    const double z = pose.z();
    const double t = -150.0;
    const VectorXd x_axis = e.segment(0, 6);
    const double c0y = e[6];
    const VectorXd y_axis = e.segment(7, 6);
    const double a0z = e[13];
    const double b0z = e[14];
    const VectorXd z_axis = e.segment(15, 6);
    const Vector3d expected(
        x_axis[0] + y_axis[0] + z_axis[0] - (x_axis[5] + c0y) * y +
            (x_axis[4] + y_axis[4] + b0z) * z +
            (x_axis[4] + y_axis[4] + z_axis[4] + b0z) * t,
        x_axis[1] + y_axis[1] + z_axis[1] - (x_axis[3] + y_axis[3] + a0z) * z -
            (x_axis[3] + y_axis[3] + z_axis[3] + a0z) * t,
        x_axis[2] + y_axis[2] + z_axis[2] + x_axis[3] * y);
    EXPECT_LT((chain.Sensitivities(pose) * e - expected).norm(),
              kKinematicChainRounding);
    // Products of 1e-4 rad with 0.1 mm, and half its square with 500 mm.
    EXPECT_LT((chain.ExactError(pose, e) - expected).norm(), 5e-5);
  }
}

TEST(KinematicChain, ErrorsOfATableCountTheOtherWay) {
  // The table carries the work to -x for the tool to be at +x on it.
  const KinematicChain chain({Slide("X", Branch::kWork, {-1.0, 0.0, 0.0}),
                              Slide("Z", Branch::kTool, {0.0, 0.0, 1.0})});
  const Vector2d pose(200.0, 50.0);
  VectorXd errors = VectorXd::Zero(12);
  errors[0] = 0.004;  // EXX
  errors[5] = 1e-5;   // ECX: the table's origin is at x = -200
  const Vector3d error = chain.Sensitivities(pose) * errors;
  EXPECT_NEAR(error.x(), -0.004, kKinematicChainRounding);
  EXPECT_NEAR(error.y(), -1e-5 * 200.0, kKinematicChainRounding);
  EXPECT_NEAR(error.z(), 0.0, kKinematicChainRounding);
}

TEST(KinematicChain, ErrorsOfARotaryAxisStayInTheFrameBelowIt) {
  KinematicLink c = Slide("C", Branch::kTool, {0.0, 0.0, 2.0});
  c.joint = Joint::kRotary;
  const KinematicChain chain(
      {c, Fixed("tool", Branch::kTool, {100.0, 0.0, 30.0})});
  // A quarter turn puts the tip at (0, 100, 30).
  const VectorXd pose = VectorXd::Constant(1, std::numbers::pi / 2.0);
  VectorXd errors = VectorXd::Zero(6);
  errors[0] = 0.001;  // EXC moves along X of the base, whatever the angle
  errors[5] = 1e-5;   // ECC turns 100 mm of arm along -X
  errors[3] = 2e-6;   // EAC turns (0, 100, 30) about X: -30 in Y, 100 in Z
  const Vector3d error = chain.Sensitivities(pose) * errors;
  EXPECT_NEAR(error.x(), 0.001 - 1e-5 * 100.0, kKinematicChainRounding);
  EXPECT_NEAR(error.y(), -2e-6 * 30.0, kKinematicChainRounding);
  EXPECT_NEAR(error.z(), 2e-6 * 100.0, kKinematicChainRounding);
}

// ---- Mistakes.

TEST(KinematicChain, RefusesWhatIsNoChain) {
  const auto expect = [](std::vector<KinematicLink> links, const char* says) {
    EXPECT_THAT([&] { KinematicChain chain(links); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(says)));
  };
  const KinematicLink x = Slide("X", Branch::kTool, {1.0, 0.0, 0.0});
  expect({}, "no link on the tool's branch");
  expect({Slide("X", Branch::kWork, {1.0, 0.0, 0.0})}, "no link on the tool");
  expect({x, x}, "two links are named 'X'; a chain has no loops");
  expect({Slide("", Branch::kTool, {1.0, 0.0, 0.0})}, "without a name");
  expect({Slide("X", Branch::kTool, {0.0, 0.0, 0.0})}, "link 'X' moves");
  expect({Fixed("F", Branch::kTool, {0.0, NAN, 0.0})}, "link 'F' has a number");
  expect({Fixed("F", Branch::kTool, {0.0, 0.0, 0.0}, {kA, kA})}, "error twice");
}

TEST(KinematicChain, RefusesOtherNumbersOfCoordinatesAndErrors) {
  const KinematicChain chain({Slide("X", Branch::kTool, {1.0, 0.0, 0.0})});
  EXPECT_THAT([&] { chain.NominalReach(VectorXd::Zero(2)); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("2 coordinates, expected 1")));
  EXPECT_THAT(
      [&] { chain.ExactError(VectorXd::Zero(1), VectorXd::Zero(5)); },
      ThrowsMessage<std::invalid_argument>(HasSubstr("5 errors, expected 6")));
}

}  // namespace
}  // namespace errmap::models
