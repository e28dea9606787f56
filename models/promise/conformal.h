#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/prediction_interval.h"
#include "models/study/study.h"

namespace errmap::models {

/// The share 1 - coverage of a further unit, drawn as these were, is exceeded
/// by at most: of each unit's own quantile of |residual| the conformal quantile
/// over units (Vovk, Gammerman & Shafer 2005), the ceil((m + 1) coverage)-th
/// smallest of m. 0.9 needs 9 units and 0.95 needs 19; with fewer the largest,
/// marked at_least. `units` (n) number the unit of each residual from 0, in any
/// order. NaN residuals make NaN.
PredictionInterval::Level ConformalLevel(const Eigen::VectorXd& residuals,
                                         const std::vector<Eigen::Index>& units,
                                         double coverage);

/// The promise of a model from its predictions of `holdout`'s held-out rows;
/// nothing where they fall into fewer than two units, or lie between rows that
/// it was fitted to.
std::optional<PredictionInterval> PromiseOf(const data::Dataset& dataset,
                                            const Holdout& holdout,
                                            const HoldoutResult& result);

}  // namespace errmap::models
