#pragma once

#include <string>

#include "cli/report/report_view.h"
#include "cli/report/table.h"

namespace errmap::report {

/// Errors among neighbours compared with those on unseen groups.
Table GapTable(const ReportView& view);

/// The recommended model compared with each other one: differences and tests.
Table ComparisonTable(const ReportView& view, const std::string& holdout);

/// How often each model wins over repeated splits of the groups.
Table StabilityTable(const ReportView& view);

/// The recommended map's error by time since the session's start.
Table SinceStartTable(const ReportView& view);

/// Residual statistics of every model, as in the report's section 9.
Table ResidualTable(const ReportView& view, const std::string& holdout);
/// Tests of normality of every model's held-out residuals.
Table NormalityTable(const ReportView& view, const std::string& holdout);
/// Tests of independence and bias of every model's held-out residuals.
Table IndependenceTable(const ReportView& view, const std::string& holdout);

}  // namespace errmap::report
