#pragma once

#include <cstddef>

#include "cli/json_blocks.h"
#include "cli/study_file/comparison.h"

namespace errmap::cli {

// Blocks of results.json that say how the models compare; lengths are in the
// target's unit, what is not finite becomes null.

/// {"unit": "um", "scale": 1000}: value * scale is what people read.
Json DisplayJson(const Comparison& comparison);

/// {"unit_of_analysis", "units", "unit_labels"} of hold-out `h`.
Json UnitsJson(const Comparison& comparison, std::size_t h);

/// {"ci95", "tier", "meets_goal", "goal_standing", "unit_rmse"} of a model
/// under hold-out `h`.
Json StandingJson(const Comparison& comparison,
                  std::size_t model,
                  std::size_t h);

/// Whether a net learns noise; null for other models.
Json MemorisationJson(const models::ModelResult& model);

Json GapJson(const Comparison& comparison);
Json ComparisonsJson(const Comparison& comparison);
Json TiersJson(const Comparison& comparison);
Json StabilityJson(const Comparison& comparison);
Json VerdictsJson(const Comparison& comparison);
Json RecommendationJson(const Comparison& comparison);

}  // namespace errmap::cli
