#include "fitting/parallel_for.h"
#include "models/certification/certification.h"
#include "models/certification/net_example.h"
#include "models/certification/solvers.h"
#include "models/net/feedforward_net.h"

namespace errmap::models {
namespace {

// Outputs z (P x 1) of the net, by the formulas as they stand (Eq. 14-18).
VectorXd Predict(const NetExampleShape& example, const VectorXd& w) {
  const NetShape& shape = example.shape;
  const auto sigmoid = [&](const MatrixXd& s) -> MatrixXd {
    return (1.0 + (-shape.slope * s.array()).exp()).inverse();
  };
  const MatrixXd w1 = FirstLayer(shape, w);
  const MatrixXd w2 = SecondLayer(shape, w);
  const MatrixXd hidden =
      sigmoid((ExampleInputs(example) * w1.leftCols(shape.inputs).transpose())
                  .rowwise() +
              w1.col(shape.inputs).transpose());
  return sigmoid((hidden * w2.leftCols(shape.hidden).transpose()).rowwise() +
                 w2.col(shape.hidden).transpose());
}

}  // namespace

void CertifyAgreement(Certification* certification) {
  const NetExampleShape example = DampedNetExample();
  const VectorXd start = InitialWeights(example.shape, 1);
  std::vector<const CertifiedSolver*> solvers;
  {
    const NetObjective objective = MakeNetExample(example);
    for (const CertifiedSolver& solver : CertifiedSolvers()) {
      if (!solver.fits_nets) continue;
      if (solver.needs_residuals && objective.residuals() == nullptr) continue;
      solvers.push_back(&solver);
    }
  }
  std::vector<AgreementCertificate> rows(solvers.size());
  std::vector<VectorXd> predictions(solvers.size());
  fitting::ParallelFor(0, solvers.size(), [&](std::size_t i) {
    // The slowest, nonlinear conjugate gradients, reaches the floor after some
    // 20000 iterations, which vary with the processor's rounding.
    constexpr fitting::StoppingRules kStopping{
        .iterations = 60000, .evaluations = 300000, .gradient_goal = 1e-9};
    const NetObjective objective = MakeNetExample(example);
    AgreementCertificate& row = rows[i];
    row.solver = solvers[i]->name;
    row.most_difference = solvers[i]->floors.agreement_difference;
    row.most_prediction_difference = solvers[i]->floors.agreement_prediction;
    row.objective = std::nan("");
    row.stop = std::string(ToString(fitting::Termination::kFailed));
    try {
      const fitting::Minimum minimum =
          solvers[i]->make(kStopping)->Minimize(objective, start);
      row.objective = minimum.summary.final_cost;
      row.iterations = minimum.summary.iterations;
      row.stop = std::string(ToString(minimum.summary.termination));
      predictions[i] = Predict(example, minimum.x);
    } catch (const std::exception& error) {
      row.stop += ": " + std::string(error.what());
    }
  });
  std::size_t best = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (!(rows[best].objective <= rows[i].objective)) best = i;
  }
  const MatrixXd targets = ExampleTargets(example);
  const double range = targets.maxCoeff() - targets.minCoeff();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double lowest = rows[best].objective;
    rows[i].difference = (rows[i].objective - lowest) / lowest;
    rows[i].prediction_difference =
        predictions[i].size() == 0
            ? std::nan("")
            : (predictions[i] - predictions[best]).cwiseAbs().maxCoeff() /
                  range;
  }
  certification->agreement = std::move(rows);
}

}  // namespace errmap::models
