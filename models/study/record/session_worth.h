#pragma once

#include <optional>

#include "models/study/study.h"

namespace errmap::models {

/// What sessions of measurements are worth to a map.
struct SessionWorth {
  Eigen::Index sessions = 0;  // that the map was fitted to
  Eigen::Index folds = 0;     // that could be compared
  /// Held-out error with one session fewer in training over that without,
  /// geometric mean over folds.
  double ratio_of_one_fewer = 0.0;
  /// What a power law through both makes of one session more: its error over
  /// today's, at most 1.
  double ratio_of_one_more = 0.0;
};

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
