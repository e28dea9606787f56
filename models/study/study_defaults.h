#pragma once

#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/study/study.h"

namespace errmap::models {

// Defaults of a study.

/// Returns SPECs of the default hold-outs: rows, and each unit that can be held
/// out whole. Groups equal to sessions (IsOfSessions) are held out as sessions.
/// Fewer than four sessions cannot decide, so blocks are added if there are no
/// groups. With four or more, later sessions are also predicted from earlier
/// ones.
std::vector<std::string> DefaultHoldouts(const data::Dataset& dataset);

/// Returns DefaultHoldouts if every chosen hold-out uses a test file that
/// contains training rows, and so is worthless. Else returns nothing.
std::vector<std::string> HoldoutsBeside(const std::vector<Holdout>& holdouts,
                                        const data::Dataset& dataset);

/// Returns the default hold-out for predicted errors: whole sessions if there
/// are at least two, else whole groups, else blocks.
std::string StrictestDefaultHoldout(const data::Dataset& dataset);

/// Returns the difference in RMSE that does not matter, in `unit`: 0.02 um for
/// lengths, 0 otherwise.
double DefaultIndifference(const data::Unit& unit);

}  // namespace errmap::models
