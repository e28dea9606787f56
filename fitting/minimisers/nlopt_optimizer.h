#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

/// A minimiser of NLopt, with NLopt's name.
enum class NloptMethod {
  kLbfgs,                  // LD_LBFGS
  kTnewtonPrecondRestart,  // LD_TNEWTON_PRECOND_RESTART
  kVar2,                   // LD_VAR2
  kSlsqp,                  // LD_SLSQP
  kMma,                    // LD_MMA
  kSbplx,                  // LN_SBPLX: values only
  kCrs2Lm,                 // GN_CRS2_LM: random search in a box
};

/// "lbfgs", "tnewton_precond_restart", ...: values of `method=`, in the order
/// of the enumeration.
const std::vector<std::string>& NloptMethodNames();
std::string_view ToString(NloptMethod method);

/// Version of the NLopt in use: "2.7.1".
std::string NloptVersion();

struct NloptOptions {
  StoppingRules stopping = {};
  NloptMethod method = NloptMethod::kLbfgs;
  /// Number of vector pairs kept by lbfgs, tnewton_precond_restart and var2; at
  /// least 1. NLopt's own choice fills 10 MB: 560 pairs for 2341 parameters,
  /// all of which each iteration reads.
  int memory = 5;
  /// crs2_lm searches |x_i - x0_i| <= box * max(1, |x0_i|); above 0.
  double box = 10.0;
  /// Seed of crs2_lm, the only random method.
  std::uint64_t seed = 1;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// NLopt for our objectives, under our StoppingRules by a GuardedRun. Its own
/// tolerances are switched off. Derivative-free methods get none, but the
/// gradient is still evaluated with each value, so their minimum is checked
/// like any other.
///
/// Claims kGradient only if our own evaluation confirms it. If NLopt ends by
/// itself (also by round-off or failure), the result is the best point found,
/// and the summary says kNoDescent with NLopt's own text.
class NloptOptimizer final : public OptimizerWith<NloptOptions> {
 public:
  /// Maximum number of parameters that crs2_lm searches.
  static constexpr Index kMostCrs2Parameters = 100;

  explicit NloptOptimizer(NloptOptions options) : OptimizerWith(options) {}

  /// "nlopt:lbfgs", ...
  std::string name() const override;

 private:
  /// Throws std::invalid_argument if crs2_lm is given more parameters than
  /// kMostCrs2Parameters.
  Minimum DoMinimize(const Objective& f,
                     const VectorXd& x0,
                     const RunControl& run) const override;
};

}  // namespace errmap::fitting
