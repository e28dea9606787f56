#pragma once

#include <string>
#include <vector>

#include "data/measurements/dataset.h"

namespace errmap::report {

enum class FaultUse { kFit, kJudge };

/// What was found in the columns, one line each, and the option that leaves it
/// out; where the data are to be fitted also what it does to a fit. `policy`:
/// what was done with such rows.
std::vector<std::string> FaultLines(const data::PreparedDataset& prepared,
                                    data::FaultPolicy policy,
                                    FaultUse use);

}  // namespace errmap::report
