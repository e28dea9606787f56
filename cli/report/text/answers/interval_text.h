#pragma once

#include <string>

#include "cli/report/number_text.h"
#include "models/prediction_interval.h"
#include "models/study/record/study_record.h"

namespace errmap::report {

/// Returns "90 % of the errors on an unseen cycle lie within 1.4 um, 95 %
/// within 2 um", and how long this holds, if known.
std::string IntervalText(const models::PromiseRecord& promise,
                         const ErrorText& error);
/// Returns the source of the interval: " (groups:5: 35 cycles held out whole)".
std::string IntervalLine(const models::PromiseRecord& promise,
                         const ErrorText& error);
/// Returns the 90 % half-widths inside and outside the trained range; "" if
/// they are equal.
std::string HalfWidthsLine(const models::PredictionInterval& interval,
                           const data::Unit& unit);

}  // namespace errmap::report
