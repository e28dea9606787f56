#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

/// A minimiser of NLopt, under NLopt's name.
enum class NloptMethod {
  kLbfgs,                  // LD_LBFGS
  kTnewtonPrecondRestart,  // LD_TNEWTON_PRECOND_RESTART
  kVar2,                   // LD_VAR2
  kSlsqp,                  // LD_SLSQP
  kMma,                    // LD_MMA
  kSbplx,                  // LN_SBPLX: values only
  kCrs2Lm,                 // GN_CRS2_LM: random search in a box
};

/// "lbfgs", "tnewton_precond_restart", ...: the words of `method=`, in the
/// order of the enumeration.
const std::vector<std::string>& NloptMethodNames();
std::string_view ToString(NloptMethod method);

/// Version of the NLopt in use: "2.7.1".
std::string NloptVersion();

struct NloptOptions {
  StoppingRules stopping = {};
  NloptMethod method = NloptMethod::kLbfgs;
  /// Pairs of vectors that lbfgs, tnewton_precond_restart and var2 keep; at
  /// least 1. NLopt's own choice fills 10 MB: 560 pairs for 2341 parameters,
  /// and each iteration reads them all.
  int memory = 5;
  /// crs2_lm searches |x_i - x0_i| <= box * max(1, |x0_i|); above 0.
  double box = 10.0;
  /// Of crs2_lm, the only random one.
  std::uint64_t seed = 1;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// NLopt on our objectives, held to our StoppingRules by a GuardedRun; its own
/// tolerances are switched off. Methods without derivatives are given none, but
/// the gradient is evaluated with each value all the same, so that their
/// minimum is judged like any other.
///
/// kGradient is claimed only where our own evaluation confirms it; where NLopt
/// ends by itself (round-off and failure included), the best point seen is kept
/// and the summary says kNoDescent with NLopt's own words.
class NloptOptimizer final : public Optimizer {
 public:
  /// crs2_lm searches no more than these.
  static constexpr Eigen::Index kMostCrs2Parameters = 100;

  /// Throws std::invalid_argument where the options are out of range.
  explicit NloptOptimizer(NloptOptions options);

  /// "nlopt:lbfgs", ...
  std::string name() const override;

 private:
  /// Throws std::invalid_argument where crs2_lm is given more parameters than
  /// it can search.
  Minimum DoMinimize(const Objective& f,
                     const Eigen::VectorXd& x0,
                     const RunControl& run) const override;

  NloptOptions options_;
};

}  // namespace errmap::fitting
