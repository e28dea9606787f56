#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/prediction_interval.h"
#include "models/study/study.h"
#include "stats/eigen.h"

namespace errmap::models {

/// The half-width that holds `coverage` of the errors of a further unit, drawn
/// as these were, on average over such units: the quantile of |residual| over
/// all rows, in which every unit weighs the same, times Student's t over the
/// normal's quantile. The degrees of freedom are UnitFreedom of the units' mean
/// squares: few where units differ as if each were one error, more where all
/// err alike.
///
/// No interval that assumes nothing of how units differ is as narrow, and with
/// fewer than 9 units for 0.9, 19 for 0.95, there is none at all (Dunn,
/// Wasserman & Ramdas 2022): the level is then marked at_least. `units` (n)
/// number the unit of each residual from 0, in any order. NaN residuals and
/// fewer than two units make NaN.
PredictionInterval::Level UnitIntervalLevel(const VectorXd& residuals,
                                            const std::vector<Index>& units,
                                            double coverage);

/// The promise of a model from its predictions of `holdout`'s held-out rows;
/// nothing where they fall into fewer than two units, or lie between rows that
/// it was fitted to. Of six sessions or more that do not exclude a memory of
/// 0.7 from one to the next, `good_for` says for how many to come it is, and
/// levels are as much wider as these are further from what was measured.
/// `inside`, asked once there are units, tells of each of these rows whether it
/// is inside of what its fold was trained on (InsideOfFolds): rows inside and
/// outside then have half-widths of their own, as UnitIntervalLevel of such
/// rows alone but inside no more and outside no less than that of all, unless
/// the inside has the larger or one of them is in fewer than two units.
std::optional<PredictionInterval> PromiseOf(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const HoldoutResult& result,
    const std::function<std::vector<bool>()>& inside = {});

}  // namespace errmap::models
