#include "data/turning_centre/thermal_network.h"

#include <cassert>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <Eigen/LU>

namespace errmap::data::turning_centre {
namespace {

[[noreturn]] void RefuseNetwork(const std::string& what) {
  throw std::invalid_argument("ThermalNetwork: " + what);
}

void CheckConductance(const std::string& where, double value) {
  if (std::isfinite(value) && value >= 0.0) return;
  RefuseNetwork(where + ": conductance " + std::to_string(value) +
                " W/K; it must be finite and not negative");
}

}  // namespace

ThermalNetwork::ThermalNetwork(std::vector<ThermalBody> bodies,
                               std::vector<ThermalLink> links)
    : bodies_(std::move(bodies)), links_(std::move(links)) {
  if (bodies_.empty()) RefuseNetwork("no bodies");
  for (const ThermalBody& body : bodies_) {
    if (!std::isfinite(body.heat_capacity) || body.heat_capacity <= 0.0) {
      RefuseNetwork("body '" + body.name + "': heat capacity " +
                    std::to_string(body.heat_capacity) +
                    " J/K; it must be finite and positive");
    }
    CheckConductance("body '" + body.name + "' to the air",
                     body.air_conductance);
    CheckConductance("body '" + body.name + "' to forced air",
                     body.forced_air_conductance);
  }
  for (const ThermalLink& link : links_) {
    if (link.a >= bodies_.size() || link.b >= bodies_.size() ||
        link.a == link.b) {
      RefuseNetwork("link " + std::to_string(link.a) + " - " +
                    std::to_string(link.b) + " does not join two of the " +
                    std::to_string(bodies_.size()) + " bodies");
    }
    CheckConductance(
        "link '" + bodies_[link.a].name + "' - '" + bodies_[link.b].name + "'",
        link.conductance);
  }
}

double ThermalNetwork::AirConductance(std::size_t body,
                                      const ThermalLoad& load) const {
  return bodies_[body].air_conductance +
         load.forced_air * bodies_[body].forced_air_conductance;
}

void ThermalNetwork::Rate(const std::vector<double>& temperatures,
                          double air,
                          const ThermalLoad& load,
                          std::vector<double>* rate) const {
  assert(temperatures.size() == bodies_.size());
  assert(load.heat.size() == bodies_.size());
  assert(rate->size() == bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    (*rate)[i] =
        load.heat[i] + AirConductance(i, load) * (air - temperatures[i]);
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

double ThermalNetwork::StoredHeat(
    const std::vector<double>& temperatures) const {
  double heat = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    heat += bodies_[i].heat_capacity * temperatures[i];
  }
  return heat;
}

double ThermalNetwork::HeatFromAir(const std::vector<double>& temperatures,
                                   double air,
                                   const ThermalLoad& load) const {
  double flow = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    flow += AirConductance(i, load) * (air - temperatures[i]);
  }
  return flow;
}

Eigen::MatrixXd ThermalNetwork::ConductanceMatrix(
    const ThermalLoad& load) const {
  const auto size = static_cast<Eigen::Index>(bodies_.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    matrix(row, row) = AirConductance(i, load);
  }
  for (const ThermalLink& link : links_) {
    const double conductance =
        link.only_coolant ? load.coolant * link.conductance : link.conductance;
    const auto a = static_cast<Eigen::Index>(link.a);
    const auto b = static_cast<Eigen::Index>(link.b);
    matrix(a, a) += conductance;
    matrix(b, b) += conductance;
    matrix(a, b) -= conductance;
    matrix(b, a) -= conductance;
  }
  return matrix;
}

std::vector<double> ThermalNetwork::SteadyState(double air,
                                                const ThermalLoad& load) const {
  const Eigen::MatrixXd matrix = ConductanceMatrix(load);
  Eigen::VectorXd inflow(matrix.rows());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    inflow[static_cast<Eigen::Index>(i)] =
        load.heat[i] + AirConductance(i, load) * air;
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(matrix);
  if (!lu.isInvertible()) {
    RefuseNetwork("no steady state: some body has no heat path to the air");
  }
  const Eigen::VectorXd solution = lu.solve(inflow);
  return {solution.data(), solution.data() + solution.size()};
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

}  // namespace errmap::data::turning_centre
