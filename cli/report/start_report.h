#pragma once

#include <string>
#include <vector>

#include "cli/json_blocks.h"
#include "cli/shell/number_text.h"
#include "models/error_model.h"

namespace errmap::cli {

/// {"wfactor": 0.00013, ...}: what a fit chose itself.
Json ChoicesJson(const std::vector<models::EffectiveOption>& choices);

/// {"table": [{"seed","final_cost","stop","iterations","holdout_rmse",
/// "chosen"}], "spread": {"finite","min","median","max","sd"}} of the final
/// costs that are finite.
Json StartsJson(const std::vector<models::StartResult>& starts);

/// The same as a table with a line about the spread; "" for no starts.
std::string StartsText(const std::vector<models::StartResult>& starts,
                       const ErrorText& error);

}  // namespace errmap::cli
