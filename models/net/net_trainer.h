#pragma once

#include <cstdint>
#include <memory>

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

/// A method to minimise a net's objective; immutable.
class NetTrainer {
 public:
  virtual ~NetTrainer() = default;
  virtual fitting::Minimum Train(const NetTraining& training,
                                 const fitting::RunControl& run) const = 0;
};

/// Returns the trainer of `method` with these stopping rules.
std::unique_ptr<NetTrainer> MakeNetTrainer(
    const NetMethod& method, const fitting::StoppingRules& stopping);

}  // namespace errmap::models
