#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>

#include "fitting/minimisers/cost_resolution.h"
#include "fitting/minimisers/run_monitor.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "fitting/minimisers/vector_passes.h"

namespace errmap::fitting {

/// One run of ScgVariant::kMoller. Members have the symbols of section 6.5;
/// equation numbers refer to it.
template <typename Scalar>
class MollerRun {
 public:
  using Vector = VectorOf<Scalar>;

  MollerRun(const ScaledConjugateGradientOptions& options,
            const BasicObjective<Scalar>& f,
            const Vector& x0,
            const RunControl& run)
      : options_(options), f_(f), monitor_(options.stopping, run), w_(x0) {}

  Minimum Minimize() {
    if (Start()) {
      // Curvature (two gradients without a path of the objective's own), value,
      // gradient, the cost after a failure, the end.
      constexpr std::int64_t kEvaluationsPerPass = 6;
      while (!monitor_.stopped() &&
             !monitor_.StopAtLimit(evaluations_, kEvaluationsPerPass)) {
        Pass();
      }
      if (!is_anew_) EvaluateAnew();
    }
    return {w_.template cast<double>(), monitor_.Finish(cost_, r_norm_)};
  }

 private:
  // Eq. (89).
  bool Start() {
    EvaluateAnew();
    p_ = r_;
    lambda_ = options_.initial_lambda;
    if (!monitor_.Begin(cost_, r_norm_) ||
        monitor_.StopAtGoal(cost_, r_norm_, w_norm_)) {
      return false;
    }
    path_ = f_.NewPath(w_);
    return true;
  }

  // Cost and gradient at w by themselves, not by what the path has kept.
  void EvaluateAnew() {
    ++evaluations_;
    cost_ = static_cast<double>(f_.Evaluate(w_, &r_));
    r_ = -r_;
    r_norm_ = static_cast<double>(r_.norm());
    w_norm_ = static_cast<double>(w_.norm());
    is_anew_ = true;
  }

  void Pass() {
    ScgPass report;
    report.pass = ++pass_;
    if (is_new_direction_) TakeDirection();

    double delta = curvature_ + lambda_ * p_squared_;  // Eq. (104)
    if (delta <= 0.0) {                                // Eq. (105)
      report.made_definite = true;
      lambda_ = 2.0 * (lambda_ - delta / p_squared_);
      delta = curvature_ + lambda_ * p_squared_;
    }
    const double alpha = mu_ / delta;  // Eq. (106)
    const double trial_cost = Value(alpha);
    // Eq. (107); not finite if the trial is infeasible.
    const double comparison = 2.0 * delta * (cost_ - trial_cost) / (mu_ * mu_);
    const bool feasible = std::isfinite(trial_cost);

    if (feasible && comparison >= 0.0 && Accept(alpha, trial_cost, &report)) {
      if (comparison >= kGood) lambda_ *= 0.5;  // Eq. (110)
      if (comparison < kPoor) Shorten(delta, comparison);
    } else {
      Reject(&report);
      // A good cost does not help if the gradient is not finite.
      const bool tells = feasible && comparison < kPoor;
      if (!report.gave_up_direction) {
        Shorten(delta, tells ? comparison : kInfeasible);
      }
    }
    Observe(report, alpha, comparison);
    if (report.accepted && !monitor_.stopped()) CheckStops();
  }

  void TakeDirection() {
    is_new_direction_ = false;
    const VectorSums<Scalar> sums = SquaresAndProduct(p_, r_);
    p_squared_ = static_cast<double>(sums.squares);
    mu_ = static_cast<double>(sums.product);
    if (!(mu_ > 0.0)) {  // rounding has taken the descent out of it
      p_ = r_;
      steps_since_restart_ = 0;
      p_squared_ = mu_ = static_cast<double>(r_.squaredNorm());
    }
    path_->SetDirection(p_);
    evaluations_ += std::max(1, path_->gradients_per_curvature());
    curvature_ = static_cast<double>(path_->Curvature());
    // Infeasible that near: lambda alone sets the first step.
    if (!std::isfinite(curvature_)) curvature_ = 0.0;
  }

  double Value(double a) {
    ++evaluations_;
    return static_cast<double>(path_->Value(static_cast<Scalar>(a)));
  }

  // Returns false if the gradient is not finite at the new point, or if neither
  // cost nor gradient is lower. At the floor of rounding a step must lower one
  // of them, or the run would never end.
  bool Accept(double alpha, double trial_cost, ScgPass* report) {
    const auto step = static_cast<Scalar>(alpha);
    path_->Accept(step);
    ++evaluations_;
    const Vector& gradient = path_->Gradient();
    const VectorSums<Scalar> sums = SquaresAndProduct(gradient, r_);
    const auto r_squared = static_cast<double>(sums.squares);
    const bool stands_still =
        trial_cost == cost_ && !(std::sqrt(r_squared) < r_norm_);
    if (!std::isfinite(r_squared) || stands_still) {
      path_ = f_.NewPath(w_);
      path_->SetDirection(p_);
      return false;
    }
    report->accepted = true;
    is_anew_ = false;
    failures_ = 0;
    w_ += step * p_;
    w_norm_ = static_cast<double>(std::sqrt(SquaresAndProduct(w_, w_).squares));
    cost_ = trial_cost;
    ++steps_since_restart_;
    const auto overlap = -static_cast<double>(sums.product);
    r_norm_ = std::sqrt(r_squared);
    if (steps_since_restart_ % w_.size() == 0) {
      report->restarted = true;
      p_ = r_ = -gradient;
    } else {  // Eq. (109)
      r_ = -gradient;
      p_ = r_ + static_cast<Scalar>((r_squared - overlap) / mu_) * p_;
    }
    is_new_direction_ = true;
    monitor_.EndIteration(cost_, r_norm_, w_);
    return true;
  }

  void Reject(ScgPass* report) {
    constexpr int kMostFailures = 5;
    constexpr int kMostFromSteepestDescent = 60;  // shorter than any rounding
    if (++failures_ == 1) {  // the path may have renewed what it keeps
      cost_ = Value(0.0);
      is_anew_ = false;
    }
    if (steps_since_restart_ > 0 && failures_ > kMostFailures) {
      report->gave_up_direction = true;
      p_ = r_;
      is_new_direction_ = true;
      lambda_ = options_.initial_lambda;
      steps_since_restart_ = 0;
      failures_ = 0;
    } else if (failures_ > kMostFromSteepestDescent) {
      StopHere();
    }
  }

  // Either the cost shows no further gain, or the gradient promises one that no
  // step gives.
  void StopHere() {
    const char* why = "no step along steepest descent lowers the cost";
    if constexpr (std::is_same_v<Scalar, double>) {
      // One is kept for the end.
      const auto spend = [&] {
        return !monitor_.StopAtLimit(++evaluations_, 1);
      };
      StopWithoutDescent(f_, w_, spend, why, &monitor_);
    } else {
      monitor_.Stop(Termination::kNoDescent, why);
    }
  }

  // Eq. (112) with the growth of Moller's paper, which does not depend on the
  // scale of f: delta grows by the share that the parabola was wrong.
  void Shorten(double delta, double comparison) {
    lambda_ += delta * (1.0 - comparison) / p_squared_;
  }

  void CheckStops() {
    if (monitor_.StopAtSlowProgress(cost_)) return;
    if (!monitor_.ReachesCostGoal(cost_) &&
        !monitor_.ReachesGradientGoal(r_norm_, w_norm_)) {
      return;
    }
    EvaluateAnew();
    if (monitor_.StopAtGoal(cost_, r_norm_, w_norm_)) return;
    path_ = f_.NewPath(w_);
    p_ = r_;
    is_new_direction_ = true;
    steps_since_restart_ = 0;
  }

  void Observe(ScgPass report, double alpha, double comparison) const {
    if (!options_.observer) return;
    report.iteration = monitor_.iterations();
    report.cost = cost_;
    report.lambda = lambda_;
    report.alpha = alpha;
    report.comparison = comparison;
    options_.observer(report);
  }

  static constexpr double kGood = 0.75;
  static constexpr double kPoor = 0.25;
  // Says nothing about the curvature: delta becomes four times what it was,
  // the step a quarter.
  static constexpr double kInfeasible = -2.0;

  const ScaledConjugateGradientOptions& options_;
  const BasicObjective<Scalar>& f_;
  RunMonitor monitor_;
  std::unique_ptr<Path<Scalar>> path_;

  Vector w_;  // best point
  Vector r_;  // steepest descent there
  Vector p_;  // direction
  double cost_ = 0.0;
  double r_norm_ = 0.0;
  double w_norm_ = 0.0;
  double p_squared_ = 0.0;
  double curvature_ = 0.0;  // p'Hp
  double mu_ = 0.0;
  double lambda_ = 0.0;
  std::int64_t pass_ = 0;
  std::int64_t evaluations_ = 0;
  Index steps_since_restart_ = 0;
  int failures_ = 0;
  bool is_new_direction_ = true;
  bool is_anew_ = false;  // cost and r are evaluated at w, not kept by the path
};

}  // namespace errmap::fitting
