#include "fitting/minimisers/conjugate_gradient.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fitting/minimisers/best_point.h"
#include "fitting/minimisers/cost_resolution.h"
#include "stats/require.h"

namespace errmap::fitting {
namespace {

// One run; equations are those of section 6.5.
class CgRun {
 public:
  CgRun(const ConjugateGradientOptions& options,
        const Objective& f,
        const VectorXd& x0,
        const RunControl& run)
      : options_(options), f_(f), state_(f, x0, options.stopping, run) {}

  Minimum Minimize() {
    constexpr std::int64_t kQuotientAndTrial = 2;
    if (state_.Start()) {
      r_ = -state_.gradient;  // Eq. (89)
      p_ = r_;
      while (
          !state_.monitor.StopAtLimit(state_.evaluations, kQuotientAndTrial) &&
          Pass()) {
      }
    }
    return state_.Finish();
  }

 private:
  // A point of the line search, x + alpha p.
  struct Trial {
    double alpha = 0.0;
    double cost = 0.0;
    double slope = 0.0;  // along p
  };

  // Returns false if the run has ended.
  bool Pass() {
    mu_ = p_.dot(r_);
    if (!Search(FirstLength())) return Restart();
    last_length_ = lowest_.alpha * p_.norm();
    const bool goes_on = state_.MoveTo(&lowest_x_, lowest_.cost, &lowest_g_);
    if (!goes_on || state_.monitor.stopped()) return false;
    ++steps_since_restart_;
    const double overlap = -state_.gradient.dot(r_);
    r_ = -state_.gradient;  // Eq. (92)
    // Eq. (94), but never back along p (Powell 1984); Eq. (93).
    const double beta = std::max(0.0, (r_.squaredNorm() - overlap) / mu_);
    p_ = r_ + beta * p_;
    if (steps_since_restart_ % r_.size() == 0 || !(p_.dot(r_) > 0.0)) {
      StartAnew();
    }
    return true;
  }

  void StartAnew() {
    p_ = r_;
    steps_since_restart_ = 0;
  }

  // No step along p lowers the cost: steepest descent, or the end.
  bool Restart() {
    if (state_.monitor.stopped()) return false;
    if (steps_since_restart_ > 0) {
      StartAnew();
      return true;
    }
    const auto spend = [&] {
      if (state_.monitor.StopAtLimit(state_.evaluations, 1)) return false;
      ++state_.evaluations;
      return true;
    };
    StopWithoutDescent(f_,
                       state_.x,
                       spend,
                       "no step along steepest descent lowers the cost",
                       &state_.monitor);
    return false;
  }

  // Returns the minimum of the parabola, Eq. (90), (91), with p's of Eq. (95).
  // If that curves down, returns about the length of the last step.
  double FirstLength() {
    const double sigma_k =
        options_.sigma * std::max(1.0, state_.x.norm()) / p_.norm();
    trial_x_ = state_.x + sigma_k * p_;
    state_.Evaluate(trial_x_, &trial_g_);
    const double delta = (trial_g_ - state_.gradient).dot(p_) / sigma_k;
    const double length = mu_ / delta;
    if (delta > 0.0 && std::isfinite(length) && length > 0.0) return length;
    const double unit = last_length_ > 0.0 ? last_length_ : 1.0;
    return unit / p_.norm();
  }

  // Searches along p, from a first length, for a point with Wolfe's strong
  // conditions (Nocedal and Wright 2006, algorithms 3.5 and 3.6). `lowest_` is
  // that point, or the lowest found. Returns false if none is below x.
  bool Search(double length) {
    constexpr int kMostTrials = 40;
    lowest_ = {0.0, state_.cost, -mu_};
    other_.reset();
    for (int trial = 0; trial < kMostTrials; ++trial) {
      if (state_.monitor.StopAtLimit(state_.evaluations, 1)) break;
      if (IsEnough(Look(length))) return true;
      const double next = NextLength();
      if (!std::isfinite(next) || next == length) break;
      length = next;
    }
    return lowest_.alpha > 0.0;
  }

  Trial Look(double alpha) {
    trial_x_ = state_.x + alpha * p_;
    const double cost = state_.Evaluate(trial_x_, &trial_g_);
    const bool is_feasible = std::isfinite(cost) && trial_g_.allFinite();
    return {alpha,
            is_feasible ? cost : std::numeric_limits<double>::infinity(),
            trial_g_.dot(p_)};
  }

  // Adds the trial to the bracket; returns true if it ends the search.
  bool IsEnough(const Trial& trial) {
    constexpr double kFall = 1e-4;
    constexpr double kSlope = 0.3;
    const bool is_flat = std::abs(trial.slope) <= kSlope * mu_;
    const bool falls = trial.cost < lowest_.cost &&
                       trial.cost <= state_.cost - kFall * mu_ * trial.alpha;
    // If rounding hides the fall of the cost, the gradient still shows it.
    const bool stands = trial.cost <= state_.cost && lowest_.alpha == 0.0 &&
                        trial_g_.norm() < state_.gradient_norm;
    if (!falls && !(stands && is_flat)) {
      other_ = trial;
      return false;
    }
    const bool lies_behind = trial.slope * (trial.alpha - lowest_.alpha) >= 0.0;
    if (lies_behind) other_ = lowest_;
    lowest_ = trial;
    lowest_x_.swap(trial_x_);
    lowest_g_.swap(trial_g_);
    return is_flat;
  }

  double NextLength() const {
    if (!other_) {  // still going down
      constexpr double kGrowth = 4.0;
      return kGrowth * lowest_.alpha;
    }
    constexpr double kWithin = 0.1;  // of the bracket, from either end
    const double width = other_->alpha - lowest_.alpha;
    double share = 0.25;  // nothing is known where the other end is infeasible
    if (std::isfinite(other_->cost)) {
      // The parabola through the cost and slope at the lowest and the other's
      // cost has its minimum there.
      const double fall = lowest_.slope * width;
      const double share_of_parabola =
          -fall / (2.0 * (other_->cost - lowest_.cost - fall));
      share = std::isfinite(share_of_parabola) ? share_of_parabola : 0.5;
      share = std::clamp(share, kWithin, 1.0 - kWithin);
    }
    return lowest_.alpha + share * width;
  }

  const ConjugateGradientOptions& options_;
  const Objective& f_;
  BestPoint state_;
  VectorXd r_;  // steepest descent
  VectorXd p_;  // direction
  double mu_ = 0.0;
  double last_length_ = 0.0;  // of the last step
  Trial lowest_;
  std::optional<Trial> other_;  // the other end of the bracket
  VectorXd lowest_x_;
  VectorXd lowest_g_;
  VectorXd trial_x_;
  VectorXd trial_g_;
  Index steps_since_restart_ = 0;
};

}  // namespace

void ConjugateGradientOptions::Validate() const {
  stopping.Validate();
  stats::Require(
      sigma > 0.0, "ConjugateGradientOptions: sigma must be above 0", sigma);
}

Minimum ConjugateGradient::DoMinimize(const Objective& f,
                                      const VectorXd& x0,
                                      const RunControl& run) const {
  return CgRun(options_, f, x0, run).Minimize();
}

}  // namespace errmap::fitting
