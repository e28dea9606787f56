#include "fitting/minimisers/gradient_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace errmap::fitting {

Derivative RiddersDerivative(const std::function<double(double)>& f,
                             double t,
                             double step) {
  constexpr int kSteps = 12;
  constexpr double kShrink = 1.4;
  constexpr double kWorse = 2.0;
  std::array<std::array<double, kSteps>, kSteps> table{};
  const auto central = [&](double h) {
    return (f(t + h) - f(t - h)) / (2.0 * h);
  };
  Derivative best{0.0, std::numeric_limits<double>::infinity()};
  double h = step;
  for (std::size_t i = 0; i < kSteps; ++i, h /= kShrink) {
    table[0][i] = central(h);
    if (i == 0) {
      best.value = table[0][0];
      continue;
    }
    double factor = kShrink * kShrink;
    for (std::size_t j = 1; j <= i; ++j, factor *= kShrink * kShrink) {
      table[j][i] =
          (table[j - 1][i] * factor - table[j - 1][i - 1]) / (factor - 1.0);
      const double error =
          std::max(std::abs(table[j][i] - table[j - 1][i]),
                   std::abs(table[j][i] - table[j - 1][i - 1]));
      if (error <= best.error) best = {table[j][i], error};
    }
    if (std::abs(table[i][i] - table[i - 1][i - 1]) >= kWorse * best.error) {
      break;
    }
  }
  return best;
}

GradientCheck CheckGradient(const Objective& f,
                            const VectorXd& x,
                            double step) {
  constexpr double kNegligible = 1e-6;
  VectorXd gradient(x.size());
  f.Evaluate(x, &gradient);
  const double floor = kNegligible * gradient.cwiseAbs().maxCoeff();
  GradientCheck check;
  VectorXd moved = x;
  for (Index j = 0; j < x.size(); ++j) {
    const auto along = [&](double value) {
      moved[j] = value;
      return f.Evaluate(moved, nullptr);
    };
    const double numeric =
        RiddersDerivative(along, x[j], step * std::max(1.0, std::abs(x[j])))
            .value;
    moved[j] = x[j];
    const double scale = std::max(
        {std::abs(numeric), floor, std::numeric_limits<double>::min()});
    const double error = std::abs(gradient[j] - numeric) / scale;
    // Written so that a NaN counts as the worst.
    if (!(error <= check.worst_relative_error)) {
      check = {error, j, gradient[j], numeric};
      if (std::isnan(error)) break;
    }
  }
  return check;
}

}  // namespace errmap::fitting
