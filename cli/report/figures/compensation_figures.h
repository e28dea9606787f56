#pragma once

#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/report_view.h"

namespace errmap::report {

/// The recommended map's effect on the machine's error, on held-out rows. Shows
/// the error over position before and after, the remaining error over the time
/// of day, and the error by day or cycle with what differs on the worst. Omits
/// figures that the data do not allow.
std::vector<Figure> CompensationFigures(const ReportView& view,
                                        const std::string& prefix);

}  // namespace errmap::report
