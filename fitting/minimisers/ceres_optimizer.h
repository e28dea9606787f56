#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fitting/minimisers/optimizer.h"

namespace errmap::fitting {

/// A minimiser of Ceres Solver.
enum class CeresMethod {
  kAuto,  // kLevenbergMarquardt if its steps are cheap, else kLbfgs
  kLevenbergMarquardt,
  kDogleg,
  kLbfgs,
  kBfgs,
  kNonlinearCg,
};

/// "auto", "levenberg_marquardt", ...: values of `method=`, in the order of the
/// enumeration.
const std::vector<std::string>& CeresMethodNames();
std::string_view ToString(CeresMethod method);

/// Version of Ceres Solver at compile time: "2.1.0".
std::string CeresVersion();

struct CeresOptions {
  StoppingRules stopping = {};
  CeresMethod method = CeresMethod::kAuto;
  /// Number of vector pairs that L-BFGS keeps; at least 1. More pairs take as
  /// long as a gradient of a net; fewer pairs cost iterations.
  int memory = 5;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Ceres Solver for our objectives: on one thread, without output, under our
/// StoppingRules by a GuardedRun. Its own tolerances are switched off.
/// Levenberg-Marquardt and dogleg steps use the residuals with their analytic
/// Jacobian, and the ridge as further residuals sqrt(ridge) x_i. Each point
/// they request is also evaluated as the objective; both evaluations are
/// counted.
///
/// Claims kGradient only if our own evaluation confirms it. If Ceres stops by
/// itself, the summary says kNoDescent with Ceres' own text.
class CeresOptimizer final : public OptimizerWith<CeresOptions> {
 public:
  explicit CeresOptimizer(CeresOptions options) : OptimizerWith(options) {}

  /// "ceres:lbfgs", ...
  std::string name() const override;

  /// Returns the method that kAuto selects for this objective.
  CeresMethod MethodFor(const Objective& f) const;

 private:
  /// Throws std::invalid_argument if the method needs residuals and `f` has
  /// none.
  Minimum DoMinimize(const Objective& f,
                     const VectorXd& x0,
                     const RunControl& run) const override;
};

}  // namespace errmap::fitting
