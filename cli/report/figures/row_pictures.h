#pragma once

#include <string>
#include <vector>

#include "models/record.h"

namespace errmap::report {

// Pictures in table rows, as SVG.

/// A dot between 0 and `without_map`, with the 95 % interval as a bar; "" if
/// `without_map` is unknown or less than `rmse`.
std::string IntervalPicture(double rmse,
                            const models::IntervalRecord& ci95,
                            double without_map);

/// A map's errors over successive units, as a line from 0 to the largest error,
/// which has a dot. If there are more units than points, each point is the
/// largest of its neighbours. `words` describes it for blind readers. "" for
/// fewer than two units.
std::string Sparkline(const std::vector<double>& errors,
                      const std::string& words);

}  // namespace errmap::report
