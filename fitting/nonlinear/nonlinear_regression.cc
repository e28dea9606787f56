#include "fitting/nonlinear/nonlinear_regression.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fitting/minimisers/levenberg_marquardt.h"
#include "fitting/nonlinear/variable_projection.h"
#include "stats/not_a_number.h"

namespace errmap::fitting {
namespace {

using stats::DoubleDouble;

// Step of the linearised problem: min |r + J p|; false where J is deficient.
bool GaussNewtonStep(const ExtendedMatrix& jacobian,
                     const ExtendedVector& residuals,
                     ExtendedVector* step) {
  if (!jacobian.cast<double>().allFinite()) return false;
  const ExtendedLeastSquaresFit fit =
      SolveExtendedLeastSquares(jacobian, residuals);
  *step = -fit.coefficients;
  return fit.full_rank && fit.coefficients.cast<double>().allFinite();
}

// |step_j| / |b_j| at its largest; infinite where b_j is 0 and the step is not.
double RelativeSize(const ExtendedVector& step, const ExtendedVector& b) {
  double largest = 0.0;
  for (Index j = 0; j < b.size(); ++j) {
    if (step[j].hi == 0.0) continue;
    largest = std::max(largest, std::abs(step[j].hi / b[j].hi));
  }
  return largest;
}

struct Strategy {
  const char* name;
  LmScaling scaling;
  double initial_damping;
};

// Marquardt's scaling makes the run independent of units; without it steps are
// short in the parameters that matter least, which keeps some runs out of flat
// regions. Strong damping starts along the gradient, weak damping with Newton's
// step.
constexpr Strategy kStrategies[] = {
    {"Marquardt scaling", LmScaling::kMarquardt, 1e-3},
    {"Marquardt scaling, strong damping", LmScaling::kMarquardt, 1e1},
    {"Marquardt scaling, weak damping", LmScaling::kMarquardt, 1e-8},
    {"no scaling", LmScaling::kNone, 1e-3},
    {"no scaling, strong damping", LmScaling::kNone, 1e1},
};

struct Candidate {
  Minimum minimum;
  std::string name;
};

// Keeps the lower cost; of those that agree to rounding, the first.
void KeepBetter(Candidate candidate, Candidate* best) {
  constexpr double kClearly = 1.0 - 1e-9;
  const double cost = candidate.minimum.summary.final_cost;
  const double least = best->minimum.summary.final_cost;
  if (best->name.empty() || cost < kClearly * least ||
      (std::isnan(least) && !std::isnan(cost))) {
    *best = std::move(candidate);
  }
}

}  // namespace

double RegressionObjective::Evaluate(const VectorXd& b,
                                     VectorXd* gradient) const {
  VectorXd residuals;
  if (gradient == nullptr) {
    Evaluate(b, &residuals, nullptr);
  } else {
    MatrixXd jacobian;
    Evaluate(b, &residuals, &jacobian);
    *gradient = jacobian.transpose() * residuals;
  }
  return 0.5 * residuals.squaredNorm();
}

RegressionStatistics AssessRegression(const RegressionFunction& function,
                                      const ExtendedVector& b) {
  const Index n = function.num_observations();
  const Index p = function.num_parameters();
  if (b.size() != p || n <= p) {
    throw std::invalid_argument("AssessRegression: b has " +
                                std::to_string(b.size()) + " elements for " +
                                std::to_string(p) + " parameters and " +
                                std::to_string(n) + " observations");
  }
  ExtendedVector residuals;
  ExtendedMatrix jacobian;
  function.Evaluate(b, &residuals, &jacobian);
  RegressionStatistics statistics;
  statistics.parameters = b.cast<double>();
  statistics.degrees_of_freedom = n - p;
  const DoubleDouble sum_of_squares = residuals.squaredNorm();
  statistics.residual_sum_of_squares = sum_of_squares.hi;
  statistics.standard_deviations = VectorXd::Constant(p, stats::kNaN);
  if (!jacobian.cast<double>().allFinite() ||
      !residuals.cast<double>().allFinite()) {
    return statistics;
  }
  // The residuals of the linearised problem at its minimum are those of b; off
  // the minimum they are not, hence the factor.
  const ExtendedLeastSquaresFit fit =
      SolveExtendedLeastSquares(jacobian, residuals);
  if (!fit.full_rank) return statistics;
  const DoubleDouble factor =
      fit.residual_sum_of_squares.hi > 0.0
          ? sqrt(sum_of_squares / fit.residual_sum_of_squares)
          : DoubleDouble(stats::kNaN);
  for (Index j = 0; j < p; ++j) {
    statistics.standard_deviations[j] =
        DoubleDouble(fit.standard_deviations[j] * factor).hi;
  }
  return statistics;
}

PolishedParameters PolishRegression(const RegressionFunction& function,
                                    const ExtendedVector& b) {
  constexpr int kMostSteps = 200;
  constexpr int kMostHalvings = 30;
  // Converged when no parameter changes by more than this share: the remaining
  // error is then below double unless the steps shrink very slowly.
  constexpr double kSmallestStep = 1e-15;
  // The sum of squares is known to about 2^-100 of itself.
  constexpr double kRounding = 0x1p-98;
  PolishedParameters polished;
  polished.parameters = b;
  ExtendedVector residuals;
  ExtendedMatrix jacobian;
  ExtendedVector step;
  function.Evaluate(b, &residuals, &jacobian);
  DoubleDouble sum = residuals.squaredNorm();
  while (polished.steps < kMostSteps &&
         GaussNewtonStep(jacobian, residuals, &step)) {
    if (RelativeSize(step, polished.parameters) <= kSmallestStep) {
      polished.converged = true;
      break;
    }
    bool lowered = false;
    for (int halving = 0; halving < kMostHalvings && !lowered; ++halving) {
      const ExtendedVector moved = polished.parameters + step;
      function.Evaluate(moved, &residuals, &jacobian);
      const DoubleDouble moved_sum = residuals.squaredNorm();
      lowered = moved_sum <= sum * (1.0 + kRounding);
      if (lowered) {
        polished.parameters = moved;
        sum = moved_sum;
      } else {
        for (Index j = 0; j < step.size(); ++j) step[j] *= 0.5;
      }
    }
    if (!lowered) break;
    ++polished.steps;
  }
  return polished;
}

RegressionFit FitNonlinearRegression(const RegressionFunction& function,
                                     const VectorXd& start,
                                     const StoppingRules& stopping) {
  const auto minimize = [&](const Strategy& strategy,
                            const Objective& objective,
                            const VectorXd& from) {
    return LevenbergMarquardt({.stopping = stopping,
                               .initial_damping = strategy.initial_damping,
                               .scaling = strategy.scaling,
                               .space = LmSpace::kParameters})
        .Minimize(objective, from);
  };
  const RegressionObjective objective(function);
  Candidate best;
  for (const Strategy& strategy : kStrategies) {
    KeepBetter({minimize(strategy, objective, start), strategy.name}, &best);
  }
  const std::size_t linear = function.linear_parameters().size();
  if (linear > 0 && linear < static_cast<std::size_t>(start.size())) {
    const ProjectedObjective projected(function);
    for (const Strategy& strategy : kStrategies) {
      Minimum minimum = minimize(strategy, projected, projected.Reduce(start));
      minimum.x = projected.Complete(minimum.x);
      if (minimum.x.allFinite()) {
        KeepBetter({std::move(minimum),
                    std::string("variable projection, ") + strategy.name},
                   &best);
      }
    }
  }
  RegressionFit fit;
  fit.summary = std::move(best.minimum.summary);
  const PolishedParameters polished =
      PolishRegression(function, best.minimum.x.cast<DoubleDouble>());
  fit.statistics = AssessRegression(function, polished.parameters);
  fit.summary.final_cost = 0.5 * fit.statistics.residual_sum_of_squares;
  if (polished.converged) fit.summary.termination = Termination::kGradient;
  fit.summary.message = best.name + "; " + fit.summary.message + "; " +
                        std::to_string(polished.steps) +
                        " Gauss-Newton steps in 106 bits" +
                        (polished.converged ? ", converged" : "");
  return fit;
}

}  // namespace errmap::fitting
