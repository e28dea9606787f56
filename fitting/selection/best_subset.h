#pragma once

#include <cstdint>
#include <vector>

#include "fitting/information_criteria.h"
#include "fitting/selection/selection_state.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::fitting {

struct BestSubsetOptions {
  /// kAic, kAicc, kBic, kAdjustedR2 or kCp: criteria that depend only on the
  /// residual sum of squares and the number of terms.
  Criterion criterion = Criterion::kBic;
  /// Maximum number of terms; below 0: limited only by the rows.
  Index max_terms = -1;
  /// Error variance for Cp; NaN: that of the model with all candidates.
  double sigma2 = stats::kNaN;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

struct BestSubsetResult {
  std::vector<Index> chosen;   // columns, ascending
  std::vector<Index> aliased;  // skipped (kCollinear)
  double criterion = 0.0;      // its value; adjusted R2 is not negated
  std::int64_t nodes = 0;      // number of tree nodes visited
  bool complete = true;        // false: interrupted, best so far
};

/// Returns the best subset of the candidates by `options.criterion` among all
/// 2^m, with `include` always in. Uses branch and bound over a tree of
/// triangles from which columns are dropped (Furnival and Wilson 1974; Gatu and
/// Kontoghiorghes 2006). A branch is cut if its lower bound does not beat the
/// best so far: the fit of all its columns with the penalty of the fewest.
/// Practical up to about 40 candidates.
///
/// Throws std::invalid_argument for bad shapes or options, or if `include` has
/// more terms than rows.
BestSubsetResult SelectBestSubset(const RegressionProblem& problem,
                                  const std::vector<Index>& include,
                                  const std::vector<bool>& excluded,
                                  const BestSubsetOptions& options);

}  // namespace errmap::fitting
