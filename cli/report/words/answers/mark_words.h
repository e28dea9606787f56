#pragma once

#include <string>

#include "cli/report/report_view.h"

namespace errmap::report {

/// What the marks beside models say: why the recommended one, "*", is taken,
/// also where others have a lower error, and what "=" has in common; of a
/// component with a recommendation.
std::string MarkWords(const ReportView& view);

}  // namespace errmap::report
