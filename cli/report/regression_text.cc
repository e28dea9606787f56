#include "cli/report/regression_text.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/shell/number_text.h"
#include "models/study/figure_record.h"

namespace errmap::cli {
namespace {

using models::RegressionReport;
using models::ReportStep;
using models::ReportTerm;

// Rows of cells, padded to columns: the first to the left, others right.
class TextTable {
 public:
  void Add(std::vector<std::string> cells) {
    rows_.push_back(std::move(cells));
  }

  std::string Text() const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_) {
      widths.resize(std::max(widths.size(), row.size()), 0);
      for (std::size_t i = 0; i < row.size(); ++i) {
        widths[i] = std::max(widths[i], row[i].size());
      }
    }
    std::string text;
    for (const auto& row : rows_) {
      std::string line;
      for (std::size_t i = 0; i < row.size(); ++i) {
        line += i == 0 ? fmt::format("{:<{}}", row[i], widths[i])
                       : fmt::format("  {:>{}}", row[i], widths[i]);
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n";
    }
    return text;
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

std::string Figure(double value, int digits = 5) {
  if (std::isnan(value)) return "n/a";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return fmt::format("{:.{}g}", value, digits);
}

std::string Fixed(double value, int decimals) {
  if (!std::isfinite(value)) return Figure(value);
  return fmt::format("{:.{}f}", value, decimals);
}

std::string PValue(double p) {
  constexpr double kSmallestShown = 1e-16;
  if (std::isnan(p)) return "n/a";
  if (p < kSmallestShown) return "<1e-16";
  return p < 1e-3 ? fmt::format("{:.1e}", p) : fmt::format("{:.4f}", p);
}

std::string Percent(double share) {
  return std::isnan(share) ? "" : fmt::format("{:.0f}%", 100.0 * share);
}

std::string StepLog(const RegressionReport& report) {
  if (report.steps.empty()) return "";
  const auto has = [&](double fitting::SelectionStep::*member) {
    return std::any_of(
        report.steps.begin(), report.steps.end(), [&](const ReportStep& step) {
          return !std::isnan(step.numbers.*member);
        });
  };
  const bool press = has(&fitting::SelectionStep::press);
  const bool cp = has(&fitting::SelectionStep::cp);
  const bool cv = has(&fitting::SelectionStep::cv);
  TextTable table;
  std::vector<std::string> head{
      "step", "terms", "F", "p", "RSS", "AIC", "AICc", "BIC", "adj R2"};
  if (press) head.push_back("PRESS");
  if (cp) head.push_back("Cp");
  if (cv) head.push_back("CV");
  table.Add(std::move(head));
  for (std::size_t i = 0; i < report.steps.size(); ++i) {
    const fitting::SelectionStep& step = report.steps[i].numbers;
    const std::string sign = step.entered ? "+ " : "- ";
    std::vector<std::string> row{
        (i == report.chosen_step ? "* " : "  ") +
            (report.steps[i].term.empty() ? "(start)"
                                          : sign + report.steps[i].term),
        std::to_string(step.terms),
        std::isnan(step.f) ? "" : Figure(step.f, 4),
        std::isnan(step.p) ? "" : PValue(step.p),
        Figure(step.residual_sum_of_squares),
        Fixed(step.aic, 3),
        Fixed(step.aicc, 3),
        Fixed(step.bic, 3),
        Fixed(step.adjusted_r2, 6)};
    if (press) row.push_back(Figure(step.press));
    if (cp) row.push_back(Figure(step.cp));
    if (cv) row.push_back(Figure(step.cv));
    table.Add(std::move(row));
  }
  return "Steps (+ entered, - left, * chosen)\n" + table.Text() +
         fmt::format("ended: {}\n", report.ended) +
         "AIC = n ln(RSS/n) + 2k with k coefficients, as R's step() has it; "
         "BIC with k ln n; F and p are\nof the term that came or went.\n\n";
}

std::string CoefficientTable(const RegressionReport& report) {
  TextTable table;
  std::vector<ReportTerm> lines;
  if (report.fit.has_intercept) lines.push_back(report.intercept);
  lines.insert(lines.end(), report.terms.begin(), report.terms.end());
  if (report.penalised) {
    table.Add({"term", "estimate"});
    for (const ReportTerm& line : lines) {
      table.Add({line.name, Figure(line.numbers.estimate, 9)});
    }
  } else {
    std::vector<std::string> head{"term",
                                  "estimate",
                                  "std. error",
                                  "t",
                                  "p",
                                  "95% low",
                                  "95% high",
                                  "standardised",
                                  "VIF"};
    if (report.bootstrap > 0) head.push_back("chosen in");
    table.Add(std::move(head));
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const fitting::CoefficientEstimate& numbers = lines[i].numbers;
      const bool intercept = report.fit.has_intercept && i == 0;
      std::vector<std::string> row{
          lines[i].name,
          Figure(numbers.estimate, 9),
          Figure(numbers.standard_error),
          Figure(numbers.t, 4),
          PValue(numbers.p),
          Figure(numbers.lower),
          Figure(numbers.upper),
          intercept ? "" : Figure(numbers.standardised, 4),
          intercept ? "" : Figure(numbers.vif, 4)};
      if (report.bootstrap > 0) row.push_back(Percent(lines[i].inclusion));
      table.Add(std::move(row));
    }
  }
  std::string text = "Coefficients\n" + table.Text();
  if (!report.centres.empty()) {
    std::vector<std::string> moved;
    for (const auto& [name, centre] : report.centres) {
      moved.push_back(fmt::format(
          "{} {} {:.9g}", name, centre < 0.0 ? "+" : "-", std::abs(centre)));
    }
    text += fmt::format(
        "In this table an input stands for its value less its centre: {}.\n",
        fmt::join(moved, ", "));
  }
  if (report.penalised) {
    text +=
        "Shrunken estimates have no honest standard errors or p-values, so "
        "none are shown.\n";
  }
  return text + "\n";
}

std::string Anova(const RegressionReport& report) {
  const fitting::RegressionDiagnostics& fit = report.fit;
  TextTable table;
  table.Add({"source", "df", "sum of squares", "mean square", "F", "p"});
  const double k = static_cast<double>(fit.regression_degrees_of_freedom());
  table.Add({"regression",
             Figure(k, 12),
             Figure(fit.regression_sum_of_squares, 7),
             k > 0.0 ? Figure(fit.regression_sum_of_squares / k, 7) : "",
             Figure(fit.f, 6),
             PValue(fit.f_p)});
  table.Add(
      {"residual",
       Figure(fit.residual_degrees_of_freedom, 12),
       Figure(fit.residual_sum_of_squares, 7),
       fit.residual_degrees_of_freedom > 0.0 ? Figure(fit.s * fit.s, 7) : ""});
  table.Add({"total",
             Figure(fit.total_degrees_of_freedom(), 12),
             Figure(fit.total_sum_of_squares, 7)});
  return fmt::format("Analysis of variance{}\n",
                     report.weighted ? " (weighted)" : "") +
         table.Text() + "\n";
}

std::string Quality(const RegressionReport& report,
                    const data::ColumnInfo& target) {
  const fitting::RegressionDiagnostics& fit = report.fit;
  const ErrorText error(target.unit, fit.s);
  std::string text =
      fmt::format("s {} on {} degrees of freedom, R2 {}, adjusted R2 {}\n",
                  error.WithUnit(fit.s),
                  Figure(fit.residual_degrees_of_freedom, 12),
                  Fixed(fit.r2, 6),
                  Fixed(fit.adjusted_r2, 6));
  if (report.rows.leverage_one > 0) {
    text += fmt::format(
        "predicted R2 n/a: {} {} leverage 1, a coefficient to itself, so it "
        "cannot be left out\n",
        Count(report.rows.leverage_one, "row"),
        report.rows.leverage_one == 1 ? "has" : "have");
  } else {
    text += fmt::format("predicted R2 {} (PRESS {}; terms taken as given)\n",
                        Fixed(report.rows.PredictedR2(fit), 6),
                        Figure(report.rows.press, 7));
  }
  text += fmt::format(
      "largest residual {} (row {}), largest leverage {}\n"
      "condition number {} (columns of unit length{}), "
      "effective rank {} of {}\n",
      error.WithUnit(report.rows.largest_residual),
      report.rows.largest_residual_row,
      Figure(report.rows.largest_leverage, 4),
      Figure(fit.condition, 4),
      fit.has_intercept ? ", with intercept" : "",
      fit.effective_rank,
      report.terms.size() + (fit.has_intercept ? 1 : 0));
  return text + "\n";
}

std::string Excluded(const RegressionReport& report) {
  std::string text;
  constexpr std::size_t kMostShown = 10;
  if (!report.excluded.empty()) {
    TextTable table;
    std::vector<std::string> head{"term", "F if it entered", "p"};
    if (report.bootstrap > 0) head.push_back("chosen in");
    table.Add(std::move(head));
    for (std::size_t i = 0; i < std::min(kMostShown, report.excluded.size());
         ++i) {
      const models::ExcludedReport& term = report.excluded[i];
      std::vector<std::string> row{
          term.name, Figure(term.f, 4), PValue(term.p)};
      if (report.bootstrap > 0) row.push_back(Percent(term.inclusion));
      table.Add(std::move(row));
    }
    text += fmt::format("Terms left out ({}{})\n",
                        report.excluded.size(),
                        report.excluded.size() > kMostShown
                            ? "; those of largest F, all with --format json"
                            : "") +
            table.Text() + "\n";
  }
  if (!report.aliased.empty()) {
    text += fmt::format(
        "Aliased terms ({}): the terms in the model determine them\n",
        report.aliased.size());
    for (std::size_t i = 0; i < std::min(kMostShown, report.aliased.size());
         ++i) {
      text +=
          fmt::format("{} {}\n", report.aliased[i].name, report.aliased[i].why);
    }
    if (report.aliased.size() > kMostShown) {
      text += fmt::format("and {} more, all with --format json\n",
                          report.aliased.size() - kMostShown);
    }
    text += "\n";
  }
  return text;
}

std::string Warnings(const RegressionReport& report) {
  std::string text;
  if (report.selected) {
    text +=
        "The terms were chosen with these same rows: p-values, intervals and "
        "R2 are optimistic.\n";
    if (report.bootstrap > 0) {
      text += fmt::format(
          "'chosen in' is the share of {} bootstrap repetitions (each {} drawn "
          "with replacement) that\nchose the term.\n",
          report.bootstrap,
          report.bootstrap_unit);
    }
  }
  for (const std::string& note : report.notes) text += note + "\n";
  return text.empty() ? text : text + "\n";
}

std::string PenaltyText(const RegressionReport& report) {
  std::string text = fmt::format("{} effective parameters\n",
                                 Fixed(report.degrees_of_freedom, 1));
  if (report.strengths.empty()) return text;
  const auto least = std::min_element(report.mean_squared_errors.begin(),
                                      report.mean_squared_errors.end());
  text += fmt::format(
      "cross-validation over {}: least RMSE {} among {} penalties from {} down "
      "to {}\n",
      report.cross_validation,
      Figure(std::sqrt(*least)),
      report.strengths.size(),
      Figure(report.strengths.front(), 3),
      Figure(report.strengths.back(), 3));
  return text;
}

}  // namespace

std::string RegressionText(const RegressionReport& report,
                           const data::ColumnInfo& target) {
  std::string text = "\n" + report.method + "\n\n" + StepLog(report) +
                     CoefficientTable(report);
  if (report.penalised) return text + PenaltyText(report) + "\n";
  return text + Anova(report) + Quality(report, target) + Excluded(report) +
         Warnings(report);
}

std::string CorrelationText(const data::Dataset& dataset) {
  const models::CorrelationRecord correlations = models::Correlate(dataset);
  const std::vector<std::string>& names = correlations.columns;
  TextTable table;
  std::vector<std::string> head{"correlation"};
  head.insert(head.end(), names.begin(), names.end());
  table.Add(std::move(head));
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<std::string> row{names[i]};
    for (std::size_t j = 0; j <= i; ++j) {
      row.push_back(Fixed(correlations.matrix[i][j], 4));
    }
    table.Add(std::move(row));
  }
  return "\n" + table.Text();
}

}  // namespace errmap::cli
