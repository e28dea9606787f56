#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fitting/minimisers/optimizer.h"

namespace errmap::models {

/// Accuracy that a minimiser must reach. Floors lie slightly below the measured
/// accuracy, since the path depends on the processor's rounding. measured.md
/// has both.
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
  /// Whether it runs on NIST's problems. A fixed learning rate does not suit
  /// parameters whose sizes differ by powers of ten.
  bool fits_formulas = true;
  /// Whether it runs on nets; derivative-free minimisers do not.
  bool fits_nets = true;
};

/// Returns every minimiser of this program; to add one, add one line.
const std::vector<CertifiedSolver>& CertifiedSolvers();

}  // namespace errmap::models
