#pragma once

#include <string>
#include <vector>

#include "cli/report/number_text.h"
#include "models/error_model.h"

namespace errmap::report {

/// Returns the starts as a table with a line on the spread of their costs; ""
/// if there are no starts.
std::string StartsText(const std::vector<models::StartResult>& starts,
                       const ErrorText& error);

}  // namespace errmap::report
