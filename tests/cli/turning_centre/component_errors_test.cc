#include "cli/turning_centre/component_errors.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "cli/turning_centre/simulation.h"
#include "data/csv.h"
#include "tests/places.h"

namespace errmap::turning_centre {
namespace {

using data::CsvTable;
using data::ReadCsv;

constexpr double kUmPerMm = 1000.0;
// Sums of products near 0.1 mm; a millionth of a nanometre.
constexpr double kRounding = 1e-12;

TemperatureRise Uniform(double kelvin) {
  TemperatureRise rise{};
  rise.fill(kelvin);
  return rise;
}

double SomePosition(Component component) {
  switch (TraitsOf(component).slide) {
    case Slide::kX:
      return -101.6;
    case Slide::kZ:
      return -254.0;
    case Slide::kNone:
      break;
  }
  return 0.0;
}

TEST(ComponentErrors, NoHeatNoThermalError) {
  for (const Component component : kComponents) {
    EXPECT_EQ(ThermalError(component, SomePosition(component), Uniform(0.0)),
              0.0)
        << TraitsOf(component).stem;
  }
}

TEST(ComponentErrors, UniformSoakExpandsEachAxisUniformly) {
  const TemperatureRise soak = Uniform(3.0);
  for (const double x : {-12.7, -100.0, -215.9}) {
    // The slide's height above the spindle axis.
    EXPECT_NEAR(ThermalError(Component::kXDisplacement, x, soak),
                kExpansion * (386.0 + x) * 3.0,
                kRounding);
  }
  for (const double z : {-25.4, -200.0, -431.8}) {
    // Its distance from the spindle nose.
    EXPECT_NEAR(ThermalError(Component::kZDisplacement, z, soak),
                kExpansion * (600.0 + z) * 3.0,
                kRounding);
  }
}

TEST(ComponentErrors, UniformSoakBendsAndTiltsNothing) {
  for (const Component component : kComponents) {
    if (component == Component::kXDisplacement ||
        component == Component::kZDisplacement) {
      continue;
    }
    // Angles are in urad.
    EXPECT_NEAR(ThermalError(component, SomePosition(component), Uniform(5.0)),
                0.0,
                1e-9)
        << TraitsOf(component).stem;
  }
}

TEST(ComponentErrors, ThermalErrorIsLinearInTheTemperatures) {
  TemperatureRise one{};
  TemperatureRise two{};
  for (std::size_t i = 0; i < kNumBodies; ++i) {
    one[i] = 0.001 * static_cast<double>(i * i * i % 997);
    two[i] = 2.5 * one[i];
  }
  for (const Component component : kComponents) {
    const double position = SomePosition(component);
    const double error = ThermalError(component, position, one);
    EXPECT_NE(error, 0.0) << TraitsOf(component).stem;
    EXPECT_NEAR(ThermalError(component, position, two), 2.5 * error, 1e-9);
  }
}

TEST(ComponentErrors, ScrewGrowthIsThatOfItsSegmentsAboveTheNut) {
  TemperatureRise rise{};
  rise[kXScrewTop] = 1.0;  // from +80 to -40 mm
  const auto error = [&](double x) {
    return ThermalError(Component::kXDisplacement, x, rise);
  };
  EXPECT_NEAR(error(-20.0), -kExpansion * 100.0, kRounding);
  EXPECT_NEAR(error(-40.0), -kExpansion * 120.0, kRounding);
  EXPECT_NEAR(error(-200.0), -kExpansion * 120.0, kRounding);
}

TEST(ComponentErrors, YawIsTheSlopeOfTheBentWays) {
  TemperatureRise rise{};
  rise[kXWayTop] = 2.0;
  rise[kZWayRight] = 3.0;
  const double step = 1e-3;
  const auto straightness_slope = [&](Component component, double position) {
    return (ThermalError(component, position + step, rise) -
            ThermalError(component, position - step, rise)) /
           (2.0 * step) * 1e6;
  };
  // The slopes differ by that of the line through the ends.
  const auto x_difference = [&](double x) {
    return ThermalError(Component::kXYaw, x, rise) +
           straightness_slope(Component::kXStraightness, x);
  };
  const auto z_difference = [&](double z) {
    return ThermalError(Component::kZYaw, z, rise) -
           straightness_slope(Component::kZStraightness, z);
  };
  EXPECT_GT(std::abs(ThermalError(Component::kXYaw, -100.0, rise)), 1.0);
  EXPECT_NEAR(x_difference(-30.0), x_difference(-200.0), 1e-6);
  EXPECT_NEAR(z_difference(-60.0), z_difference(-400.0), 1e-6);
}

TEST(ComponentErrors, StraightnessVanishesAtTheEndsOfTheSweep) {
  TemperatureRise rise{};
  rise[kXWayTop] = 2.0;
  for (const double x : {-12.7, -215.9}) {
    EXPECT_NEAR(
        ThermalError(Component::kXStraightness, x, rise), 0.0, kRounding);
  }
}

TEST(ComponentErrors, ReversingGivesBacklashAndWindUp) {
  for (const Component component : kComponents) {
    const double position = SomePosition(component);
    const TemperatureRise rise = Uniform(1.0);
    const double gap =
        TrueError(component, position, Direction::kForward, rise) -
        TrueError(component, position, Direction::kReverse, rise);
    if (!TraitsOf(component).has_direction) {
      EXPECT_EQ(gap, 0.0) << TraitsOf(component).stem;
      continue;
    }
    const bool is_x = component == Component::kXDisplacement;
    const double expected = is_x ? 0.0028 + 4.0e-6 * (80.0 + 101.6)
                                 : 0.0035 + 3.0e-6 * (80.0 + 254.0);
    EXPECT_NEAR(gap, expected, kRounding) << TraitsOf(component).stem;
  }
}

TEST(ComponentErrors, ColdSpindleDefinesTheFrame) {
  for (const Component component : {Component::kSpindleAxial,
                                    Component::kSpindleRadialX,
                                    Component::kSpindleRadialY,
                                    Component::kSpindleTiltXz,
                                    Component::kSpindleTiltYz}) {
    EXPECT_EQ(TrueError(component, 0.0, Direction::kForward, {}), 0.0);
  }
}

TEST(ComponentErrors, HotSpindleGrowsRisesAndTiltsAsItShould) {
  TemperatureRise rise{};
  rise[kSpindle] = 5.0;
  EXPECT_NEAR(ThermalError(Component::kSpindleAxial, 0.0, rise),
              kExpansion * 120.0 * 5.0,
              kRounding);
  rise = {};
  rise[kHeadFrontLower] = 2.0;
  rise[kHeadFrontUpper] = 2.0;
  EXPECT_NEAR(ThermalError(Component::kSpindleRadialX, 0.0, rise),
              kExpansion * 574.0 * 2.0,
              kRounding);
  // The front rises, so the axis points up.
  EXPECT_GT(ThermalError(Component::kSpindleTiltXz, 0.0, rise), 0.0);
}

// ---- The tool tip.

TEST(ToolTipError, IsTheSumOfTheComponentsTimesTheirArms) {
  TemperatureRise rise{};
  for (std::size_t i = 0; i < kNumBodies; ++i) {
    rise[i] = 0.3 * static_cast<double>(i * i % 7);
  }
  const double x = -100.0;
  const double z = -300.0;
  const auto length = [&](Component component, double position) {
    return TrueError(component, position, Direction::kForward, rise);
  };
  const auto radians = [&](Component component, double position) {
    return 1e-6 * length(component, position);
  };
  const ToolTipError error =
      ToolTipErrorAt(x, Direction::kForward, z, Direction::kForward, rise);
  // The tip is at X = 286 and Z = 180 mm, 120 mm left of both slides' points.
  const double b_z =
      radians(Component::kZYaw, z) + radians(Component::kOrthogonality, 0.0);
  const double b_x = radians(Component::kXYaw, x);
  const double b_0 = radians(Component::kParallelism, 0.0) -
                     radians(Component::kSpindleTiltXz, 0.0);
  EXPECT_NEAR(error.x,
              length(Component::kXDisplacement, x) +
                  length(Component::kZStraightness, z) -
                  length(Component::kSpindleRadialX, 0.0) + 180.0 * b_0 -
                  120.0 * (b_z + b_x),
              kRounding);
  EXPECT_NEAR(error.z,
              length(Component::kZDisplacement, z) +
                  length(Component::kXStraightness, x) -
                  length(Component::kSpindleAxial, 0.0) - 286.0 * (b_0 + b_z),
              kRounding);
  EXPECT_NEAR(error.y,
              -length(Component::kSpindleRadialY, 0.0) +
                  180.0 * radians(Component::kSpindleTiltYz, 0.0),
              kRounding);
}

// The chain of machine.toml with exact rotations (NISTIR 5367, Eq. 5 and 6).
TEST(ToolTipError, AgreesWithTheProductOfTheMatrices) {
  using Eigen::Affine3d;
  using Eigen::AngleAxisd;
  using Eigen::Translation3d;
  using Eigen::Vector3d;
  const Simulation simulation = Simulate({.days = 2});
  const auto turned = [](double urad) {
    return AngleAxisd(1e-6 * urad, Vector3d::UnitY());
  };
  double worst = 0.0;
  for (const ToolTipPoint& point : simulation.points) {
    const TemperatureRise& rise = simulation.stops[point.stop].rise;
    const auto error = [&](Component component,
                           double position = 0.0,
                           Direction direction = Direction::kForward) {
      return TrueError(component, position, direction, rise);
    };
    const double x = point.x;
    const double z = point.z;
    const Affine3d tool =
        turned(error(Component::kParallelism)) *
        Translation3d(
            error(Component::kZStraightness, z),
            0.0,
            600.0 + z +
                error(Component::kZDisplacement, z, point.z_direction)) *
        turned(error(Component::kZYaw, z)) *
        turned(error(Component::kOrthogonality)) *
        Translation3d(
            386.0 + x + error(Component::kXDisplacement, x, point.x_direction),
            0.0,
            error(Component::kXStraightness, x)) *
        turned(error(Component::kXYaw, x)) * Translation3d(0.0, 0.0, -120.0);
    const Affine3d work =
        Translation3d(error(Component::kSpindleRadialX),
                      error(Component::kSpindleRadialY),
                      error(Component::kSpindleAxial)) *
        AngleAxisd(1e-6 * error(Component::kSpindleTiltYz), Vector3d::UnitX()) *
        turned(error(Component::kSpindleTiltXz));
    const Vector3d nominal(386.0 + x, 0.0, 480.0 + z);
    const Vector3d exact = work.inverse() * tool.translation() - nominal;
    const ToolTipError first_order =
        ToolTipErrorAt(x, point.x_direction, z, point.z_direction, rise);
    const Vector3d sum(first_order.x, first_order.y, first_order.z);
    worst = std::max(worst, (exact - sum).norm());
  }
  // Products of 5e-5 rad with 0.05 mm, and half its square with 600 mm.
  EXPECT_LT(worst, 1e-5);
  EXPECT_GT(worst, 0.0);
}

TEST(ToolTipError, UniformSoakMovesTheTipAwayFromTheNose) {
  const auto soaked = ToolTipErrorAt(
      -100.0, Direction::kForward, -300.0, Direction::kForward, Uniform(4.0));
  const auto cold = ToolTipErrorAt(
      -100.0, Direction::kForward, -300.0, Direction::kForward, Uniform(0.0));
  EXPECT_NEAR(soaked.x - cold.x, kExpansion * 286.0 * 4.0, kRounding);
  // The tool itself is not part of the model: the slide's point counts.
  EXPECT_NEAR(soaked.z - cold.z, kExpansion * 300.0 * 4.0, kRounding);
  EXPECT_NEAR(soaked.y - cold.y, 0.0, kRounding);
}

// ---- Calibration: NISTIR 5367, Appendix B, measured.

TEST(ReportDay, MeetsTheMeasuredSurfaceWithinAMicrometre) {
  const CsvTable table =
      ReadCsv(tests::SourceDir() + "/data/sets/nistir5367_xdisp_down.csv");
  const auto column = [&](const char* name) {
    const auto index = table.Find(name);
    if (index < 0) throw std::runtime_error(name);
    return table.columns[static_cast<std::size_t>(index)].values;
  };
  const std::vector<double> cycles = column("cycle");
  const std::vector<double> positions = column("position_mm");
  const std::vector<double> measured = column("error_mm");
  const Simulation simulation = Simulate({.days = 1, .points_per_day = 0});
  double sum_of_squares = 0.0;
  std::size_t found = 0;
  for (const Stop& stop : simulation.stops) {
    if (stop.sweep != Sweep::kXForward) continue;
    for (std::size_t row = 0; row < measured.size(); ++row) {
      if (cycles[row] != stop.cycle) continue;
      if (std::abs(positions[row] - stop.position()) > 1e-6) continue;
      const double error = TrueError(Component::kXDisplacement,
                                     stop.position(),
                                     Direction::kForward,
                                     stop.rise);
      sum_of_squares += (measured[row] - error) * (measured[row] - error);
      ++found;
    }
  }
  ASSERT_EQ(found, 397U);
  const double rmse_um =
      kUmPerMm * std::sqrt(sum_of_squares / static_cast<double>(found));
  EXPECT_LT(rmse_um, 1.0);
  // What README.md states.
  EXPECT_NEAR(rmse_um, 0.471, 0.0005);
}

}  // namespace
}  // namespace errmap::turning_centre
