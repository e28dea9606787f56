#pragma once

#include <string>

#include "cli/report/number_text.h"
#include "models/learning/learning_record.h"

namespace errmap::report {

/// Returns "with all 10: 1.20 um expected (1.10 to 1.40); about 5 more to reach
/// 1.00 um (2 at least; 10 % that it is never reached)"; "" without a law.
std::string LawWords(const models::LearningCurvesRecord& curves,
                     const models::LearningModelRecord& model,
                     const ErrorText& error);

/// Returns "4 of 36 sensors are enough, within 5 % of all".
std::string EnoughWords(const models::SensorCurve& curve);

/// Returns "4 of 27 sensors do it, within 5 % of all: 1.24 um with them, 1.20
/// um with all. t3 (or t4, t5), t12." If no choice is good enough, names the
/// best one.
std::string SensorWords(const models::SensorCurve& curve,
                        const ErrorText& error);

/// Formats the errors of the curves with the decimals that the smallest needs.
ErrorText ErrorTextOf(const models::LearningCurvesRecord& curves,
                      const data::Unit& unit);
ErrorText ErrorTextOf(const models::SensorCurve& curve, const data::Unit& unit);

}  // namespace errmap::report
