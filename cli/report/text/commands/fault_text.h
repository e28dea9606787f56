#pragma once

#include <string>
#include <vector>

#include "data/measurements/dataset.h"

namespace errmap::report {

enum class FaultUse { kFit, kJudge };

/// Describes the faults of the columns, one line each, with the option that
/// leaves the column out. If the data are to be fitted, also says how the fault
/// affects a fit. `policy`: how such rows are treated.
std::vector<std::string> FaultLines(const data::PreparedDataset& prepared,
                                    data::FaultPolicy policy,
                                    FaultUse use);

}  // namespace errmap::report
