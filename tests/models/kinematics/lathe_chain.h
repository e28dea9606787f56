#pragma once

// The simulated turning centre as a chain, and its true component errors.

#include <Eigen/Core>

#include "cli/turning_centre/component_errors.h"
#include "cli/turning_centre/simulation.h"
#include "models/kinematics/kinematic_chain.h"

namespace errmap::tests {

/// mm and rad; as machine.toml of the simulator, and in its order of errors.
inline models::KinematicChain LatheChain() {
  using enum models::ErrorDirection;
  using models::Branch;
  using models::Joint;
  return models::KinematicChain({
      {.name = "0Z", .errors = {kB}},
      {.name = "Z",
       .joint = Joint::kLinear,
       .axis = {0.0, 0.0, 1.0},
       .offset = {0.0, 0.0, 600.0},
       .errors = {kZ, kX, kB}},
      {.name = "0X", .errors = {kB}},
      {.name = "X",
       .joint = Joint::kLinear,
       .axis = {1.0, 0.0, 0.0},
       .offset = {386.0, 0.0, 0.0},
       .errors = {kX, kZ, kB}},
      {.name = "tool", .offset = {0.0, 0.0, -120.0}},
      {.name = "0C", .branch = Branch::kWork, .errors = {kZ, kX, kY, kB, kA}},
  });
}

inline Eigen::VectorXd LatheCoordinates(
    const turning_centre::ToolTipPoint& point) {
  return Eigen::VectorXd{{point.z, point.x}};
}

/// In the order of LatheChain().errors(), mm and rad.
inline Eigen::VectorXd TrueLatheErrors(
    const turning_centre::ToolTipPoint& point,
    const turning_centre::TemperatureRise& rise) {
  using turning_centre::Component;
  using turning_centre::Slide;
  constexpr std::array kOrder = {Component::kParallelism,
                                 Component::kZDisplacement,
                                 Component::kZStraightness,
                                 Component::kZYaw,
                                 Component::kOrthogonality,
                                 Component::kXDisplacement,
                                 Component::kXStraightness,
                                 Component::kXYaw,
                                 Component::kSpindleAxial,
                                 Component::kSpindleRadialX,
                                 Component::kSpindleRadialY,
                                 Component::kSpindleTiltXz,
                                 Component::kSpindleTiltYz};
  Eigen::VectorXd errors(kOrder.size());
  Eigen::Index k = 0;
  for (const Component component : kOrder) {
    const auto& traits = turning_centre::TraitsOf(component);
    const bool is_z = traits.slide == Slide::kZ;
    const double error =
        turning_centre::TrueError(component,
                                  is_z ? point.z : point.x,
                                  is_z ? point.z_direction : point.x_direction,
                                  rise);
    errors[k++] = traits.is_angle ? 1e-6 * error : error;
  }
  return errors;
}

}  // namespace errmap::tests
