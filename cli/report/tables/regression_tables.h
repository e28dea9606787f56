#pragma once

#include <string>
#include <vector>

#include "cli/report/number_text.h"
#include "cli/report/report_view.h"
#include "cli/report/table.h"

namespace errmap::report {

/// The steps of a selection; no rows if the terms were given.
Table StepTable(const models::RegressionRecord& regression);

/// The coefficients with their statistics, as far as there are any.
Table CoefficientTable(const models::RegressionRecord& regression);

/// The analysis of variance; no rows for a penalised fit.
Table AnovaTable(const models::RegressionRecord& regression);

/// The terms that were left out, those of largest F first.
Table ExcludedTerms(const models::RegressionRecord& regression);

/// The terms that others determine.
Table AliasedTerms(const models::RegressionRecord& regression);

/// s, R2, PRESS, largest residual, condition and rank, or what a penalised fit
/// has instead. "" if nothing was kept.
std::string RegressionSummary(const models::RegressionRecord& regression,
                              const ErrorText& error);

/// The models with an equation or a regression, the recommended one first;
/// baselines are left out.
std::vector<const ModelRecord*> PolynomialsOf(const ReportView& view);

}  // namespace errmap::report
