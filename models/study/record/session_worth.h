#pragma once

#include <optional>

#include "models/study/record/recommendation_record.h"
#include "models/study/study.h"

namespace errmap::models {

/// Fits `recipe` anew to the training rows of every fold of `holdout`, which
/// holds whole sessions out, less one of their sessions (another from fold to
/// fold), and compares its error on the fold's test rows with that in `result`.
/// None where there are fewer than four sessions or more than 50, of which one
/// more is worth no fit, or where a fit fails or is interrupted. The fits run
/// on options.jobs threads, which changes no bit.
std::optional<SessionWorth> WorthOfASession(const data::Dataset& dataset,
                                            const Holdout& holdout,
                                            const ModelRecipe& recipe,
                                            const HoldoutResult& result,
                                            const StudyOptions& options);

}  // namespace errmap::models
