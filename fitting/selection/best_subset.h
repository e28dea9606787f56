#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fitting/information_criteria.h"
#include "fitting/selection/selection_state.h"

namespace errmap::fitting {

struct BestSubsetOptions {
  /// kAic, kAicc, kBic, kAdjustedR2 or kCp: those that follow from the
  /// residual sum of squares and the number of terms.
  Criterion criterion = Criterion::kBic;
  /// Most terms; below 0: no limit but the rows.
  Eigen::Index max_terms = -1;
  /// Error variance for Cp; NaN: that of the model of all candidates.
  double sigma2 = std::numeric_limits<double>::quiet_NaN();
  /// Candidates that the earlier ones determine to this are passed over; above
  /// 0, below 1.
  double collinearity = 1e-7;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

struct BestSubsetResult {
  std::vector<Eigen::Index> chosen;   // columns, ascending
  std::vector<Eigen::Index> aliased;  // passed over
  double criterion = 0.0;             // its value (adjusted R2: as it is)
  std::int64_t nodes = 0;             // of the tree that were looked at
  bool complete = true;               // false: interrupted, the best so far
};

/// The subset of the candidates (with `include` always in) that is best by
/// `options.criterion` among all 2^m, by branch and bound over a tree of
/// triangles from which columns are dropped (Furnival and Wilson 1974; Gatu
/// and Kontoghiorghes 2006): a branch is cut where even all its columns, at the
/// price of its fewest, do not beat the best so far. Practical up to about 40
/// candidates.
///
/// Throws std::invalid_argument on bad shapes or options and where `include`
/// has more terms than rows.
BestSubsetResult SelectBestSubset(
    const SelectionProblem& problem,
    const std::vector<Eigen::Index>& include,
    const std::vector<bool>& excluded,
    const BestSubsetOptions& options,
    const std::atomic<bool>* stop_token = nullptr);

}  // namespace errmap::fitting
