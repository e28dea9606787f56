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

/// The conjugate gradient strategy of NISTIR 5367, section 6.5, before Moller's
/// two devices: curvature by the difference quotient of Eq. 95, step mu / delta
/// unchecked (Eq. 90-91), direction of Eq. 94, steepest descent every n steps.
/// Here to show why the report left it: it trusts a parabola that may be wrong,
/// so that the cost may rise, and it has no step at all where the curvature is
/// not positive along steepest descent. The best point seen is returned.
///
/// Ends as ScaledConjugateGradient does, with kNoDescent where there is no
/// step, the objective is not finite at it, or the gradient is small at a point
/// that is not the best seen.
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
