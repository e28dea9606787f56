#pragma once

#include <memory>
#include <vector>

#include "models/study/study.h"

namespace errmap::models {

/// Training and test rows of a fold: copies, to be had while it is fitted only.
/// Of many folds they would be many times the data.
struct PreparedFold {
  data::Dataset training;
  std::shared_ptr<const data::Dataset> test;
};

PreparedFold PrepareFold(const data::Dataset& dataset,
                         const Holdout& holdout,
                         std::size_t fold);

/// A fit of one fold, its predictions of the training rows judged and gone.
struct FoldOutcome {
  FitOutcome fit;
  stats::ErrorMetrics train;
};

/// NaN for training predictions that `outcome` lacks.
FoldOutcome JudgeFold(const data::Dataset& dataset,
                      const Holdout& holdout,
                      std::size_t fold,
                      FitOutcome outcome);

/// Comparisons work with mean squares: those of larger errors, summed over any
/// number of rows, are no number any more.
inline constexpr double kLargestRmse = 1e150;

/// Pools the folds of one model under one hold-out; failed where one of its
/// fits did.
HoldoutResult PoolFolds(const data::Dataset& dataset,
                        const Holdout& holdout,
                        std::vector<FoldOutcome> outcomes);

/// Figures of the held-out rows, of each fold and of all, from the folds'
/// predictions of them.
void PoolTest(const data::Dataset& dataset,
              const Holdout& holdout,
              HoldoutResult* result);

/// Metrics of `predicted` (m) against the targets of `dataset`, R2 about its
/// own mean.
stats::ErrorMetrics Judge(const data::Dataset& dataset,
                          const Eigen::VectorXd& predicted);

}  // namespace errmap::models
