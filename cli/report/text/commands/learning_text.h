#pragma once

#include <string>

#include "data/units.h"
#include "models/learning/learning_record.h"

namespace errmap::report {

// What `errmap learn` found, as tables with words.

std::string CurvesText(const models::LearningCurvesRecord& curves,
                       const data::Unit& unit);
std::string SensorsText(const models::SensorCurve& curve,
                        const data::Unit& unit);
std::string NextText(const std::vector<models::NextState>& chosen);

}  // namespace errmap::report
