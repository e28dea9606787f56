#pragma once

#include <string>
#include <vector>

#include "models/study/record/record_values.h"

namespace errmap::report {

// Pictures that stand in a row of a table, as SVG.

/// A dot between 0 and the error without a map, with its 95 % interval as a
/// bar; "" where that is not known or less.
std::string IntervalPicture(double rmse,
                            const models::IntervalRecord& ci95,
                            double without_map);

/// The errors of a map on one unit after another, as a line from 0 to the
/// largest, which has a dot; of more units than the line has points for the
/// largest beside each other count. `words` says what it shows. "" for fewer
/// than two.
std::string Sparkline(const std::vector<double>& errors,
                      const std::string& words);

}  // namespace errmap::report
