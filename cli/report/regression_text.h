#pragma once

#include <string>

#include "data/dataset.h"
#include "models/error_model.h"
#include "models/regression_report.h"

namespace errmap::cli {

/// The report of a regression for people: step log, coefficient table, ANOVA,
/// s, R2, PRESS, condition, excluded and aliased terms.
std::string RegressionText(const models::RegressionReport& report,
                           const data::ColumnInfo& target);

/// Correlation matrix (Pearson, weighted) of the inputs and the target.
std::string CorrelationText(const data::Dataset& dataset);

}  // namespace errmap::cli
