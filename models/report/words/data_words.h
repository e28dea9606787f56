#pragma once

#include <string>

#include "models/study/record/data_record.h"

namespace errmap::report {

/// ", 70 groups (cycle), 2 sessions (day)" or ", ... one run", to follow a
/// number of rows.
std::string UnitsWords(const models::DataRecord& data);

/// The target's name, and what was taken off it.
std::string TargetWords(const models::DataRecord& data);

}  // namespace errmap::report
