#pragma once

#include <memory>
#include <vector>

#include "models/study/study.h"

namespace errmap::models {

/// Training and test rows of a fold: copies, kept only during its fit. Copies
/// of many folds would be many times as large as the data.
struct PreparedFold {
  data::Dataset training;
  std::shared_ptr<const data::Dataset> test;
};

PreparedFold PrepareFold(const data::Dataset& dataset,
                         const Holdout& holdout,
                         std::size_t fold);

/// A fit of one fold with its training metrics; the predictions are dropped.
struct FoldOutcome {
  FitOutcome fit;
  stats::ErrorMetrics train;
};

/// The training metrics are NaN if `outcome` lacks training predictions.
FoldOutcome JudgeFold(const data::Dataset& dataset,
                      const Holdout& holdout,
                      std::size_t fold,
                      FitOutcome outcome);

/// Largest error allowed: comparisons use mean squares, and squares of larger
/// errors would overflow when summed over many rows.
inline constexpr double kLargestRmse = 1e150;

/// Pools the folds of one model under one hold-out. The result is failed if any
/// fit failed.
HoldoutResult PoolFolds(const data::Dataset& dataset,
                        const Holdout& holdout,
                        std::vector<FoldOutcome> outcomes);

/// Computes the metrics of the held-out rows, for each fold and for all, from
/// the folds' predictions.
void PoolTest(const data::Dataset& dataset,
              const Holdout& holdout,
              HoldoutResult* result);

/// Returns metrics of `predicted` (m) against the targets of `dataset`; R2 is
/// about their mean.
stats::ErrorMetrics Judge(const data::Dataset& dataset,
                          const VectorXd& predicted);

}  // namespace errmap::models
