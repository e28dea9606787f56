#pragma once

#include <string>

#include "cli/shell/number_text.h"
#include "models/prediction_interval.h"

namespace errmap::cli {

/// "90 % of the errors on an unseen cycle lie within 1.4 um, ..." in one line.
std::string IntervalText(const models::PredictionInterval& interval,
                         const ErrorText& error);

}  // namespace errmap::cli
