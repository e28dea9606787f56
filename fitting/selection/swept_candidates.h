#pragma once

#include <vector>

#include "fitting/selection/selection_state.h"
#include "stats/eigen.h"

namespace errmap::fitting {

/// Every candidate with the chosen terms swept out, stored as a matrix (n x m).
/// For criteria that need all rows of each candidate, such as PRESS and
/// cross-validation.
class SweptCandidates {
 public:
  /// `fitted` (n): true for rows to fit. `held_out` (n): true for rows, none of
  /// them fitted, on which HeldOutErrorAfterEntry computes the error.
  SweptCandidates(const RegressionProblem& problem,
                  const std::vector<bool>& fitted,
                  const std::vector<bool>& held_out);

  /// Switches to the terms `chosen`; cheap if it only grew, else rebuilds.
  void Follow(const std::vector<Index>& chosen);

  /// Returns PRESS, the sum over rows of (e / (1 - h))^2, after entry of each
  /// candidate. Infinite if a leverage is 1, if the chosen terms determine the
  /// candidate, or if it is not `open`. All rows must be fitted.
  VectorXd PressAfterEntry(const VectorXd& leverage,
                           const std::vector<bool>& open) const;

  /// Returns the squared error on the held-out rows after entry of each
  /// candidate in `open`. A candidate that the chosen terms determine on the
  /// fitted rows adds nothing.
  VectorXd HeldOutErrorAfterEntry(const std::vector<bool>& open) const;

 private:
  void Reset();
  void SweepOut(const VectorXd& column);
  double SquaredRest(Index candidate) const;

  const RegressionProblem& problem_;
  VectorXd fitted_;    // (n) 1 or 0
  VectorXd held_out_;  // (n) 1 or 0
  bool all_fitted_;
  VectorXd roots_;  // (n)
  MatrixXd rest_;   // (n x m)
  VectorXd least_;  // (m) squared lengths that count as collinear
  VectorXd error_;  // (n) sqrt(w) (y - fit), in all rows
  std::vector<Index> chosen_;
};

}  // namespace errmap::fitting
