#include "cli/turning_centre/thermal_network.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/turning_centre/thermal_balance.h"

namespace errmap::turning_centre {
namespace {

// A heated body, one behind it and one that is only joined by coolant.
ThermalNetwork Chain(double air_conductance = 2.0) {
  return {{{.name = "a", .heat_capacity = 500.0},
           {.name = "b",
            .heat_capacity = 2000.0,
            .air_conductance = air_conductance,
            .forced_air_conductance = 1.0},
           {.name = "c", .heat_capacity = 3000.0, .air_conductance = 1.0}},
          {{.a = 0, .b = 1, .conductance = 4.0},
           {.a = 1, .b = 2, .conductance = 3.0, .only_coolant = true}}};
}

void Integrate(const ThermalNetwork& network,
               double step,
               int steps,
               double air,
               const ThermalLoad& load,
               std::vector<double>* temperatures) {
  ThermalIntegrator integrator(network);
  for (int i = 0; i < steps; ++i) {
    integrator.Step(step, {air, air, air}, load, temperatures);
  }
}

TEST(ThermalNetwork, StaysAtRestAtTheTemperatureOfTheAir) {
  const ThermalNetwork network = Chain();
  std::vector<double> t(3, 23.25);
  Integrate(network, 5.0, 1000, 23.25, {.heat = {0.0, 0.0, 0.0}}, &t);
  EXPECT_THAT(t, ::testing::Each(23.25));
}

TEST(ThermalNetwork, ReachesTheSolutionOfItsLinearSystem) {
  const ThermalNetwork network = Chain();
  const ThermalLoad load{
      .heat = {60.0, 0.0, -5.0}, .forced_air = 0.5, .coolant = 0.25};
  std::vector<double> t(3, 20.0);
  Integrate(network, 10.0, 20000, 21.0, load, &t);
  const std::vector<double> steady = SteadyState(network, 21.0, load);
  // By hand: heat 60 W passes 4 W/K from a to b; b loses 2.5 W/K to the air
  // and 0.75 W/K to c, which loses 1 W/K to the air and 5 W besides.
  const double c_per_b = 0.75 / 1.75;
  const double c_own = -5.0 / 1.75;
  const double b = (60.0 + 0.75 * c_own) / (2.5 + 0.75 * (1.0 - c_per_b));
  EXPECT_NEAR(steady[1], 21.0 + b, 1e-10);
  EXPECT_NEAR(steady[0], 21.0 + b + 15.0, 1e-10);
  EXPECT_NEAR(steady[2], 21.0 + c_per_b * b + c_own, 1e-10);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(t[i], steady[i], 1e-9);
}

TEST(ThermalNetwork, FollowsTheExponentialOfASingleBody) {
  const ThermalNetwork network(
      {{.name = "a", .heat_capacity = 600.0, .air_conductance = 2.0}}, {});
  std::vector<double> t{30.0};
  Integrate(network, 5.0, 120, 20.0, {.heat = {0.0}}, &t);
  // 600 s are two time constants. Order 4: (5/300)^4 / 120 of the change.
  EXPECT_NEAR(t[0], 20.0 + 10.0 * std::exp(-2.0), 3e-8);
}

TEST(ThermalNetwork, HalvingTheStepDividesTheErrorBySixteen) {
  const ThermalNetwork network = Chain();
  const ThermalLoad load{.heat = {60.0, 0.0, 0.0}, .coolant = 1.0};
  const auto end = [&](double step) {
    std::vector<double> t(3, 20.0);
    Integrate(network, step, static_cast<int>(800.0 / step), 20.0, load, &t);
    return t[0];
  };
  const double fine = end(0.5);
  const double ratio = (end(80.0) - fine) / (end(40.0) - fine);
  EXPECT_GT(ratio, 12.0);
  EXPECT_LT(ratio, 22.0);
}

TEST(ThermalNetwork, KeepsTheHeatOfAClosedMachine) {
  const ThermalNetwork network({{.name = "a", .heat_capacity = 500.0},
                                {.name = "b", .heat_capacity = 2000.0}},
                               {{.a = 0, .b = 1, .conductance = 4.0}});
  std::vector<double> t{20.0, 35.0};
  const double before = StoredHeat(network, t);
  Integrate(network, 5.0, 2000, 0.0, {.heat = {30.0, -10.0}}, &t);
  const double added = 20.0 * 5.0 * 2000;
  // Rounding alone: 2000 steps of a sum near 1e5 J.
  EXPECT_NEAR(StoredHeat(network, t), before + added, 1e-8 * added);
}

TEST(ThermalNetwork, StoresWhatIsHeatedLessWhatTheAirTakes) {
  const ThermalNetwork network = Chain();
  const ThermalLoad load{.heat = {60.0, 0.0, 0.0}, .coolant = 1.0};
  std::vector<double> t(3, 20.0);
  const double before = StoredHeat(network, t);
  ThermalIntegrator integrator(network);
  constexpr double kStep = 5.0;
  constexpr int kSteps = 720;
  // Simpson's rule over pairs of steps for what flows from the air.
  double from_air = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double weight =
        i == 0 || i == kSteps ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    from_air += weight * kStep / 3.0 * HeatFromAir(network, t, 20.0, load);
    if (i < kSteps) integrator.Step(kStep, {20.0, 20.0, 20.0}, load, &t);
  }
  const double heated = 60.0 * kStep * kSteps;
  EXPECT_LT(from_air, -0.1 * heated);
  EXPECT_NEAR(
      StoredHeat(network, t) - before, heated + from_air, 1e-6 * heated);
}

}  // namespace
}  // namespace errmap::turning_centre
