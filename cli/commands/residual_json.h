#pragma once

#include "cli/json_blocks.h"
#include "models/study/judgement/residual_assessment.h"

namespace errmap::cli {

/// Figures for plots: standardised residuals in measured order (Eq. 137), the
/// Tukey-lambda curve, the normal probability plot and the histogram (`bins` 0:
/// Freedman-Diaconis) of `values`.
Json PlotsJson(const models::ResidualReport& report,
               const Eigen::VectorXd& values,
               Eigen::Index bins);

}  // namespace errmap::cli
