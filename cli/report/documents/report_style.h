#pragma once

namespace errmap::report {

/// The style sheet of report.html; every contrast is at least 4.5 to 1.
extern const char* const kReportStyle;

}  // namespace errmap::report
