#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "data/formats/strd_problem.h"
#include "fitting/minimisers/optimizer.h"
#include "fitting/nonlinear/nonlinear_regression.h"
#include "models/net/net_objective.h"
#include "stats/eigen.h"

namespace errmap::models {

/// What a minimiser must reach. The floors fit its method, and lie slightly
/// below what it once reached, since its path depends on the processor's
/// rounding. measured.md has both.
struct SolverFloors {
  int solved = 0;                      // of the runs on NIST's problems
  double mean_lre_parameters = 0.0;    // over these runs
  double agreement_difference = 1e-8;  // for the damped net, at most
  double agreement_prediction = 1e-6;
};

/// A minimiser under test.
struct CertifiedSolver {
  std::string name;
  std::function<std::unique_ptr<fitting::Optimizer>(
      const fitting::StoppingRules&)>
      make;
  SolverFloors floors;
  bool needs_residuals = false;  // accepts only objectives in residual form
  /// Runs on NIST's problems. A fixed learning rate does not suit parameters
  /// whose sizes differ by powers of ten.
  bool fits_formulas = true;
  /// Runs on nets too; minimisers without derivatives do not.
  bool fits_nets = true;
};

/// Every minimiser of this program; to add one, add one line.
const std::vector<CertifiedSolver>& CertifiedSolvers();

/// A net on synthetic patterns, so that every installation can fit it.
struct NetExampleShape {
  std::string name;  // "net 3-5-1, sigmoid output"
  NetShape shape;
  Index patterns = 0;
  double wfactor = 0.0;
};

/// Returns shapes that reach every branch: either output, several outputs, a
/// slope, few and many hidden nodes.
const std::vector<NetExampleShape>& NetExampleShapes();

/// Returns the well-damped net of CertifyAgreement: large wfactor, one minimum.
NetExampleShape DampedNetExample();

/// Return inputs (P x I) on a low-discrepancy grid in [-1, 1], and targets (P x
/// J) in 0.2 to 0.8, a smooth function of them.
MatrixXd ExampleInputs(const NetExampleShape& example);
MatrixXd ExampleTargets(const NetExampleShape& example);

/// Returns E(w) of a net on these patterns.
NetObjective MakeNetExample(const NetExampleShape& example);

/// Returns the regression of a nonlinear NIST problem, with data in 106 bits
/// from their decimal text. Throws std::invalid_argument if `problem` is of
/// another kind, or has an unknown model or another number of parameters.
std::unique_ptr<fitting::RegressionFunction> MakeStrdFunction(
    const data::StrdProblem& problem);

/// Returns column `column` of the data (n) in 106 bits.
fitting::ExtendedVector StrdColumn(const data::StrdProblem& problem,
                                   std::size_t column);

/// Return the certified parameters (p), and their standard deviations (p).
VectorXd CertifiedParameters(const data::StrdProblem& problem);
VectorXd CertifiedDeviations(const data::StrdProblem& problem);

/// Returns start 1 or 2 (p) of a nonlinear problem. Throws
/// std::invalid_argument for any other number.
VectorXd StrdStart(const data::StrdProblem& problem, int start);

}  // namespace errmap::models
