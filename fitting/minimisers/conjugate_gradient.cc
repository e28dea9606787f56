#include "fitting/minimisers/conjugate_gradient.h"

#include <algorithm>
#include <stdexcept>

#include "fitting/minimisers/best_point.h"

namespace errmap::fitting {
namespace {

using Eigen::VectorXd;

// One run; equations are those of section 6.5.
class CgRun {
 public:
  CgRun(const ConjugateGradientOptions& options,
        const Objective& f,
        const VectorXd& x0,
        const RunControl& run)
      : options_(options), state_(f, x0, options.stopping, run) {}

  Minimum Minimize() {
    constexpr std::int64_t kEvaluationsPerPass = 3;
    if (state_.Start()) {
      r_ = -state_.gradient;  // Eq. (89)
      p_ = r_;
      while (!state_.monitor.StopAtLimit(state_.evaluations,
                                         kEvaluationsPerPass) &&
             Pass()) {
      }
    }
    return state_.Finish();
  }

 private:
  bool Pass() {
    double delta = Curvature();
    if (!(delta > 0.0) && steps_since_restart_ > 0) {
      p_ = r_;
      steps_since_restart_ = 0;
      delta = Curvature();
    }
    if (!(delta > 0.0)) {
      state_.monitor.Stop(Termination::kNoDescent,
                          "the curvature along steepest descent is not "
                          "positive: this method has no step there");
      return false;
    }
    const double mu = p_.dot(r_);
    step_ = (mu / delta) * p_;  // Eq. (90), (91)
    if (!state_.Move(
            step_,
            "the objective or its gradient is not finite a step further")) {
      return false;
    }
    ++steps_since_restart_;
    const double overlap = -state_.gradient.dot(r_);
    r_ = -state_.gradient;                        // Eq. (92)
    if (steps_since_restart_ % r_.size() == 0) {  // Eq. (93)
      p_ = r_;
    } else {
      p_ = r_ + ((r_.squaredNorm() - overlap) / mu) * p_;  // Eq. (94)
    }
    return true;
  }

  // p's of Eq. (95).
  double Curvature() {
    const double sigma_k =
        options_.sigma * std::max(1.0, state_.x.norm()) / p_.norm();
    ahead_ = state_.x + sigma_k * p_;
    state_.Evaluate(ahead_, &ahead_gradient_);
    return (ahead_gradient_ - state_.gradient).dot(p_) / sigma_k;
  }

  const ConjugateGradientOptions& options_;
  BestPoint state_;
  VectorXd r_;
  VectorXd p_;
  VectorXd step_;
  VectorXd ahead_;
  VectorXd ahead_gradient_;
  Eigen::Index steps_since_restart_ = 0;
};

}  // namespace

void ConjugateGradientOptions::Validate() const {
  stopping.Validate();
  if (!(sigma > 0.0)) {
    throw std::invalid_argument(
        "ConjugateGradientOptions: sigma must be above 0, found " +
        std::to_string(sigma));
  }
}

ConjugateGradient::ConjugateGradient(ConjugateGradientOptions options)
    : options_(options) {
  options_.Validate();
}

Minimum ConjugateGradient::DoMinimize(const Objective& f,
                                      const VectorXd& x0,
                                      const RunControl& run) const {
  return CgRun(options_, f, x0, run).Minimize();
}

}  // namespace errmap::fitting
