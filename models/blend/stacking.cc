#include "models/blend/stacking.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace errmap::models {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// The nearest point with w >= 0 and sum 1 (Duchi et al. 2008).
VectorXd OntoSimplex(const VectorXd& point) {
  std::vector<double> sorted(point.begin(), point.end());
  std::ranges::sort(sorted, std::greater<>());
  double sum = 0.0;
  double shift = 0.0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    sum += sorted[i];
    const double candidate = (sum - 1.0) / static_cast<double>(i + 1);
    if (sorted[i] > candidate) shift = candidate;
  }
  return (point.array() - shift).cwiseMax(0.0).matrix();
}

}  // namespace

VectorXd StackingWeights(const MatrixXd& predictions, const VectorXd& targets) {
  const Index k = predictions.cols();
  MatrixXd products = MatrixXd::Zero(k, k);
  Index rows = 0;
  for (Index i = 0; i < predictions.rows(); ++i) {
    if (!predictions.row(i).allFinite()) continue;
    const VectorXd residual =
        (targets[i] - predictions.row(i).array()).matrix().transpose();
    products += residual * residual.transpose();
    ++rows;
  }
  VectorXd weights = VectorXd::Constant(k, 1.0 / static_cast<double>(k));
  if (rows == 0) return weights;
  // With sum 1 the cost is w' (R'R) w: projected gradient with momentum
  // (Nesterov 1983), its step from the largest row sum.
  const double steepest = products.cwiseAbs().rowwise().sum().maxCoeff();
  if (!(steepest > 0.0)) return weights;
  constexpr int kMostSteps = 5000;
  constexpr double kSettled = 1e-10;
  VectorXd ahead = weights;
  double momentum = 1.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const VectorXd next = OntoSimplex(ahead - products * ahead / steepest);
    const double grown =
        0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum * momentum));
    ahead = next + (momentum - 1.0) / grown * (next - weights);
    const double moved = (next - weights).cwiseAbs().maxCoeff();
    weights = next;
    momentum = grown;
    if (moved < kSettled) break;
  }
  return weights;
}

}  // namespace errmap::models
