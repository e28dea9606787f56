#pragma once

#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/report_view.h"

namespace errmap::report {

/// The figures of a model's held-out residuals: predicted against measured,
/// against position, group and (where `inputs`) each used input, map, and the
/// report's Figures 7, 8 and 11. `prefix` begins the names of their files.
std::vector<Figure> ResidualFigures(const ReportView& view,
                                    const std::string& model,
                                    const std::string& holdout,
                                    const std::string& prefix,
                                    bool brief,
                                    std::size_t most_inputs);

/// Residual against position, or row where there is none: one of many.
Figure SmallResidualFigure(const ReportView& view,
                           const std::string& model,
                           const std::string& holdout,
                           const std::string& name);

}  // namespace errmap::report
