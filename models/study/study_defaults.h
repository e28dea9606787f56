#pragma once

#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/study/study.h"

namespace errmap::models {

// What a study does where nobody says otherwise.

/// SPECs of the hold-outs: rows, and whatever can be held out whole. Groups
/// that are cut as sessions are (IsOfSessions) are held out as sessions. Two or
/// three of these are too few to decide, so without groups blocks stand beside
/// them; more are also foreseen from those before them.
std::vector<std::string> DefaultHoldouts(const data::Dataset& dataset);

/// The same where each of `holdouts`, which somebody chose, judges by a file
/// that holds rows of training, and so tells nothing; else none.
std::vector<std::string> HoldoutsBeside(const std::vector<Holdout>& holdouts,
                                        const data::Dataset& dataset);

/// That of them which a map may promise by: whole sessions where there are two
/// or more, else whole groups, else blocks.
std::string StrictestDefaultHoldout(const data::Dataset& dataset);

/// Difference in RMSE that never matters, in `unit`: of lengths 0.02 um, of all
/// else 0.
double DefaultIndifference(const data::Unit& unit);

}  // namespace errmap::models
