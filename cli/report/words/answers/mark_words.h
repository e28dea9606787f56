#pragma once

#include <string>

#include "cli/report/words/answers/component_numbers.h"

namespace errmap::report {

/// Says why this map is recommended, and not the one of lowest error or a
/// single one; "" if it is the only one of its tier.
std::string WhyRecommended(const ComponentNumbers& component);

/// Explains the marks beside models, for a component with a recommendation. "*"
/// is the recommended one, and "=" marks those as good as the best. Says why
/// "*" was chosen if others have a lower error.
std::string MarkWords(const ReportView& view);

}  // namespace errmap::report
