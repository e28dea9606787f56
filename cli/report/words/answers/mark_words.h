#pragma once

#include <string>

#include "cli/report/words/answers/component_numbers.h"

namespace errmap::report {

/// Why this map is recommended, and not the one of the lowest error or a single
/// one; "" where it is the only one of its tier.
std::string WhyRecommended(const ComponentNumbers& component);

/// What the marks beside models say: why the recommended one, "*", is taken,
/// also where others have a lower error, and what "=" has in common; of a
/// component with a recommendation.
std::string MarkWords(const ReportView& view);

}  // namespace errmap::report
