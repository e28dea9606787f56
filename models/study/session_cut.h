#pragma once

#include "data/measurements/dataset.h"
#include "models/study/study.h"

namespace errmap::models {

/// True if whole sessions of `dataset`, and nothing coarser, are held out. It
/// then counts as a hold-out of sessions, whatever its SPEC.
bool IsOfSessions(const Holdout& holdout, const data::Dataset& dataset);

}  // namespace errmap::models
