#pragma once

#include <vector>

#include <Eigen/Core>

#include "models/study/study.h"

namespace errmap::models {

/// Of the rows that each fold holds out, in its order, whether an input of the
/// map lies outside what the fold was trained on: there it extrapolates.
std::vector<Eigen::Array<bool, Eigen::Dynamic, 1>> ExtrapolatedRows(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const FittedModel& map);

}  // namespace errmap::models
