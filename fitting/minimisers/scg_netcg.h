#pragma once

#include <cmath>
#include <limits>

#include "fitting/minimisers/ordered_sums.h"
#include "fitting/minimisers/run_monitor.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"

namespace errmap::fitting {

/// One run of ScgVariant::kNetcg. Members have the symbols, and steps the
/// numbers, of section 6.5. Scalars are kept in the precision of the vectors,
/// as the program does.
template <typename Scalar>
class NetcgRun {
 public:
  using Vector = VectorOf<Scalar>;

  NetcgRun(const ScaledConjugateGradientOptions& options,
           const BasicObjective<Scalar>& f,
           const Vector& x0,
           const RunControl& run)
      : options_(options),
        f_(f),
        monitor_(options.stopping, run),
        w_(x0),
        trial_(x0.size()),
        gradient_(x0.size()),
        s_(x0.size()) {}

  Minimum Minimize() {
    if (Start()) {
      constexpr std::int64_t kEvaluationsPerPass = 2;
      while (!monitor_.stopped() &&
             !monitor_.StopAtLimit(evaluations_, kEvaluationsPerPass)) {
        Pass();
      }
    }
    return {w_.template cast<double>(), monitor_.Finish(cost_, r_.norm())};
  }

 private:
  Scalar Evaluate(const Vector& x, Vector* gradient) {
    ++evaluations_;
    return f_.Evaluate(x, gradient);
  }

  // Step 1. Returns false if there is nothing to do.
  bool Start() {
    cost_ = Evaluate(w_, &gradient_);
    r_ = -gradient_;
    gm_ = r_;
    p_ = r_;
    r_norm_ = OrderedNorm(r_);
    w_norm_ = OrderedNorm(w_);
    lambda_ = static_cast<Scalar>(options_.initial_lambda);
    return monitor_.Begin(cost_, r_.norm()) &&
           !monitor_.StopAtGoal(cost_, r_norm_, w_norm_);
  }

  void Pass() {
    ScgPass report;
    report.pass = ++pass_;
    ++steps_since_restart_;
    p_norm_ = OrderedNorm(p_);
    const Scalar p_squared = p_norm_ * p_norm_;
    if (accepted_) EstimateCurvature();  // step 2

    // Step 3: scale. After a failure only the growth of lambda is added.
    delta_ += (lambda_ - lambda_bar_) * p_squared;
    // Step 4: make the estimate positive definite.
    if (delta_ <= 0.0) {
      report.made_definite = true;
      lambda_bar_ = Scalar(2) * (lambda_ - delta_ / p_squared);
      delta_ = -delta_ + lambda_ * p_squared;
      lambda_ = lambda_bar_;
    }
    // Step 5: step length.
    mu_ = OrderedDot(p_, r_);
    const Scalar alpha = mu_ / delta_;
    trial_ = w_ + alpha * p_;
    const Scalar trial_cost = Evaluate(trial_, &gradient_);
    // Step 6: comparison parameter, Eq. (111).
    Scalar comparison = Scalar(2) * delta_ * (cost_ - trial_cost) / (mu_ * mu_);

    if (!std::isfinite(alpha)) {
      // The scale has overflowed: to the program that is a failure like others.
      gm_ = -gradient_;
      comparison = std::numeric_limits<Scalar>::quiet_NaN();
      Reject(&comparison, &report);
    } else if (!std::isfinite(trial_cost) || !gradient_.allFinite()) {
      comparison = std::numeric_limits<Scalar>::quiet_NaN();
      ShortenStep(p_squared);
    } else if (gm_ = -gradient_; comparison >= 0.0) {  // step 7
      Accept(trial_cost, comparison, &report);
    } else {
      Reject(&comparison, &report);
    }
    if (monitor_.stopped()) {
      Observe(report, alpha, comparison);
      return;
    }
    // Step 8.
    if (comparison < kPoor) lambda_ *= Scalar(4);
    r_norm_ = OrderedNorm(r_);
    if (report.accepted) monitor_.EndIteration(cost_, r_.norm(), w_);
    Observe(report, alpha, comparison);
    if (monitor_.stopped()) return;
    if (accepted_ && monitor_.StopAtSlowProgress(cost_)) return;
    monitor_.StopAtGoal(cost_, r_norm_, w_norm_);
  }

  // s = (E'(w + sigma_k p) - E'(w)) / sigma_k, delta_k = p's.
  void EstimateCurvature() {
    const Scalar scale = w_norm_ > Scalar(0) ? w_norm_ : Scalar(1);
    const Scalar sigma_k =
        static_cast<Scalar>(options_.sigma) * scale / p_norm_;
    trial_ = w_ + sigma_k * p_;
    Evaluate(trial_, &gradient_);
    s_ = (gm_ + gradient_) / sigma_k;
    delta_ = OrderedDot(s_, p_);
    // Infeasible that near: the scale lambda alone sets the first step.
    if (!std::isfinite(delta_)) delta_ = Scalar(0);
  }

  void Accept(Scalar trial_cost, Scalar comparison, ScgPass* report) {
    report->accepted = true;
    failures_ = 0;
    infeasible_ = 0;
    w_ = trial_;
    w_norm_ = OrderedNorm(w_);
    cost_ = trial_cost;
    lambda_bar_ = Scalar(0);
    accepted_ = true;
    if (steps_since_restart_ % w_.size() == 0) {
      report->restarted = true;
      p_ = gm_;
    } else {
      const Scalar beta = (OrderedDot(gm_, gm_) - OrderedDot(gm_, r_)) / mu_;
      p_ = gm_ + beta * p_;
    }
    r_ = gm_;
    if (comparison >= kGood) {
      lambda_ /= Scalar(2);
    } else if (comparison < kPoor) {
      lambda_ *=
          Scalar(4);  // and again in step 8: 16 in all, as the program has it
    }
  }

  // x is infeasible there, which says nothing about the curvature: a quarter of
  // the step next, as delta becomes four times what it was in step 3.
  void ShortenStep(Scalar p_squared) {
    constexpr int kMostInfeasible = 60;  // a step shorter than any rounding
    lambda_bar_ = lambda_;
    accepted_ = false;
    lambda_ += Scalar(3) * delta_ / p_squared;
    if (++infeasible_ > kMostInfeasible) {
      monitor_.Stop(
          Termination::kNoDescent,
          "the objective or its gradient is not finite however short the step");
    }
  }

  void Reject(Scalar* comparison, ScgPass* report) {
    constexpr int kMostFailures = 2;
    lambda_bar_ = lambda_;
    accepted_ = false;
    if (++failures_ <= kMostFailures) return;
    if (steps_since_restart_ <= failures_) {
      monitor_.Stop(
          Termination::kNoDescent,
          "three steps in a row along a fresh direction lowered nothing");
      return;
    }
    // The program restarts with the gradient at the rejected point, which also
    // enters the next curvature estimate; r stays that of the kept point.
    report->gave_up_direction = true;
    p_ = gm_;
    lambda_ = static_cast<Scalar>(options_.initial_lambda);
    lambda_bar_ = Scalar(0);
    accepted_ = true;
    *comparison = Scalar(1);
    steps_since_restart_ = 0;
    failures_ = 0;
  }

  void Observe(ScgPass report, Scalar alpha, Scalar comparison) const {
    if (!options_.observer) return;
    report.iteration = monitor_.iterations();
    report.cost = cost_;
    report.lambda = lambda_;
    report.alpha = alpha;
    report.comparison = comparison;
    options_.observer(report);
  }

  static constexpr Scalar kGood = Scalar(0.75);
  static constexpr Scalar kPoor = Scalar(0.25);

  const ScaledConjugateGradientOptions& options_;
  const BasicObjective<Scalar>& f_;
  RunMonitor monitor_;

  Vector w_;  // best point
  Vector trial_;
  Vector gradient_;  // of the last evaluation
  Vector gm_;        // its negative at the last trial, kept or not
  Vector r_;         // steepest descent at w
  Vector p_;         // direction
  Vector s_;
  Scalar cost_ = 0;
  Scalar w_norm_ = 0;
  Scalar p_norm_ = 0;
  Scalar r_norm_ = 0;  // summed in order; reports have Eigen's
  Scalar lambda_ = 0;
  Scalar lambda_bar_ = 0;
  Scalar delta_ = 0;
  Scalar mu_ = 0;
  std::int64_t pass_ = 0;
  std::int64_t evaluations_ = 0;
  Index steps_since_restart_ = 0;
  int failures_ = 0;
  int infeasible_ = 0;
  bool accepted_ = true;  // a new direction: curvature is to be estimated
};

}  // namespace errmap::fitting
