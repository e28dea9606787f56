#pragma once

#include <string>

#include "models/study/record/component_study.h"

namespace errmap::report {

/// residuals.csv: one line per hold-out, fold and test row, with
/// group, target and each model's prediction (empty where it failed).
std::string ResidualsCsv(const models::ComponentStudy& study);

}  // namespace errmap::report
