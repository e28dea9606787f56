#pragma once

#include <string>

#include "cli/report/screen.h"
#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/regression_record.h"

namespace errmap::report {

/// The report of a regression for people: step log, coefficient table, ANOVA,
/// s, R2, PRESS, condition, excluded and aliased terms. Tables that are wider
/// or longer than `room` are cut, and say so. `weighted`: its rows had weights.
std::string RegressionText(const models::RegressionRecord& record,
                           bool weighted,
                           const data::ColumnInfo& target,
                           const Terminal& room);

/// Correlation matrix (Pearson, weighted) of the inputs and the target.
std::string CorrelationText(const data::Dataset& dataset, const Terminal& room);

}  // namespace errmap::report
