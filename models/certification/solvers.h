#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fitting/minimisers/optimizer.h"

namespace errmap::models {

/// What a minimiser must reach, by what its method can: somewhat below what it
/// reached when this was written, since its path follows the processor's
/// rounding. README.md has both.
struct SolverFloors {
  int solved = 0;                      // of the runs on NIST's problems
  double mean_lre_parameters = 0.0;    // over these runs
  double agreement_difference = 1e-8;  // of the damped net, at most
  double agreement_prediction = 1e-6;
};

/// A minimiser that is put to the proof.
struct CertifiedSolver {
  std::string name;
  std::function<std::unique_ptr<fitting::Optimizer>(
      const fitting::StoppingRules&)>
      make;
  SolverFloors floors;
  bool needs_residuals = false;  // takes objectives in residual form only
  /// Takes NIST's problems; a fixed rate of learning suits no parameters whose
  /// sizes differ by powers of ten.
  bool fits_formulas = true;
  /// Takes the nets too; minimisers without derivatives are not asked to.
  bool fits_nets = true;
};

/// Every minimiser of this program; one line adds one.
const std::vector<CertifiedSolver>& CertifiedSolvers();

}  // namespace errmap::models
