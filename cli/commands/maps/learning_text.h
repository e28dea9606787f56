#pragma once

#include <string>
#include <vector>

#include "cli/json_blocks.h"
#include "data/units.h"
#include "models/promise/learning_curve.h"
#include "models/promise/next_states.h"
#include "models/promise/sensor_curve.h"

namespace errmap::cli {

// What `errmap learn` found, as a table with words, as JSON and as a figure.

Json CurvesJson(const models::LearningPlan& plan,
                const std::vector<models::LearningCurve>& curves,
                double goal);
/// `goal` in the target's unit; NaN: none.
std::string CurvesText(const models::LearningPlan& plan,
                       const std::vector<models::LearningCurve>& curves,
                       double goal,
                       const data::Unit& unit);
std::string CurvesSvg(const models::LearningPlan& plan,
                      const std::vector<models::LearningCurve>& curves,
                      const data::Unit& unit);

Json SensorsJson(const models::SensorCurve& curve);
std::string SensorsText(const models::SensorCurve& curve,
                        const data::Unit& unit);
std::string SensorsSvg(const models::SensorCurve& curve,
                       const data::Unit& unit);

Json NextJson(const std::vector<models::NextState>& chosen);
std::string NextText(const std::vector<models::NextState>& chosen);

}  // namespace errmap::cli
