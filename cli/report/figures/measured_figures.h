#pragma once

#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/report_view.h"

namespace errmap::report {

/// The measurements in their order: temperatures and the error, session after
/// session. Omits figures that the data do not allow.
std::vector<Figure> MeasuredFigures(const ReportView& view,
                                    const std::string& prefix);

}  // namespace errmap::report
