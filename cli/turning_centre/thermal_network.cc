#include "cli/turning_centre/thermal_network.h"

#include <cassert>

namespace errmap::turning_centre {
void ThermalNetwork::Rate(const std::vector<double>& temperatures,
                          double air,
                          const ThermalLoad& load,
                          std::vector<double>* rate) const {
  assert(temperatures.size() == bodies_.size());
  assert(load.heat.size() == bodies_.size());
  assert(rate->size() == bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const double to_air = bodies_[i].air_conductance +
                          load.forced_air * bodies_[i].forced_air_conductance;
    (*rate)[i] = load.heat[i] + to_air * (air - temperatures[i]);
  }
  for (const ThermalLink& link : links_) {
    const double conductance =
        link.only_coolant ? load.coolant * link.conductance : link.conductance;
    const double flow =
        conductance * (temperatures[link.a] - temperatures[link.b]);
    (*rate)[link.a] -= flow;
    (*rate)[link.b] += flow;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    (*rate)[i] /= bodies_[i].heat_capacity;
  }
}

ThermalIntegrator::ThermalIntegrator(const ThermalNetwork& network)
    : network_(network),
      stage_(network.num_bodies()),
      k1_(network.num_bodies()),
      k2_(network.num_bodies()),
      k3_(network.num_bodies()),
      k4_(network.num_bodies()) {}

void ThermalIntegrator::Step(double seconds,
                             const AirOfStep& air,
                             const ThermalLoad& load,
                             std::vector<double>* temperatures) {
  std::vector<double>& t = *temperatures;
  const auto move_along = [&](const std::vector<double>& slope, double by) {
    for (std::size_t i = 0; i < t.size(); ++i) stage_[i] = t[i] + by * slope[i];
  };
  network_.Rate(t, air.start, load, &k1_);
  move_along(k1_, 0.5 * seconds);
  network_.Rate(stage_, air.middle, load, &k2_);
  move_along(k2_, 0.5 * seconds);
  network_.Rate(stage_, air.middle, load, &k3_);
  move_along(k3_, seconds);
  network_.Rate(stage_, air.end, load, &k4_);
  for (std::size_t i = 0; i < t.size(); ++i) {
    t[i] += seconds / 6.0 * (k1_[i] + 2.0 * (k2_[i] + k3_[i]) + k4_[i]);
  }
}

}  // namespace errmap::turning_centre
