#pragma once

#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/report_view.h"

namespace errmap::report {

/// What was measured, in its order: temperatures and the error, sessions one
/// after another. A figure that the data do not allow is not made.
std::vector<Figure> MeasuredFigures(const ReportView& view,
                                    const std::string& prefix);

}  // namespace errmap::report
