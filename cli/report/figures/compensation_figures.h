#pragma once

#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/report_view.h"

namespace errmap::report {

/// What the recommended map does to the machine's error, on rows that its fits
/// have not seen: the error over the position before and after, what is left
/// over the time of day, and the error by day or cycle with what differs on the
/// worst. A figure that the data do not allow is not made.
std::vector<Figure> CompensationFigures(const ReportView& view,
                                        const std::string& prefix);

}  // namespace errmap::report
