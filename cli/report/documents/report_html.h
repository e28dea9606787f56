#pragma once

#include <string>

#include "cli/report/figures/figures.h"

namespace errmap::report {

/// report.html: one self-contained page drawn from the record alone, with the
/// figures of MakeFigures. Of a study that is incomplete or failed it says what
/// is not there.
std::string ReportHtml(const models::StudyRecord& record,
                       const FigureSet& figures);

}  // namespace errmap::report
