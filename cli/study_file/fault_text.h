#pragma once

#include <string>
#include <vector>

#include "cli/json_blocks.h"
#include "data/dataset.h"

namespace errmap::cli {

enum class FaultUse { kFit, kJudge };

/// What was found in the columns, one line each, and the option that leaves it
/// out; where the data are to be fitted also what it does to a fit. `policy`:
/// what was done with such rows.
std::vector<std::string> FaultLines(const data::PreparedDataset& prepared,
                                    data::FaultPolicy policy,
                                    FaultUse use);

/// [{"kind","column","rows","of_cells","value","low","high"}]
Json FaultsJson(const data::PreparedDataset& prepared);

}  // namespace errmap::cli
