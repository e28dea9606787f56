#pragma once

#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/report_view.h"

namespace errmap::report {

/// Error of every model under each hold-out: the figure that decides.
Figure GapFigure(const ReportView& view, const std::string& prefix);

/// sqrt(2 E) against iteration for every net (the report's Figures 10-24), a
/// few nets in each figure; empty if no model iterates.
std::vector<Figure> TrainingFigures(const ReportView& view,
                                    const std::string& prefix);

}  // namespace errmap::report
