#pragma once

#include <vector>

#include <Eigen/Core>

#include "fitting/selection/selection_state.h"

namespace errmap::fitting {

/// Every candidate with the chosen terms swept out of it, held as a matrix
/// (n x m): for criteria that need the rows of each candidate, such as PRESS
/// and cross-validation, which no two numbers per candidate can give.
class SweptCandidates {
 public:
  /// `fitted` (n): rows that are fitted; `held_out` (n): rows, none of them
  /// fitted, that HeldOutErrorAfterEntry judges.
  SweptCandidates(const SelectionProblem& problem,
                  const std::vector<bool>& fitted,
                  const std::vector<bool>& held_out,
                  double collinearity);

  /// Rebuilds for another set of terms, or goes on where `chosen` only grew.
  void Follow(const std::vector<Eigen::Index>& chosen);

  /// Of each candidate in `open`: PRESS after its entry, sum over rows of
  /// (e / (1 - h))^2; infinite where a leverage is 1, for candidates that the
  /// chosen terms determine, and for those not open. All rows are fitted.
  Eigen::VectorXd PressAfterEntry(const Eigen::VectorXd& leverage,
                                  const std::vector<bool>& open) const;

  /// Of each candidate in `open`: squared error on the rows held out after its
  /// entry. A candidate that the fitted rows determine adds nothing there.
  Eigen::VectorXd HeldOutErrorAfterEntry(const std::vector<bool>& open) const;

 private:
  void Reset();
  void SweepOut(const Eigen::VectorXd& column);
  double SquaredRest(Eigen::Index candidate) const;

  const SelectionProblem& problem_;
  double collinearity_;
  Eigen::VectorXd fitted_;    // (n) 1 or 0
  Eigen::VectorXd held_out_;  // (n) 1 or 0
  bool all_fitted_;
  Eigen::VectorXd roots_;  // (n)
  Eigen::MatrixXd rest_;   // (n x m)
  Eigen::VectorXd least_;  // (m) squared lengths of the collinear
  Eigen::VectorXd error_;  // (n) sqrt(w) (y - fit), in all rows
  std::vector<Eigen::Index> chosen_;
};

}  // namespace errmap::fitting
