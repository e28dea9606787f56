#pragma once

#include <memory>
#include <vector>

#include "models/study/study.h"

namespace errmap::models {

/// Training and test rows of a fold, made once and shared by all models.
struct PreparedFold {
  data::Dataset training;
  std::shared_ptr<const data::Dataset> test;
};

/// One list per hold-out.
std::vector<std::vector<PreparedFold>> PrepareFolds(
    const data::Dataset& dataset, const std::vector<Holdout>& holdouts);

/// Pools the folds of one model under one hold-out; failed where one of its
/// fits did. An outcome without training predictions has NaN for them.
HoldoutResult PoolFolds(const Holdout& holdout,
                        const std::vector<PreparedFold>& prepared,
                        std::vector<FitOutcome> outcomes);

/// Metrics of `predicted` (m) against the targets of `dataset`, R2 about its
/// own mean.
stats::ErrorMetrics Judge(const data::Dataset& dataset,
                          const Eigen::VectorXd& predicted);

}  // namespace errmap::models
