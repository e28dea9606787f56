#pragma once

#include <string>

#include "data/units.h"
#include "models/study/judgement/residual_assessment.h"
#include "stats/error_metrics.h"
#include "stats/report_1995.h"

namespace errmap::report {

/// Location and spread, in a few lines.
std::string SampleText(const stats::ErrorMetrics& metrics,
                       const Eigen::VectorXd& values,
                       const stats::ShapeMoments& shape,
                       const data::Unit& unit);

/// The tests of shape as a table. Each line states the assumptions of its p.
/// `unit` is the unit of the values.
std::string NormalityText(const models::ResidualReport& report,
                          Eigen::Index n,
                          const data::Unit& unit);

/// The tests of order, halves, biases and spread as a table.
std::string RandomnessText(const models::ResidualReport& report);

/// Bias per group and position, histogram (`bins` 0: Freedman-Diaconis) and
/// the Tukey-lambda curve in full.
std::string DetailsText(const models::ResidualReport& report,
                        const Eigen::VectorXd& values,
                        const data::Unit& unit,
                        Eigen::Index bins);

/// The statistics that the program of NISTIR 5367 prints for these residuals.
/// `r_squared` is NaN if no fitted values are known.
std::string Report1995Text(const stats::Report1995Statistics& printed,
                           double r_squared,
                           const data::Unit& unit);

}  // namespace errmap::report
