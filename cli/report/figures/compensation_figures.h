#pragma once

#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/report_view.h"

namespace errmap::report {

// What the recommended map does to the machine's error, on rows that its fits
// have not seen. A figure that the data do not allow is not made.

/// Measured and predicted over time, or row by row; sessions parted, rows
/// outside the trained range marked.
std::vector<Figure> OverTimeFigures(const ReportView& view,
                                    const std::string& prefix);

/// Measured, mapped and left error over position and the sensor that says most
/// of it, on one scale of colours.
std::vector<Figure> SurfaceFigures(const ReportView& view,
                                   const std::string& prefix);

/// Error by position before and after compensation, with bands of two standard
/// deviations.
std::vector<Figure> BeforeAndAfterFigures(const ReportView& view,
                                          const std::string& prefix);

/// RMSE of each unit for the three models of lowest error.
std::vector<Figure> UnitFigures(const ReportView& view,
                                const std::string& prefix);

/// Residuals of the fit to all rows and of held-out rows together.
std::vector<Figure> TrainingResidualFigures(const ReportView& view,
                                            const std::string& prefix);

/// Error against what a step costs on a controller, for every map.
std::vector<Figure> CostFigures(const ReportView& view,
                                const std::string& prefix);

}  // namespace errmap::report
