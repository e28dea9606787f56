#pragma once

#include <span>

#include "cli/report/text/answers/remarks.h"

namespace errmap::report {

/// The remarks for next steps and details, in their order.
std::span<const RemarkEntry> FurtherRemarks();

}  // namespace errmap::report
