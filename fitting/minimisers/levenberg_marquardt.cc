#include "fitting/minimisers/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "fitting/interruption.h"
#include "fitting/minimisers/cost_resolution.h"
#include "fitting/minimisers/damped_least_squares.h"
#include "fitting/minimisers/run_monitor.h"
#include "stats/require.h"

namespace errmap::fitting {
namespace {

bool InPatternSpace(const LevenbergMarquardtOptions& options,
                    const ResidualFunction& residuals,
                    Index num_parameters) {
  if (options.space != LmSpace::kAuto) {
    return options.space == LmSpace::kPatterns;
  }
  return options.scaling == LmScaling::kNone &&
         residuals.num_residuals() < num_parameters;
}

class LmRun {
 public:
  LmRun(const LevenbergMarquardtOptions& options,
        const Objective& f,
        const ResidualFunction& residuals,
        const VectorXd& x0,
        const RunControl& run)
      : options_(options),
        f_(f),
        residuals_(residuals),
        monitor_(options.stopping, run),
        x0_(x0),
        x_(x0) {
    std::shared_ptr<VectorXd> scale;
    if (options.scaling == LmScaling::kMarquardt) {
      scale = std::make_shared<VectorXd>();
    }
    // Two, so that a trial point may turn out to be of no use.
    for (auto* space : {&here_, &there_}) {
      *space = InPatternSpace(options, residuals, x0.size())
                   ? MakePatternSpace(residuals)
                   : MakeParameterSpace(residuals, scale);
    }
  }

  Minimum Minimize() {
    try {
      Iterate();
    } catch (const Interrupted&) {
      // The point is that of the last iteration that came to its end.
      monitor_.Stop(Termination::kInterrupted, "interrupted in an iteration");
    }
    return Finish();
  }

 private:
  void Iterate() {
    // A trial and its Jacobian, a gradient to confirm a claim, and the last
    // evaluation.
    constexpr std::int64_t kEvaluationsPerPass = 4;
    EvaluateObjective();
    start_ = own_;
    if (monitor_.Begin(own_.cost, own_.gradient_norm) &&
        !monitor_.StopAtGoal(own_.cost, own_.gradient_norm, x_.norm()) &&
        !monitor_.StopAtLimit(evaluations_, kEvaluationsPerPass + 1) &&
        Start()) {
      while (!monitor_.stopped() &&
             !monitor_.StopAtLimit(evaluations_, kEvaluationsPerPass)) {
        Pass();
      }
    }
  }

  static constexpr double kMostShrinkage = 1.0 / 3.0;
  static constexpr double kFast = 0.25;
  static constexpr int kMostFruitless = 10;

  struct Value {
    double cost = 0.0;
    double gradient_norm = 0.0;
  };

  void EvaluateObjective() {
    ++evaluations_;
    VectorXd gradient;
    own_.cost = f_.Evaluate(x_, &gradient);
    own_.gradient_norm = gradient.norm();
    own_is_current_ = true;
  }

  // Returns true if the objective's cost at x and that of the residuals agree
  // to rounding; if not, ends the run.
  bool FormsAgree() {
    constexpr double kRelative = 1e-6;
    // A sum of squares that has become this small may be all rounding.
    constexpr double kOfInitial = 1e-12;
    const double allowed = kRelative * own_.cost + kOfInitial * start_.cost;
    if (std::abs(own_.cost - here_->cost()) <= allowed) return true;
    monitor_.Stop(monitor_.iterations() == 0 ? Termination::kFailed
                                             : Termination::kNoDescent,
                  "the residual form does not give the objective's cost");
    return false;
  }

  bool Start() {
    ++evaluations_;
    here_->MoveTo(x_);
    if (!here_->is_finite()) {
      monitor_.Stop(Termination::kFailed,
                    "the residuals or their Jacobian are not finite at the "
                    "start");
      return false;
    }
    if (!FormsAgree()) return false;
    const double curvature = here_->mean_curvature();
    lambda_ = options_.initial_damping * (curvature > 0.0 ? curvature : 1.0);
    constexpr double kLeastOfFirst = 1e-20;
    least_lambda_ =
        std::max(kLeastOfFirst * lambda_, std::numeric_limits<double>::min());
    return true;
  }

  // One trial step.
  void Pass() {
    if (!here_->Solve(lambda_, &step_)) {
      Reject();
      return;
    }
    trial_ = x_ + step_;
    const double step_squared = here_->ScaledSquaredNorm(step_);
    const double tolerance = options_.step_tolerance;
    if (trial_ == x_ ||
        std::sqrt(step_squared) <=
            tolerance * std::sqrt(here_->ScaledSquaredNorm(x_))) {
      StopHere("the steps have become too short to lower the cost");
      return;
    }
    const double predicted =
        0.5 * (lambda_ * step_squared - step_.dot(here_->gradient()));
    const double trial_cost = CostAt(trial_);
    if (!std::isfinite(trial_cost) || !(predicted > 0.0)) {
      Reject();
      return;
    }
    const double cost = here_->cost();
    const double fall = cost - trial_cost;
    const double ratio = fall / predicted;
    const double unclear = options_.cost_resolution * cost;
    const bool is_clear = predicted > unclear;
    constexpr double kLeastRatio = 1e-4;
    constexpr double kSurelyNoRounding =
        100.0 * std::numeric_limits<double>::epsilon();
    const bool falls = ratio > kLeastRatio &&
                       fall > (is_clear ? 0.0 : kSurelyNoRounding * cost);
    if (falls || (!is_clear && std::abs(fall) <= unclear)) {
      ++evaluations_;
      there_->MoveTo(trial_);
      if (there_->is_finite()) {
        if (is_clear) {
          Accept(NielsenFactor(ratio));
          return;
        }
        const double contraction = Contraction();
        if (falls || contraction < 1.0) {
          Accept(contraction < kFast ? kMostShrinkage : 1.0);
          return;
        }
        ++fruitless_;
      }
    }
    Reject();
    if (!monitor_.stopped() && fruitless_ >= kMostFruitless) {
      StopHere(
          "neither cost nor gradient can be lowered beyond their rounding");
    }
  }

  static double NielsenFactor(double ratio) {
    const double offset = 2.0 * ratio - 1.0;
    return std::max(kMostShrinkage, 1.0 - offset * offset * offset);
  }

  // Ratio by which the trial lowers g'(J'J + c I + lambda D^2)^-1 g.
  double Contraction() {
    VectorXd next;
    if (!there_->Solve(lambda_, &next)) {
      return std::numeric_limits<double>::infinity();
    }
    return next.dot(there_->gradient()) / step_.dot(here_->gradient());
  }

  double CostAt(const VectorXd& x) {
    ++evaluations_;
    residuals_.Evaluate(x, &trial_residuals_, nullptr);
    return 0.5 * trial_residuals_.squaredNorm() +
           0.5 * residuals_.ridge() * x.squaredNorm();
  }

  void Accept(double factor) {
    lambda_ = std::max(least_lambda_, factor * lambda_);
    growth_ = 2.0;
    fruitless_ = 0;
    x_.swap(trial_);
    std::swap(here_, there_);
    here_->Settle();
    own_is_current_ = false;
    const double cost = here_->cost();
    const double gradient_norm = here_->gradient().norm();
    monitor_.EndIteration(cost, gradient_norm, x_);
    if (monitor_.stopped()) return;
    if (monitor_.StopAtSlowProgress(cost)) return;
    const double x_norm = x_.norm();
    if (!monitor_.ReachesGradientGoal(gradient_norm, x_norm)) {
      monitor_.StopAtGoal(cost, gradient_norm, x_norm);
      return;
    }
    EvaluateObjective();
    if (FormsAgree()) monitor_.StopAtGoal(cost, own_.gradient_norm, x_norm);
  }

  void Reject() {
    lambda_ *= growth_;
    growth_ *= 2.0;
    if (!std::isfinite(lambda_)) {
      StopHere("no step lowers the cost, however short");
    }
  }

  void StopHere(const char* why) {
    const bool residuals_say_minimum =
        monitor_.ReachesGradientGoal(here_->gradient().norm(), x_.norm());
    // One is kept for the end.
    const auto spend = [&] { return !monitor_.StopAtLimit(++evaluations_, 1); };
    StopWithoutDescent(f_,
                       x_,
                       spend,
                       residuals_say_minimum
                           ? "the gradient of the residual form is small, but "
                             "the objective's own is not"
                           : why,
                       &monitor_);
  }

  // The last word is the objective's own. Where it says that the residual form
  // has led upwards, the start is the best point seen.
  Minimum Finish() {
    if (!own_is_current_) {
      EvaluateObjective();
      FormsAgree();
    }
    if (monitor_.has_failed() || !(own_.cost <= start_.cost)) {
      x_ = x0_;
      own_ = start_;
    }
    return {std::move(x_), monitor_.Finish(own_.cost, own_.gradient_norm)};
  }

  const LevenbergMarquardtOptions& options_;
  const Objective& f_;
  const ResidualFunction& residuals_;
  RunMonitor monitor_;
  const VectorXd& x0_;
  VectorXd x_;
  std::unique_ptr<DampedLeastSquares> here_;
  std::unique_ptr<DampedLeastSquares> there_;
  VectorXd step_;
  VectorXd trial_;
  VectorXd trial_residuals_;
  Value start_;  // the objective's own at x0
  Value own_;    // and at x where it is current
  bool own_is_current_ = false;
  double lambda_ = 0.0;
  double least_lambda_ = 0.0;  // so that it can grow again
  double growth_ = 2.0;        // nu
  int fruitless_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace

void LevenbergMarquardtOptions::Validate() const {
  stopping.Validate();
  stats::Require(
      initial_damping > 0.0 && std::isfinite(initial_damping),
      "LevenbergMarquardtOptions: initial_damping must be above 0 and finite",
      initial_damping);
  stats::Require(step_tolerance >= 0.0,
                 "LevenbergMarquardtOptions: step_tolerance must be at least 0",
                 step_tolerance);
  stats::Require(cost_resolution >= 0.0 && cost_resolution < 1.0,
                 "LevenbergMarquardtOptions: cost_resolution must be at least "
                 "0 and below 1",
                 cost_resolution);
  if (space == LmSpace::kPatterns && scaling == LmScaling::kMarquardt) {
    throw std::invalid_argument(
        "LevenbergMarquardtOptions: kMarquardt scales parameters; it needs "
        "their space, not kPatterns");
  }
}

Minimum LevenbergMarquardt::DoMinimize(const Objective& f,
                                       const VectorXd& x0,
                                       const RunControl& run) const {
  const ResidualFunction* residuals = f.residuals();
  if (residuals == nullptr) {
    throw std::invalid_argument(
        "LevenbergMarquardt: the objective has no residual form; take a method "
        "that needs its gradient only");
  }
  stats::Require(residuals->ridge() >= 0.0 && std::isfinite(residuals->ridge()),
                 "LevenbergMarquardt: the ridge must be at least 0 and finite",
                 residuals->ridge());
  return LmRun(options_, f, *residuals, x0, run).Minimize();
}

}  // namespace errmap::fitting
