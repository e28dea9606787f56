#pragma once

#include <Eigen/Core>

#include "models/net/feedforward_net.h"
#include "models/net/net_objective.h"
#include "models/scaling.h"
#include "tests/models/golden_netcg.h"

namespace errmap::testing {

inline constexpr double kRun3Wfactor = 1.3e-3;

/// The size of the report's run 3: a 37-60-1 net (2341 weights) on 397
/// patterns, the simulated temperatures of tests/golden/netcg, every input
/// standardised.
struct Run3 {
  models::NetShape shape;
  Eigen::MatrixXd inputs;   // (397 x 37)
  Eigen::MatrixXd targets;  // (397 x 1)

  template <typename Scalar>
  models::BasicNetObjective<Scalar> Objective() const {
    return {shape, inputs, targets, kRun3Wfactor};
  }
};

inline const Run3& TheRun3() {
  static const Run3 run = [] {
    const GoldenCase golden = ReadGoldenCase("case_a");
    const auto scaling = models::StandardScaling(golden.inputs);
    constexpr Eigen::Index kHidden = 60;
    return Run3{{golden.shape.inputs, kHidden, 1},
                scaling.Apply(golden.inputs),
                golden.scaled_targets};
  }();
  return run;
}

}  // namespace errmap::testing
