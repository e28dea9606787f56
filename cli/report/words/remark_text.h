#pragma once

#include <cstddef>
#include <string>

#include "cli/report/words/component_numbers.h"

namespace errmap::report {

/// The sentence of a ground or doubt of the recommendation.
std::string RemarkText(const ComponentNumbers& component,
                       const models::RemarkRecord& remark);

/// What it costs names so many sensors at most.
inline constexpr std::size_t kMostSensorsNamed = 8;

/// "elapsed_cycles below 7 or above 27"; "" where nothing is known.
std::string WhereToMeasure(const models::RemarkRecord& remark);

/// What a goal was held against: "RMSE 4.98 um, scatter 0.2 um about an offset
/// of 4.97 um"; "" without a goal.
std::string GoalFigures(const models::ResultRecord& result,
                        const ErrorText& error);

}  // namespace errmap::report
