#pragma once

#include <cstdint>
#include <functional>

#include "fitting/minimisers/optimizer.h"
#include "models/net/net_options.h"
#include "models/net/net_problem.h"

namespace errmap::models {

/// Data of a net's training: scaled inputs (P x I), scaled targets (P x J), row
/// weights (P) or (0), and the initial weights of the net (N).
struct NetTraining {
  NetShape shape;
  MatrixXd inputs;
  MatrixXd targets;
  VectorXd row_weights;
  double wfactor = 0.0;
  VectorXd initial_weights;
  std::uint64_t seed = 1;  // for methods that draw at random
};

/// A method that minimises a net's objective; empty: none.
using NetTrainer = std::function<fitting::Minimum(
    const NetTraining& training, const fitting::RunControl& run)>;

/// Returns the trainer of `method` with these stopping rules.
NetTrainer MakeNetTrainer(const NetMethod& method,
                          const fitting::StoppingRules& stopping);

}  // namespace errmap::models
