#pragma once

#include <string>

#include "models/study/record/component_study.h"

namespace errmap::report {

/// Returns residuals.csv: one line for each hold-out, fold and test row, with
/// group, target and each model's prediction (empty if it failed).
std::string ResidualsCsv(const models::ComponentStudy& study);

}  // namespace errmap::report
