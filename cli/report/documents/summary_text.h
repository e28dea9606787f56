#pragma once

#include <string>

#include "data/units.h"
#include "stats/error_metrics.h"

namespace errmap::report {

/// Residual statistics as lines for a terminal, in the display unit.
std::string SummaryText(const stats::ErrorMetrics& metrics,
                        const data::Unit& unit,
                        double ks_d,
                        double ks_p_given);

}  // namespace errmap::report
