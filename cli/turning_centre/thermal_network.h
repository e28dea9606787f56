#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace errmap::turning_centre {

/// A lumped body of a thermal network: it has one temperature.
struct ThermalBody {
  std::string name;
  double heat_capacity = 0.0;    // J/K, > 0
  double air_conductance = 0.0;  // W/K to the air around it, >= 0
  /// Added to air_conductance at forced_air = 1 (W/K, >= 0).
  double forced_air_conductance = 0.0;
};

/// Heat path between two bodies.
struct ThermalLink {
  std::size_t a = 0;  // indices of bodies
  std::size_t b = 0;
  double conductance = 0.0;   // W/K, >= 0
  bool only_coolant = false;  // proportional to the coolant flow
};

/// Inputs of the network; constant over a step, except the air.
struct ThermalLoad {
  std::vector<double> heat;  // (bodies) W
  double forced_air = 0.0;   // >= 0
  double coolant = 0.0;      // 0 (off) to 1 (full flow)
};

/// Air temperature at the three times of a step that the classical Runge-Kutta
/// formula needs.
struct AirOfStep {
  double start = 0.0;
  double middle = 0.0;
  double end = 0.0;
};

/// Bodies connected by conductances to each other and to the air:
///
///   C_i dT_i/dt = q_i + G_i (T_air - T_i) + sum_j G_ij (T_j - T_i)
///
/// Plain loops in a fixed order give the same bits on every machine.
class ThermalNetwork {
 public:
  ThermalNetwork(std::vector<ThermalBody> bodies,
                 std::vector<ThermalLink> links)
      : bodies_(std::move(bodies)), links_(std::move(links)) {}

  std::size_t num_bodies() const { return bodies_.size(); }
  const std::vector<ThermalBody>& bodies() const { return bodies_; }
  const std::vector<ThermalLink>& links() const { return links_; }

  /// dT/dt in K/s (bodies) at temperatures T (bodies, degC) and this air.
  void Rate(const std::vector<double>& temperatures,
            double air,
            const ThermalLoad& load,
            std::vector<double>* rate) const;

 private:
  std::vector<ThermalBody> bodies_;
  std::vector<ThermalLink> links_;
};

/// Steps a network in time by the classical Runge-Kutta method of order 4
/// (Hairer, Norsett and Wanner 1993, II.1).
class ThermalIntegrator {
 public:
  explicit ThermalIntegrator(const ThermalNetwork& network);

  /// Moves `temperatures` (bodies) by `seconds`.
  void Step(double seconds,
            const AirOfStep& air,
            const ThermalLoad& load,
            std::vector<double>* temperatures);

 private:
  const ThermalNetwork& network_;
  std::vector<double> stage_;
  std::vector<double> k1_;
  std::vector<double> k2_;
  std::vector<double> k3_;
  std::vector<double> k4_;
};

}  // namespace errmap::turning_centre
