#pragma once

#include <string>

#include "cli/json_blocks.h"
#include "fitting/minimisers/optimizer.h"

namespace errmap::cli {

/// {"stop","converged","message","iterations","evaluations",
/// "value_evaluations","gradient_evaluations","curvature_evaluations",
/// "initial_cost","final_cost","initial_gradient_norm","final_gradient_norm",
/// "mean_iteration_seconds","sd_iteration_seconds"}, and "trace" where there is
/// one: [[iteration, rms_error, gradient_norm], ...].
Json FitSummaryJson(const fitting::FitSummary& summary);

/// "stop: gradient (the gradient is small: a minimum)\n", and for an iterative
/// fit what it did and how long an iteration took (the report's Table 4).
std::string FitSummaryText(const fitting::FitSummary& summary);

}  // namespace errmap::cli
