#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/prediction_interval.h"
#include "models/study/study.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Returns the half-width that holds `coverage` of the errors of a further
/// unit, drawn like these, on average over such units. It is the quantile of
/// |residual| over all rows, with equal weight for every unit, times Student's
/// t over the normal quantile. The degrees of freedom are SatterthwaiteDof of
/// the units' mean squares: few if the units differ much, more if all have
/// similar errors.
///
/// An interval without assumptions on how units differ is wider. With fewer
/// than 9 units for 0.9, 19 for 0.95, there is none (Dunn, Wasserman & Ramdas
/// 2022); the level is then marked at_least. `units` (n) number the unit of
/// each residual from 0, in any order. Returns NaN for NaN residuals or fewer
/// than two units.
PredictionInterval::Level UnitIntervalLevel(const VectorXd& residuals,
                                            const std::vector<Index>& units,
                                            double coverage);

/// Returns the interval of a model from its predictions of `holdout`'s held-out
/// rows. Returns nothing if they are in fewer than two units, or lie between
/// training rows. For six sessions or more that do not exclude a memory of 0.7
/// between neighbours, `good_for` says for how many future sessions it holds.
/// The half-widths are then wider, since these sessions are further from the
/// measured ones. `inside`, called once there are units, returns which rows are
/// inside the training data of their fold (InsideOfFolds). Rows inside and
/// outside then have their own half-widths, each by UnitIntervalLevel of such
/// rows. The one inside is at most that of all rows, the one outside at least.
/// Both stay equal if the one inside is larger, or if either is from fewer than
/// two units.
std::optional<PredictionInterval> PredictionIntervalOf(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const HoldoutResult& result,
    const std::function<std::vector<bool>()>& inside = {});

}  // namespace errmap::models
