#pragma once

#include <string>
#include <vector>

#include "models/error_model.h"
#include "models/report/number_text.h"

namespace errmap::report {

/// The starts as a table with a line about the spread of their costs; "" for no
/// starts.
std::string StartsText(const std::vector<models::StartResult>& starts,
                       const ErrorText& error);

}  // namespace errmap::report
