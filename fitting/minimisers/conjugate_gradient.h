#pragma once

#include <string>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

struct ConjugateGradientOptions {
  StoppingRules stopping = {};
  /// Step of the difference quotient: sigma max(1, |w|) / |p|; above 0. The
  /// square root of the rounding unit balances truncation and rounding errors.
  double sigma = 1.5e-8;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Conjugate gradients of NISTIR 5367, section 6.5, without Moller's two
/// additions: curvature by the difference quotient of Eq. 95, direction of Eq.
/// 94, steepest descent every n steps. The report takes the step mu / delta
/// (Eq. 90-91) unchecked, and defines none if the curvature is not positive.
/// Here it is the first trial of a line search for the strong Wolfe conditions,
/// so the cost never rises. If the search finds no lower cost, steepest descent
/// replaces the direction. Each trial evaluates cost and gradient.
///
/// Ends like kMoller of ScaledConjugateGradient.
class ConjugateGradient final : public OptimizerWith<ConjugateGradientOptions> {
 public:
  explicit ConjugateGradient(ConjugateGradientOptions options)
      : OptimizerWith(options) {}

  std::string name() const override { return "cg"; }

 private:
  Minimum DoMinimize(const Objective& f,
                     const VectorXd& x0,
                     const RunControl& run) const override;
};

}  // namespace errmap::fitting
