#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/report/report_view.h"

namespace errmap::cli {

/// A table of a report; cells are plain text, escaped by who writes the page.
struct ReportTable {
  struct Column {
    std::string name;
    bool is_number = true;
    std::string explanation = {};  // "" where the name says it all
  };
  std::string title;
  std::string note = {};
  std::vector<Column> columns = {};
  std::vector<std::vector<std::string>> rows = {};
  std::size_t marked = std::string::npos;  // row that stands out
  /// Why there are no rows; shown in their place.
  std::string missing = {};
};

/// Figures as reports print them; "-" where there is none.
std::string FigureText(double value, int digits = 4);
std::string FixedText(double value, int decimals);
std::string PText(double p);  // "0.0123", "<0.0001"
std::string CountText(std::int64_t value);
std::string CountText(const std::optional<std::int64_t>& value);

/// Every model under the hold-outs: tier, errors, significance, goal, cost.
ReportTable LeaderboardTable(const ReportView& view);

/// Errors between neighbours beside those on unseen groups.
ReportTable GapTable(const ReportView& view);

/// The recommended model against every other one: differences and tests.
ReportTable ComparisonTable(const ReportView& view, const std::string& holdout);

/// How often each model wins when the groups are cut anew.
ReportTable StabilityTable(const ReportView& view);

/// Residual statistics of every model, as in the report's section 9.
ReportTable ResidualTable(const ReportView& view, const std::string& holdout);
/// Tests of normality of every model's held-out residuals.
ReportTable NormalityTable(const ReportView& view, const std::string& holdout);
/// Tests of independence and bias of every model's held-out residuals.
ReportTable IndependenceTable(const ReportView& view,
                              const std::string& holdout);

}  // namespace errmap::cli
