#include "fitting/scaled_conjugate_gradient.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "fitting/budget.h"

namespace errmap::fitting {
namespace {

using Eigen::VectorXd;

void RequirePositive(const char* field, double value) {
  if (!(value > 0.0)) {
    throw std::invalid_argument(
        "ScaledConjugateGradientOptions: " + std::string(field) +
        " must be above 0, found " + std::to_string(value));
  }
}

// One run. Members carry the symbols of section 6.5; steps are Moller's.
class ScgRun {
 public:
  ScgRun(const ScaledConjugateGradientOptions& options,
         const Objective& f,
         const VectorXd& x0,
         const RunControl& run)
      : options_(options),
        rules_(options.stopping),
        f_(f),
        run_(run),
        budget_(options.stopping, run),
        w_(x0),
        trial_(x0.size()),
        gradient_(x0.size()),
        s_(x0.size()) {}

  Minimum Minimize() {
    if (Start()) {
      while (Continue()) Pass();
    }
    return {std::move(w_), std::move(summary_)};
  }

 private:
  void Stop(Termination termination, std::string message) {
    summary_.termination = termination;
    summary_.message = std::move(message);
    stopped_ = true;
  }

  double Evaluate(const VectorXd& x, VectorXd* gradient) {
    ++evaluations_;
    return f_.Evaluate(x, gradient);
  }

  // Step 1. False where there is nothing to do.
  bool Start() {
    cost_ = Evaluate(w_, &gradient_);
    r_ = -gradient_;
    gm_ = r_;
    p_ = r_;
    summary_.initial_cost = summary_.final_cost = cost_;
    r_norm_ = r_.norm();
    w_norm_ = w_.norm();
    summary_.initial_gradient_norm = summary_.final_gradient_norm = r_norm_;
    rms_ = last_checked_rms_ = std::sqrt(2.0 * cost_);
    lambda_ = options_.initial_lambda;
    if (!std::isfinite(cost_) || !std::isfinite(r_norm_)) {
      Stop(Termination::kFailed,
           "the cost or its gradient is not finite at the start");
    } else {
      Trace();
      CheckGoals();
    }
    return !stopped_;
  }

  bool Continue() {
    constexpr std::int64_t kEvaluationsPerPass = 2;
    if (stopped_) return false;
    const auto limit = budget_.Exhausted(
        summary_.iterations, evaluations_, kEvaluationsPerPass);
    if (!limit) return true;
    Stop(*limit,
         *limit == Termination::kInterrupted
             ? "interrupted; the best point so far is kept"
             : "a limit was reached before the gradient was small");
    return false;
  }

  void Pass() {
    ScgPass report;
    report.pass = ++pass_;
    ++steps_since_restart_;
    p_norm_ = p_.norm();
    const double p_squared = p_norm_ * p_norm_;
    if (accepted_) EstimateCurvature();  // step 2

    // Step 3: scale. After a failure only the growth of lambda is added.
    delta_ += (lambda_ - lambda_bar_) * p_squared;
    // Step 4: make the estimate positive definite.
    if (delta_ <= 0.0) {
      report.made_definite = true;
      lambda_bar_ = 2.0 * (lambda_ - delta_ / p_squared);
      delta_ = -delta_ + lambda_ * p_squared;
      lambda_ = lambda_bar_;
    }
    // Step 5: step length.
    mu_ = p_.dot(r_);
    const double alpha = mu_ / delta_;
    trial_ = w_ + alpha * p_;
    const double trial_cost = Evaluate(trial_, &gradient_);
    // Step 6: comparison parameter, Eq. (111).
    double comparison = 2.0 * delta_ * (cost_ - trial_cost) / (mu_ * mu_);

    if (!std::isfinite(trial_cost) || !gradient_.allFinite()) {
      comparison = std::numeric_limits<double>::quiet_NaN();
      ShortenStep(p_squared);
    } else if (gm_ = -gradient_; comparison >= 0.0) {  // step 7
      Accept(trial_cost, comparison, &report);
    } else {
      Reject(&comparison, &report);
    }
    if (stopped_) {
      Observe(report, alpha, comparison);
      return;
    }
    // Step 8.
    if (comparison < 0.25) lambda_ *= 4.0;
    rms_ = std::sqrt(2.0 * cost_);
    r_norm_ = r_.norm();
    summary_.final_gradient_norm = r_norm_;
    if (report.accepted) Trace();
    Observe(report, alpha, comparison);
    CheckProgress();
    if (!stopped_) CheckGoals();
  }

  // s = (E'(w + sigma_k p) - E'(w)) / sigma_k, delta_k = p's.
  void EstimateCurvature() {
    const double scale = w_norm_ > 0.0 ? w_norm_ : 1.0;
    const double sigma_k = options_.sigma * scale / p_norm_;
    trial_ = w_ + sigma_k * p_;
    Evaluate(trial_, &gradient_);
    s_ = (gm_ + gradient_) / sigma_k;
    delta_ = s_.dot(p_);
    // Infeasible that near: the scale lambda alone sets the first step.
    if (!std::isfinite(delta_)) delta_ = 0.0;
  }

  void Accept(double trial_cost, double comparison, ScgPass* report) {
    report->accepted = true;
    ++summary_.iterations;
    ++steps_since_check_;
    failures_ = 0;
    infeasible_ = 0;
    w_ = trial_;
    w_norm_ = w_.norm();
    cost_ = trial_cost;
    summary_.final_cost = cost_;
    lambda_bar_ = 0.0;
    accepted_ = true;
    if (steps_since_restart_ % w_.size() == 0) {
      report->restarted = true;
      p_ = gm_;
    } else {
      const double beta = (gm_.dot(gm_) - gm_.dot(r_)) / mu_;
      p_ = gm_ + beta * p_;
    }
    r_ = gm_;
    if (comparison >= 0.75) {
      lambda_ /= 2.0;
    } else if (comparison < 0.25) {
      lambda_ *= 4.0;  // and again in step 8: 16 in all, as the program has it
    }
  }

  // x is infeasible there, which says nothing about the curvature: a quarter of
  // the step next, as delta becomes four times what it was in step 3.
  void ShortenStep(double p_squared) {
    constexpr int kMostInfeasible = 60;  // a step shorter than any rounding
    lambda_bar_ = lambda_;
    accepted_ = false;
    lambda_ += 3.0 * delta_ / p_squared;
    if (++infeasible_ > kMostInfeasible) {
      Stop(Termination::kNoDescent,
           "the objective is not finite however short the step");
    }
  }

  void Reject(double* comparison, ScgPass* report) {
    constexpr int kMostFailures = 2;
    lambda_bar_ = lambda_;
    accepted_ = false;
    if (++failures_ <= kMostFailures) return;
    if (steps_since_restart_ <= failures_) {
      Stop(Termination::kNoDescent,
           "three steps in a row along a fresh direction lowered nothing");
      return;
    }
    // The program restarts with the gradient at the rejected point, which also
    // enters the next curvature estimate; r stays that of the kept point.
    report->gave_up_direction = true;
    p_ = gm_;
    lambda_ = options_.initial_lambda;
    lambda_bar_ = 0.0;
    accepted_ = true;
    *comparison = 1.0;
    steps_since_restart_ = 0;
    failures_ = 0;
  }

  void CheckProgress() {
    if (!accepted_ || steps_since_check_ < rules_.progress_interval) return;
    steps_since_check_ = 0;
    if (rms_ > rules_.slow_ratio * last_checked_rms_) {
      Stop(Termination::kSlowProgress,
           "the error fell too little since the last check");
      return;
    }
    last_checked_rms_ = rms_;
  }

  void CheckGoals() {
    if (rms_ < rules_.cost_goal) {
      Stop(Termination::kCostGoal, "the error goal was reached");
    } else if (r_norm_ < rules_.gradient_goal * std::max(1.0, w_norm_) ||
               r_norm_ == 0.0) {
      Stop(Termination::kGradient, "the gradient is small: a minimum");
    }
  }

  void Trace() {
    if (run_.keep_trace) {
      summary_.trace.push_back({summary_.iterations, rms_, r_norm_});
    }
  }

  void Observe(ScgPass report, double alpha, double comparison) const {
    if (!options_.observer) return;
    report.iteration = summary_.iterations;
    report.cost = cost_;
    report.lambda = lambda_;
    report.alpha = alpha;
    report.comparison = comparison;
    options_.observer(report);
  }

  const ScaledConjugateGradientOptions& options_;
  const StoppingRules& rules_;
  const Objective& f_;
  const RunControl& run_;
  Budget budget_;
  FitSummary summary_;

  VectorXd w_;  // best point
  VectorXd trial_;
  VectorXd gradient_;  // of the last evaluation
  VectorXd gm_;        // its negative at the last trial, kept or not
  VectorXd r_;         // steepest descent at w
  VectorXd p_;         // direction
  VectorXd s_;
  double cost_ = 0.0;
  double rms_ = 0.0;
  double last_checked_rms_ = 0.0;
  double w_norm_ = 0.0;
  double p_norm_ = 0.0;
  double r_norm_ = 0.0;
  double lambda_ = 0.0;
  double lambda_bar_ = 0.0;
  double delta_ = 0.0;
  double mu_ = 0.0;
  std::int64_t pass_ = 0;
  std::int64_t evaluations_ = 0;
  Eigen::Index steps_since_restart_ = 0;
  std::int64_t steps_since_check_ = 0;
  int failures_ = 0;
  int infeasible_ = 0;
  bool accepted_ = true;  // a new direction: curvature is to be estimated
  bool stopped_ = false;
};

}  // namespace

void ScaledConjugateGradientOptions::Validate() const {
  stopping.Validate();
  RequirePositive("initial_lambda", initial_lambda);
  RequirePositive("sigma", sigma);
}

ScaledConjugateGradient::ScaledConjugateGradient(
    ScaledConjugateGradientOptions options)
    : options_(std::move(options)) {
  options_.Validate();
}

Minimum ScaledConjugateGradient::DoMinimize(const Objective& f,
                                            const VectorXd& x0,
                                            const RunControl& run) const {
  return ScgRun(options_, f, x0, run).Minimize();
}

}  // namespace errmap::fitting
