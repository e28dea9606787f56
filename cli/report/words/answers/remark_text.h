#pragma once

#include <cstddef>
#include <string>

#include "cli/report/words/answers/component_numbers.h"

namespace errmap::report {

/// The sentence of a ground or doubt of the recommendation.
std::string RemarkText(const ComponentNumbers& component,
                       const models::RemarkRecord& remark);

/// What it costs names so many sensors at most.
inline constexpr std::size_t kMostSensorsNamed = 8;

/// "elapsed_cycles below 7 or above 27"; "" where nothing is known.
std::string WhereToMeasure(const models::RemarkRecord& remark);

}  // namespace errmap::report
