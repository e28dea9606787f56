#pragma once

#include <optional>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/map_experience.h"
#include "models/study/study.h"

namespace errmap::models {

/// Of a model's predictions of `holdout`'s held-out rows; nothing where
/// PromiseOf has nothing.
std::optional<HeldOutErrors> HeldOutErrorsOf(const data::Dataset& dataset,
                                             const Holdout& holdout,
                                             const HoldoutResult& result);

/// Time since the first row of its session, for each row; zeros without a log.
Eigen::VectorXd ElapsedOf(const data::Dataset& dataset);

}  // namespace errmap::models
