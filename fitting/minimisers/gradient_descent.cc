#include "fitting/minimisers/gradient_descent.h"

#include "fitting/minimisers/best_point.h"
#include "stats/require.h"

namespace errmap::fitting {

void GradientDescentOptions::Validate() const {
  stopping.Validate();
  stats::Require(learning_rate > 0.0,
                 "GradientDescentOptions: learning_rate must be above 0",
                 learning_rate);
  stats::Require(
      momentum >= 0.0 && momentum < 1.0,
      "GradientDescentOptions: momentum must be at least 0 and below 1",
      momentum);
}

Minimum GradientDescent::DoMinimize(const Objective& f,
                                    const VectorXd& x0,
                                    const RunControl& run) const {
  BestPoint state(f, x0, options_.stopping, run);
  if (state.Start()) {
    VectorXd step = VectorXd::Zero(x0.size());
    while (!state.monitor.StopAtLimit(state.evaluations, 1)) {
      step = options_.momentum * step -
             options_.learning_rate * state.gradient;  // Eq. (70)
      if (!state.Move(step,
                      "the steps have diverged: the learning rate is too "
                      "large")) {
        break;
      }
    }
  }
  return state.Finish();
}

}  // namespace errmap::fitting
