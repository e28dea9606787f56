#pragma once

#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/report_view.h"

namespace errmap::report {

/// Held-out error of the recommended map without each of its sensors, and
/// without alike sensors; none if the record lacks it.
std::vector<Figure> ImportanceFigures(const ReportView& view,
                                      const std::string& prefix);

}  // namespace errmap::report
