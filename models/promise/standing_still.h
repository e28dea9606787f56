#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/map_experience.h"

namespace errmap::models {

/// From the rows of training, session by session in their order; `columns` (s)
/// are inputs of it. Thermometers are watched that moved as others did. Such a
/// column is given three times what the others moved while it held a value
/// there, what moves it by five steps of its resolution, and 0.05 at least: of
/// healthy sensors in steps of 0.01 K those move by 0.004.
///
/// Sensors that have noise go up and down by a step even where nothing warms: a
/// column and all of them together are quiet for no longer than three times
/// what lay between two such turns in training, ten rows at least. One that
/// kept from turning for more than ten rows has no noise to go by; all of them
/// without are silent for as long as a session.
StandingStill LearnStandingStill(const data::Dataset& training,
                                 const std::vector<Eigen::Index>& columns);

}  // namespace errmap::models
