#pragma once

#include <cstdint>
#include <memory>

#include "fitting/minimisers/optimizer.h"
#include "models/net/net_options.h"
#include "models/net/net_problem.h"

namespace errmap::models {

/// What a net is fitted to: scaled inputs (P x I), scaled targets (P x J),
/// weights of the rows (P) or (0), and the initial weights of the net (N).
struct NetTraining {
  NetShape shape;
  Eigen::MatrixXd inputs;
  Eigen::MatrixXd targets;
  Eigen::VectorXd row_weights;
  double wfactor = 0.0;
  Eigen::VectorXd initial_weights;
  std::uint64_t seed = 1;  // of a method that draws at random
};

/// One way of minimising a net's objective; immutable.
class NetTrainer {
 public:
  virtual ~NetTrainer() = default;
  virtual fitting::Minimum Train(const NetTraining& training,
                                 const fitting::RunControl& run) const = 0;
};

/// The trainer of a method that stops by these rules.
std::unique_ptr<NetTrainer> MakeNetTrainer(
    const NetMethod& method, const fitting::StoppingRules& stopping);

}  // namespace errmap::models
