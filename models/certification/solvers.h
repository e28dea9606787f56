#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fitting/minimisers/optimizer.h"

namespace errmap::models {

/// A minimiser that is put to the proof.
struct CertifiedSolver {
  std::string name;
  std::function<std::unique_ptr<fitting::Optimizer>(
      const fitting::StoppingRules&)>
      make;
  bool needs_residuals = false;  // takes objectives in residual form only
  /// Takes the nets too; minimisers without derivatives are not asked to.
  bool fits_nets = true;
  /// Must reach the others' minimum of a net; the report's older methods and
  /// MMA, whose steps stay conservative to the end, are only shown.
  bool judged_on_nets = true;
};

/// Every minimiser of this program; one line adds one.
const std::vector<CertifiedSolver>& CertifiedSolvers();

}  // namespace errmap::models
