#pragma once

#include <string>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

struct GradientDescentOptions {
  StoppingRules stopping = {};
  /// eta of Eq. 68-70; above 0. Too large a rate oscillates or diverges.
  double learning_rate = 1.0;
  /// alpha of Eq. 70: share of the previous step that is added; in [0, 1).
  double momentum = 0.9;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Steepest descent at a constant rate with momentum, the usual "back
/// propagation" (NISTIR 5367, section 6.4): x += -eta g + alpha (last step).
/// Included to show why the report abandoned it. The cost may rise; the result
/// is the best point found.
///
/// Ends like ScaledConjugateGradient. Ends with kNoDescent if a step makes the
/// objective infinite or NaN, or if the gradient is small at a point that is
/// not the best found.
class GradientDescent final : public OptimizerWith<GradientDescentOptions> {
 public:
  explicit GradientDescent(GradientDescentOptions options)
      : OptimizerWith(options) {}

  std::string name() const override { return "backprop"; }

 private:
  Minimum DoMinimize(const Objective& f,
                     const VectorXd& x0,
                     const RunControl& run) const override;
};

}  // namespace errmap::fitting
