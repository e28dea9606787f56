#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/LU>

#include "cli/turning_centre/thermal_network.h"

// What a network must come to, worked out without stepping it in time.

namespace errmap::turning_centre {

/// Heat content above 0 degC, J.
inline double StoredHeat(const ThermalNetwork& network,
                         const std::vector<double>& temperatures) {
  double heat = 0.0;
  for (std::size_t i = 0; i < network.num_bodies(); ++i) {
    heat += network.bodies()[i].heat_capacity * temperatures[i];
  }
  return heat;
}

/// Heat that flows from the air into all bodies, W.
inline double HeatFromAir(const ThermalNetwork& network,
                          const std::vector<double>& temperatures,
                          double air,
                          const ThermalLoad& load) {
  double flow = 0.0;
  for (std::size_t i = 0; i < network.num_bodies(); ++i) {
    const ThermalBody& body = network.bodies()[i];
    flow +=
        (body.air_conductance + load.forced_air * body.forced_air_conductance) *
        (air - temperatures[i]);
  }
  return flow;
}

/// Temperatures (bodies) after infinite time: where the rates, which are linear
/// in the temperatures, are 0.
inline std::vector<double> SteadyState(const ThermalNetwork& network,
                                       double air,
                                       const ThermalLoad& load) {
  const std::size_t size = network.num_bodies();
  const auto rate_at = [&](const std::vector<double>& t) {
    std::vector<double> rate(size);
    network.Rate(t, air, load, &rate);
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(rate.data(), std::ssize(rate)));
  };
  const Eigen::VectorXd at_zero = rate_at(std::vector<double>(size, 0.0));
  Eigen::MatrixXd slopes(at_zero.size(), at_zero.size());
  for (std::size_t i = 0; i < size; ++i) {
    std::vector<double> t(size, 0.0);
    t[i] = 1.0;
    slopes.col(static_cast<Eigen::Index>(i)) = rate_at(t) - at_zero;
  }
  const Eigen::VectorXd steady = slopes.fullPivLu().solve(-at_zero);
  return {steady.data(), steady.data() + steady.size()};
}

}  // namespace errmap::turning_centre
