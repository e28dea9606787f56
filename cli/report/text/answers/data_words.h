#pragma once

#include <string>

#include "data/measurements/dataset.h"
#include "models/study/record/study_record.h"

namespace errmap::report {

/// ", 70 groups (cycle), 2 sessions (day)" or ", ... one run", to follow a
/// number of rows.
std::string UnitsWords(const models::DataRecord& data);
std::string UnitsWords(const data::Dataset& dataset);

/// The target's name, and the column that was subtracted from it.
std::string TargetWords(const models::DataRecord& data);
std::string TargetWords(const data::Dataset& dataset);

/// Returns the reason to doubt that a results.json is unchanged since the run;
/// else "".
std::string DoubtText(const models::StudyRecord& record);

}  // namespace errmap::report
