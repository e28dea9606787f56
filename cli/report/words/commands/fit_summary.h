#pragma once

#include <string>

#include "fitting/minimisers/fit_summary.h"

namespace errmap::report {

/// "stop: gradient (the gradient is small: a minimum)\n", and for an iterative
/// fit what it did and how long an iteration took (the report's Table 4).
std::string FitSummaryText(const fitting::FitSummary& summary);

}  // namespace errmap::report
