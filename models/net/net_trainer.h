#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fitting/minimisers/optimizer.h"
#include "models/error_model.h"
#include "models/model_spec.h"
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
  virtual std::vector<EffectiveOption> options() const = 0;
};

/// "net:scg", "net:lm", "net:cg", "net:backprop", "net:ceres", "net:nlopt".
const std::vector<std::string>& NetTypes();

/// When a model of NetTypes() stops unless told otherwise.
fitting::StoppingRules DefaultStoppingRules(const std::string& type);

/// The trainer of a model of NetTypes(), with its own options taken from
/// `options`; throws std::invalid_argument where they are out of range.
std::unique_ptr<NetTrainer> MakeNetTrainer(
    const std::string& type,
    const fitting::StoppingRules& stopping,
    SpecOptions* options);

}  // namespace errmap::models
