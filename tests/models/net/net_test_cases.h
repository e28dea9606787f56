#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fitting/minimisers/gradient_check.h"
#include "models/net/net_objective.h"
#include "tests/random_matrix.h"

namespace errmap::testing {

/// A net with random patterns, and how it is worked out.
struct NetCase {
  models::NetShape shape;
  Eigen::Index patterns = 1;
  bool weighted = false;
  models::NetArithmetic arithmetic = models::NetArithmetic::kFast;

  template <typename Scalar>
  models::BasicNetObjective<Scalar> Objective() const {
    Eigen::VectorXd weights;
    if (weighted) {
      weights = RandomMatrix(patterns, 1, 5).cwiseAbs().array() + 0.1;
    }
    return {shape,
            RandomMatrix(patterns, shape.inputs, 1),
            RandomMatrix(patterns, shape.outputs, 2).cwiseAbs(),
            1e-2,
            weights,
            arithmetic};
  }

  /// A point and a direction (N), exact in either precision.
  Eigen::VectorXd Point() const { return Rounded(3); }
  Eigen::VectorXd Direction() const { return Rounded(4); }

  /// Names the case in a test's name.
  std::string Name() const {
    std::string name =
        std::to_string(shape.inputs) + "x" + std::to_string(shape.hidden) +
        "x" + std::to_string(shape.outputs) + "Over" + std::to_string(patterns);
    name += shape.output == models::OutputFunction::kLinear ? "Linear" : "";
    name += shape.slope != 1.0 ? "Steep" : "";
    name += weighted ? "Weighted" : "";
    name += shape.free_biases ? "FreeBiases" : "";
    name += arithmetic == models::NetArithmetic::kPlain ? "Plain" : "";
    return name;
  }

 private:
  Eigen::VectorXd Rounded(std::uint64_t seed) const {
    return RandomMatrix(shape.num_weights(), 1, seed)
        .cast<float>()
        .cast<double>();
  }
};

inline void PrintTo(const NetCase& net, std::ostream* out) {
  *out << net.Name();
}

/// Nets from one pattern and one node of each kind to several blocks of
/// patterns, each in both arithmetics.
inline std::vector<NetCase> ManyNets() {
  constexpr auto kSigmoid = models::OutputFunction::kSigmoid;
  constexpr auto kLinear = models::OutputFunction::kLinear;
  const std::vector<NetCase> nets = {
      {{1, 1, 1, kSigmoid}, 1},
      {{1, 1, 1, kLinear, 2.0}, 2, true},
      {{3, 4, 2, kSigmoid}, 12},
      {{3, 4, 2, kLinear}, 12},
      {{3, 4, 2, kSigmoid, 2.5}, 12},
      {{3, 4, 2, kLinear, 0.3}, 12},
      {{5, 7, 3, kSigmoid}, 40, true},
      {{4, 8, 1, kSigmoid}, 25},
      {{2, 17, 4, kLinear, 1.5}, 33, true},
      {{2, 3, 1, kLinear}, 700, true},
      {{2, 5, 2, kSigmoid, 0.7}, 9000, true},  // more than a block
  };
  std::vector<NetCase> all;
  for (NetCase net : nets) {
    for (const auto arithmetic :
         {models::NetArithmetic::kFast, models::NetArithmetic::kPlain}) {
      net.arithmetic = arithmetic;
      all.push_back(net);
    }
  }
  return all;
}

/// These, and some whose biases bear no decay.
inline std::vector<NetCase> WithFreeBiases(std::vector<NetCase> nets) {
  for (NetCase net : ManyNets()) {
    if (net.shape.hidden < 4) continue;
    net.shape.free_biases = true;
    nets.push_back(net);
  }
  return nets;
}

/// p'Hp at w as a derivative by Ridders: of g'p along w + a p.
inline double RiddersCurvature(const fitting::Objective& f,
                               const Eigen::VectorXd& w,
                               const Eigen::VectorXd& p) {
  Eigen::VectorXd gradient;
  return fitting::RiddersDerivative(
             [&](double a) {
               f.Evaluate(w + a * p, &gradient);
               return gradient.dot(p);
             },
             0.0,
             0.1)
      .value;
}

}  // namespace errmap::testing
