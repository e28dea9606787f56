#pragma once

#include <string>

#include "data/units.h"
#include "models/study/judgement/residual_assessment.h"
#include "stats/error_metrics.h"
#include "stats/report_1995.h"

namespace errmap::report {

/// Describes the residuals in sentences: their shape, how the 1995 program
/// would have judged them, whether they are independent, where they are biased.
/// Every sentence follows from the figures alone.
std::string ResidualSentences(const models::ResidualReport& report,
                              const stats::ErrorMetrics& summary,
                              const stats::Report1995Statistics& printed,
                              const data::Unit& unit);

}  // namespace errmap::report
