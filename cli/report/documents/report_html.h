#pragma once

#include <string>

#include "cli/report/figures/figures.h"

namespace errmap::report {

/// Returns report.html: one self-contained page drawn from the record alone,
/// with the figures of MakeFigures. For an incomplete or failed study, it says
/// what is missing.
std::string ReportHtml(const models::StudyRecord& record,
                       const FigureSet& figures);

}  // namespace errmap::report
