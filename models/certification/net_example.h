#pragma once

#include <string>
#include <vector>

#include "models/net/net_objective.h"
#include "stats/eigen.h"

namespace errmap::models {

/// A net on synthetic patterns, so that every installation can fit it.
struct NetExampleShape {
  std::string name;  // "net 3-5-1, sigmoid output"
  NetShape shape;
  Index patterns = 0;
  double wfactor = 0.0;
};

/// Returns shapes that reach every branch: either output, several outputs, a
/// slope, few and many hidden nodes.
const std::vector<NetExampleShape>& NetExampleShapes();

/// Returns the well-damped net of CertifyAgreement: large wfactor, one minimum.
NetExampleShape DampedNetExample();

/// Return inputs (P x I) on a low-discrepancy grid in [-1, 1], and targets (P x
/// J) in 0.2 to 0.8, a smooth function of them.
MatrixXd ExampleInputs(const NetExampleShape& example);
MatrixXd ExampleTargets(const NetExampleShape& example);

/// Returns E(w) of a net on these patterns.
NetObjective MakeNetExample(const NetExampleShape& example);

}  // namespace errmap::models
