#pragma once

#include "data/measurements/dataset.h"
#include "models/study/study.h"

namespace errmap::models {

/// Whether sessions of `dataset`, and nothing coarser, are held out whole: it
/// counts as a hold-out of sessions then, whatever its SPEC.
bool IsOfSessions(const Holdout& holdout, const data::Dataset& dataset);

}  // namespace errmap::models
