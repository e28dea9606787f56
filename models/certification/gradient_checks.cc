#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "fitting/minimisers/gradient_check.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "fitting/nonlinear/variable_projection.h"
#include "models/certification/certification.h"
#include "models/certification/net_example.h"
#include "models/certification/strd_functions.h"
#include "models/net/feedforward_net.h"

namespace errmap::models {
namespace {

// v'r(x) of residuals r: its gradient J'v has a share of every entry of J, and
// does not vanish where J'r does.
class ResidualCombination final : public fitting::Objective {
 public:
  ResidualCombination(const fitting::ResidualFunction& residuals,
                      const VectorXd& v)
      : residuals_(residuals), v_(v) {}

  Index num_parameters() const override { return 0; }  // asked by optimizers

  double Evaluate(const VectorXd& x, VectorXd* gradient) const override {
    VectorXd r;
    if (gradient == nullptr) {
      residuals_.Evaluate(x, &r, nullptr);
    } else {
      MatrixXd jacobian;
      residuals_.Evaluate(x, &r, &jacobian);
      *gradient = jacobian.transpose() * v_;
    }
    return v_.dot(r);
  }

 private:
  const fitting::ResidualFunction& residuals_;
  const VectorXd& v_;
};

// Uniform in [-1, 1]; our own mapping, the same with every library.
double Draw(std::mt19937_64* random) {
  constexpr double kScale = 0x1p-52;
  return static_cast<double>((*random)() >> 11) * kScale - 1.0;
}

// Ridders' derivative with the best of some first steps: where f changes over
// 1e-3 of x, a step of a tenth of x tells nothing, and where it is nearly
// straight, a small one drowns in rounding.
double WorstError(const fitting::Objective& f,
                  const VectorXd& x,
                  double gradient_size) {
  VectorXd gradient(x.size());
  f.Evaluate(x, &gradient);
  double worst = 0.0;
  VectorXd moved = x;
  for (Index j = 0; j < x.size(); ++j) {
    const auto along = [&](double value) {
      moved[j] = value;
      return f.Evaluate(moved, nullptr);
    };
    const double size = std::abs(x[j]) > 0.0 ? std::abs(x[j]) : 1.0;
    fitting::Derivative best{0.0, std::numeric_limits<double>::infinity()};
    for (const double share : {0.1, 1e-2, 1e-3, 1e-4}) {
      const fitting::Derivative derivative =
          fitting::RiddersDerivative(along, x[j], share * size);
      if (derivative.error < best.error) best = derivative;
    }
    moved[j] = x[j];
    // A component that is small among large ones is not judged by its own size:
    // in units of its parameter, so that units do not matter.
    const double scale = std::max({std::abs(best.value),
                                   gradient_size / size,
                                   std::numeric_limits<double>::min()});
    const double error = std::abs(gradient[j] - best.value) / scale;
    if (std::isnan(error)) return error;  // the worst there is
    worst = std::max(worst, error);
  }
  return worst;
}

double LargestScaled(const fitting::Objective& f, const VectorXd& x) {
  VectorXd gradient(x.size());
  f.Evaluate(x, &gradient);
  double largest = 0.0;
  for (Index j = 0; j < x.size(); ++j) {
    const double size = std::abs(x[j]) > 0.0 ? std::abs(x[j]) : 1.0;
    largest = std::max(largest, std::abs(gradient[j]) * size);
  }
  return largest;
}

constexpr double kNegligible = 1e-3;  // of the largest component

void CertifyNets(Certification* certification) {
  for (const NetExampleShape& shape : NetExampleShapes()) {
    const NetObjective objective = MakeNetExample(shape);
    const VectorXd start = InitialWeights(shape.shape, 1);
    CertifyGradient(
        shape.name + ", random weights", objective, start, 0.0, certification);
    const fitting::ScaledConjugateGradient scg(
        {.stopping = {.iterations = 500, .gradient_goal = 1e-9}});
    CertifyGradient(shape.name + ", at the minimum",
                    objective,
                    scg.Minimize(objective, start).x,
                    LargestScaled(objective, start),
                    certification);
  }
}

void CertifyRegressions(Certification* certification) {
  std::mt19937_64 random(1);
  constexpr double kSpread = 0.05;
  for (const data::StrdProblem& problem : data::StrdProblems()) {
    if (problem.kind != data::StrdKind::kNonlinear) continue;
    const auto function = MakeStrdFunction(problem);
    const fitting::RegressionObjective objective(*function);
    VectorXd x = StrdStart(problem, 2);
    for (double& value : x) value *= 1.0 + kSpread * Draw(&random);
    CertifyGradient(
        problem.name + ", random point", objective, x, 0.0, certification);
    const double size = LargestScaled(objective, x);
    const VectorXd solution =
        fitting::FitNonlinearRegression(
            *function, StrdStart(problem, 2), {.iterations = 5000})
            .statistics.parameters;
    CertifyGradient(problem.name + ", at the minimum",
                    objective,
                    solution,
                    size,
                    certification);
  }
}

}  // namespace

void CertifyGradient(const std::string& name,
                     const fitting::Objective& f,
                     const VectorXd& x,
                     double gradient_size,
                     Certification* certification) {
  const double size = gradient_size > 0.0 ? gradient_size : LargestScaled(f, x);
  double worst = WorstError(f, x, kNegligible * size);
  if (const fitting::ResidualFunction* residuals = f.residuals()) {
    constexpr int kCombinations = 2;
    std::mt19937_64 random(2);
    for (int i = 0; i < kCombinations; ++i) {
      VectorXd v(residuals->num_residuals());
      for (double& value : v) value = Draw(&random);
      const ResidualCombination combination(*residuals, v);
      const double error = WorstError(
          combination, x, kNegligible * LargestScaled(combination, x));
      if (std::isnan(worst)) break;
      if (!(error <= worst)) worst = error;
    }
  }
  certification->gradients.push_back({name, worst});
}

void CertifyGradients(Certification* certification) {
  CertifyNets(certification);
  CertifyRegressions(certification);
}

}  // namespace errmap::models
