#pragma once

#include <optional>

#include "models/study/record/recommendation_record.h"
#include "models/study/study.h"

namespace errmap::models {

/// Refits `recipe` to the training rows of every fold of `holdout` without one
/// of their sessions (another in each fold). Compares its error on the fold's
/// test rows with that in `result`. Needs whole sessions held out, 4 to 50 of
/// them (beyond, one more is not worth a fit), and fits that all succeed; else
/// returns nothing. Fits run on options.jobs threads, without effect on the
/// result.
std::optional<SessionWorth> WorthOfASession(const data::Dataset& dataset,
                                            const Holdout& holdout,
                                            const ModelRecipe& recipe,
                                            const HoldoutResult& result,
                                            const StudyOptions& options);

}  // namespace errmap::models
