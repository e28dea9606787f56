#pragma once

#include <string>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

struct ConjugateGradientOptions {
  StoppingRules stopping = {};
  /// The difference quotient's step is sigma max(1, |w|) / |p|; above 0. The
  /// square root of the rounding unit balances truncation against rounding.
  double sigma = 1.5e-8;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// The conjugate gradients of NISTIR 5367, section 6.5, before Moller's two
/// devices: curvature by the difference quotient of Eq. 95, direction of Eq.
/// 94, steepest descent every n steps. The report takes the step mu / delta
/// (Eq. 90-91) unchecked, and has none where the curvature is not positive;
/// here it is the first trial of a line search for Wolfe's strong conditions,
/// so that the cost never rises. A direction along which nothing is lower is
/// given up for steepest descent. Each trial is a cost with its gradient.
///
/// Ends as kMoller of ScaledConjugateGradient does.
class ConjugateGradient final : public Optimizer {
 public:
  /// Throws std::invalid_argument where the options are out of range.
  explicit ConjugateGradient(ConjugateGradientOptions options);

  std::string name() const override { return "cg"; }

 private:
  Minimum DoMinimize(const Objective& f,
                     const Eigen::VectorXd& x0,
                     const RunControl& run) const override;

  ConjugateGradientOptions options_;
};

}  // namespace errmap::fitting
