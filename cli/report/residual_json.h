#pragma once

#include "cli/json_blocks.h"
#include "cli/report/residual_report.h"

namespace errmap::cli {

/// The block "normality". A test that does not apply has nulls and "why".
/// p are cut off at 0.001 and 0.999 where they come from simulated tables.
Json NormalityJson(const stats::Normality& normality,
                   const stats::MonteCarloP& monte_carlo);

/// The block "randomness": serial tests over the whole order and within
/// groups, halves, biases by group and position, variance against fitted.
Json RandomnessJson(const ResidualReport& report);

/// Figures for plots: standardised residuals in measured order (Eq. 137), the
/// Tukey-lambda curve, the normal probability plot and the histogram (`bins` 0:
/// Freedman-Diaconis) of `values`.
Json PlotsJson(const ResidualReport& report,
               const Eigen::VectorXd& values,
               Eigen::Index bins);

}  // namespace errmap::cli
