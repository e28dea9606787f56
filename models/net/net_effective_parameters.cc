#include "models/net/net_effective_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fitting/least_squares/decompositions.h"
#include "fitting/matrix_product.h"
#include "models/net/net_objective.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

constexpr Index kMostDimensions = 3000;
constexpr double kMostProducts = 5e11;

// The lower triangle of J J' (P J x P J).
MatrixXd PatternGram(const NetTraining& training, const VectorXd& w) {
  const NetObjective objective(training.shape,
                               training.inputs,
                               training.targets,
                               training.wfactor,
                               training.row_weights);
  const auto linearization = objective.residuals()->NewLinearization();
  VectorXd residuals;
  MatrixXd gram;
  linearization->MoveTo(w, &residuals, &gram);
  return gram;
}

// The lower triangle of J'J (N x N), block by block of patterns.
MatrixXd WeightGram(const NetTraining& training, const VectorXd& w) {
  constexpr Index kBlock = 2048;
  const Index patterns = training.inputs.rows();
  const bool weighted = training.row_weights.size() != 0;
  MatrixXd gram = MatrixXd::Zero(w.size(), w.size());
  for (Index begin = 0; begin < patterns; begin += kBlock) {
    const Index count = std::min(kBlock, patterns - begin);
    const VectorXd weights =
        weighted ? VectorXd(training.row_weights.segment(begin, count))
                 : VectorXd();
    const NetObjective objective(training.shape,
                                 training.inputs.middleRows(begin, count),
                                 training.targets.middleRows(begin, count),
                                 training.wfactor,
                                 weights);
    VectorXd residuals;
    MatrixXd jacobian;
    objective.residuals()->Evaluate(w, &residuals, &jacobian);
    // A block counts its own rows as all there are.
    const double share =
        weighted ? weights.sum() / training.row_weights.sum()
                 : static_cast<double>(count) / static_cast<double>(patterns);
    const MatrixXd transposed = std::sqrt(share) * jacobian.transpose();
    fitting::MultiplyByOwnTranspose(transposed, gram, true);
  }
  return gram;
}

// The trace of G (G + c D)^-1, G = J'J, with D 0 for biases and else 1: N less
// c times the diagonal of the inverse where D is 1.
double WithFreeBiases(NetTraining training, const VectorXd& w) {
  const Index n = w.size();
  training.shape.free_biases = false;  // residuals are those of any decay
  MatrixXd damped = WeightGram(training, w);
  const double tiny = damped.diagonal().maxCoeff() * static_cast<double>(n) *
                      std::numeric_limits<double>::epsilon();
  VectorXd decay =
      VectorXd::Constant(n, training.wfactor / static_cast<double>(n));
  for (const auto& [first, count] : training.shape.biases()) {
    decay.segment(first, count).setZero();
  }
  decay.array() += tiny;
  damped.diagonal() += decay;
  if (!fitting::FactorizeCholesky(damped)) return stats::kNaN;
  return static_cast<double>(n) - decay.dot(fitting::DiagonalOfInverse(damped));
}

}  // namespace

double EffectiveParameters(const NetTraining& training, const VectorXd& w) {
  const Index residuals = training.inputs.rows() * training.shape.outputs;
  const Index weights = training.shape.num_weights();
  if (w.size() != weights) {
    throw std::invalid_argument("EffectiveParameters: the net has " +
                                std::to_string(weights) + " weights, found " +
                                std::to_string(w.size()));
  }
  const Index dimensions = std::min(residuals, weights);
  const double products = static_cast<double>(residuals) *
                          static_cast<double>(dimensions) *
                          static_cast<double>(dimensions);
  if (dimensions > kMostDimensions || products > kMostProducts)
    return stats::kNaN;
  if (training.shape.free_biases) {
    return weights > kMostDimensions ? stats::kNaN
                                     : WithFreeBiases(training, w);
  }
  const MatrixXd gram =
      residuals <= weights ? PatternGram(training, w) : WeightGram(training, w);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(gram,
                                                       Eigen::EigenvaluesOnly);
  if (solver.info() != Eigen::Success) return stats::kNaN;
  const VectorXd& eigenvalues = solver.eigenvalues();  // ascending
  const double c = training.wfactor / static_cast<double>(weights);
  // Eigenvalues below the roundings of the largest count as 0.
  const double least = eigenvalues[dimensions - 1] *
                       static_cast<double>(dimensions) *
                       std::numeric_limits<double>::epsilon();
  double sum = 0.0;
  for (const double eigenvalue : eigenvalues) {
    if (eigenvalue > least) sum += eigenvalue / (eigenvalue + c);
  }
  return sum;
}

}  // namespace errmap::models
