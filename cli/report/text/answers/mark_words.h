#pragma once

#include <string>

#include "cli/report/text/answers/component_numbers.h"

namespace errmap::report {

/// Returns why this map is recommended instead of the one of lowest error or a
/// single map; "" if it is the only one of its tier.
std::string WhyRecommended(const ComponentNumbers& component);

/// Explains the marks beside models, for a component with a recommendation. "*"
/// is the recommended one, and "=" marks those as good as the best. Adds why
/// "*" was chosen if others have a lower error.
std::string MarkWords(const ReportView& view);

}  // namespace errmap::report
