#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

/// A minimiser of Ceres Solver.
enum class CeresMethod {
  kAuto,  // kLevenbergMarquardt where a step of it is cheap, else kLbfgs
  kLevenbergMarquardt,
  kDogleg,
  kLbfgs,
  kBfgs,
  kNonlinearCg,
};

/// "auto", "levenberg_marquardt", ...: the words of `method=`, in the order of
/// the enumeration.
const std::vector<std::string>& CeresMethodNames();
std::string_view ToString(CeresMethod method);

/// Version of the Ceres Solver compiled against: "2.1.0".
std::string CeresVersion();

struct CeresOptions {
  StoppingRules stopping = {};
  CeresMethod method = CeresMethod::kAuto;
  /// Pairs of vectors that L-BFGS keeps; at least 1. More cost as much time as
  /// a gradient of a net, fewer cost iterations.
  int memory = 5;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Ceres Solver on our objectives, on one thread, silent, and held to our
/// StoppingRules by a GuardedRun; its own tolerances are switched off.
/// Levenberg and Marquardt's method and dogleg steps take the residuals with
/// their analytic Jacobian, the ridge as further residuals sqrt(ridge) x_i;
/// each point they ask for is also evaluated as the objective, and both are
/// counted.
///
/// kGradient is claimed only where our own evaluation confirms it; where Ceres
/// ends by itself, the summary says kNoDescent with Ceres' own text.
class CeresOptimizer final : public Optimizer {
 public:
  /// Throws std::invalid_argument where the options are out of range.
  explicit CeresOptimizer(CeresOptions options);

  /// "ceres:lbfgs", ...
  std::string name() const override;

  /// What kAuto means for this objective.
  CeresMethod MethodFor(const Objective& f) const;

 private:
  /// Throws std::invalid_argument where the method needs residuals and `f` has
  /// none.
  Minimum DoMinimize(const Objective& f,
                     const Eigen::VectorXd& x0,
                     const RunControl& run) const override;

  CeresOptions options_;
};

}  // namespace errmap::fitting
