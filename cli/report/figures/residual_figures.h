#pragma once

#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/report_view.h"

namespace errmap::report {

/// The figures of a model's held-out residuals: predicted against measured;
/// residuals against position, group and the most correlated inputs; map; the
/// report's Figures 7 and 11. `prefix` begins the names of their files.
std::vector<Figure> ResidualFigures(const ReportView& view,
                                    const std::string& model,
                                    const std::string& holdout,
                                    const std::string& prefix,
                                    bool brief);

}  // namespace errmap::report
