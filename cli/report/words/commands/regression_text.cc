#include "cli/report/words/commands/regression_text.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/table.h"
#include "cli/report/wrap_text.h"
#include "data/text.h"
#include "models/study/record/making/make_figure_record.h"

namespace errmap::report {
namespace {

using models::RegressionReport;
using models::ReportStep;
using models::ReportTerm;

// The first column is words, the others are numbers.
Table TextTable(const std::vector<std::string>& head) {
  Table table{.nothing = "n/a"};
  for (const std::string& name : head) {
    table.columns.push_back(
        {.name = name, .is_number = !table.columns.empty()});
  }
  return table;
}

std::string Text(const Cell& cell) { return TextTable({}).Shown(cell); }

// Blank, not "n/a", where a row has no such figure.
Cell OrBlank(double value, Cell cell) {
  return std::isnan(value) ? Cell("") : std::move(cell);
}

std::string Percent(double share) {
  return std::isnan(share) ? "" : fmt::format("{:.0f}%", 100.0 * share);
}

// As much of a table as there is room for: lines are not broken, and the
// terminal is not scrolled away.
std::string InRoom(Table table, const Terminal& room) {
  const std::size_t all_rows = table.rows.size();
  if (room.rows > 0 && all_rows > room.rows) table.rows.resize(room.rows);
  std::vector<std::string> lines = TerminalLines(table, std::string::npos);
  std::vector<std::string> dropped;
  const auto widest = [&] {
    std::size_t width = 0;
    for (const std::string& line : lines) {
      width = std::max(width, WidthOf(line));
    }
    return width;
  };
  while (widest() > room.columns && table.columns.size() > 2) {
    const std::string& name = table.columns.back().name;
    dropped.insert(dropped.begin(), data::Printable(name, name.size()));
    table.columns.pop_back();
    for (std::vector<Cell>& row : table.rows) {
      if (row.size() > table.columns.size()) row.pop_back();
    }
    lines = TerminalLines(table, std::string::npos);
  }
  lines = TerminalLines(table, room.columns);
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  std::vector<std::string> more;
  if (all_rows > table.rows.size()) {
    more.push_back(Count(static_cast<long long>(all_rows - table.rows.size()),
                         "more row"));
  }
  if (!dropped.empty()) {
    more.push_back(data::JoinWords(dropped, ", "));
  }
  if (more.empty()) return text;
  return text +
         WrapText(
             fmt::format("{} with --details.", data::JoinWords(more, "; ")),
             room.text_columns()) +
         "\n";
}

std::string StepLog(const RegressionReport& report, const Terminal& room) {
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
  std::vector<std::string> head{
      "step", "terms", "F", "p", "RSS", "AIC", "AICc", "BIC", "adj R2"};
  if (press) head.push_back("PRESS");
  if (cp) head.push_back("Cp");
  if (cv) head.push_back("CV");
  Table table = TextTable(head);
  for (std::size_t i = 0; i < report.steps.size(); ++i) {
    const fitting::SelectionStep& step = report.steps[i].numbers;
    const std::string sign = step.entered ? "+ " : "- ";
    std::vector<Cell> row{
        (i == report.chosen_step ? "* " : "  ") +
            (report.steps[i].term.empty() ? "(start)"
                                          : sign + report.steps[i].term),
        std::to_string(step.terms),
        OrBlank(step.f, Number{step.f, 4}),
        OrBlank(step.p, P{step.p}),
        Number{step.residual_sum_of_squares, 5},
        Fixed{step.aic, 3},
        Fixed{step.aicc, 3},
        Fixed{step.bic, 3},
        Fixed{step.adjusted_r2, 6}};
    if (press) row.push_back(Number{step.press, 5});
    if (cp) row.push_back(Number{step.cp, 5});
    if (cv) row.push_back(Number{step.cv, 5});
    table.rows.push_back(std::move(row));
  }
  return "Steps (+ entered, - left, * chosen)\n" + InRoom(table, room) +
         WrapText(
             fmt::format("Ended: {}. AIC = n ln(RSS/n) + 2k with k "
                         "coefficients, as R's step() has it; BIC with k ln n; "
                         "F and p are of the term that came or went.",
                         report.ended),
             room.text_columns()) +
         "\n\n";
}

std::string CoefficientTable(const RegressionReport& report,
                             const Terminal& room) {
  std::vector<ReportTerm> lines;
  if (report.fit.has_intercept) lines.push_back(report.intercept);
  lines.insert(lines.end(), report.terms.begin(), report.terms.end());
  Table table;
  if (report.penalised) {
    table = TextTable({"term", "estimate"});
    for (const ReportTerm& line : lines) {
      table.rows.push_back({line.name, Number{line.numbers.estimate, 9}});
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
    table = TextTable(head);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const fitting::CoefficientEstimate& numbers = lines[i].numbers;
      const bool intercept = report.fit.has_intercept && i == 0;
      std::vector<Cell> row{
          lines[i].name,
          Number{numbers.estimate, 9},
          Number{numbers.standard_error, 5},
          Number{numbers.t, 4},
          P{numbers.p},
          Number{numbers.lower, 5},
          Number{numbers.upper, 5},
          intercept ? Cell("") : Cell(Number{numbers.standardised, 4}),
          intercept ? Cell("") : Cell(Number{numbers.vif, 4})};
      if (report.bootstrap > 0) row.push_back(Percent(lines[i].inclusion));
      table.rows.push_back(std::move(row));
    }
  }
  std::string text =
      (report.centres.empty() ? "Coefficients\n"
                              : "Coefficients, of centred inputs\n") +
      InRoom(table, room);
  if (!report.centres.empty()) {
    std::vector<std::string> moved;
    for (const auto& [name, centre] : report.centres) {
      moved.push_back(fmt::format("{} {} {:.9g}",
                                  data::Printable(name, name.size()),
                                  centre < 0.0 ? "+" : "-",
                                  std::abs(centre)));
    }
    text += WrapText(fmt::format("In this table an input stands for its value "
                                 "less its centre: {}.",
                                 data::JoinWords(moved, ", ")),
                     room.text_columns()) +
            "\n";
  }
  if (report.penalised) {
    text += WrapText(
                "Shrunken estimates have no honest standard errors or "
                "p-values, so none are shown.",
                room.text_columns()) +
            "\n";
  }
  return text + "\n";
}

std::string Anova(const RegressionReport& report, const Terminal& room) {
  const fitting::RegressionDiagnostics& fit = report.fit;
  Table table =
      TextTable({"source", "df", "sum of squares", "mean square", "F", "p"});
  const double k = static_cast<double>(fit.regression_degrees_of_freedom());
  table.rows.push_back(
      {"regression",
       Number{k, 12},
       Number{fit.regression_sum_of_squares, 7},
       k > 0.0 ? Cell(Number{fit.regression_sum_of_squares / k, 7}) : "",
       Number{fit.f, 6},
       P{fit.f_p}});
  table.rows.push_back({"residual",
                        Number{fit.residual_degrees_of_freedom, 12},
                        Number{fit.residual_sum_of_squares, 7},
                        fit.residual_degrees_of_freedom > 0.0
                            ? Cell(Number{fit.s * fit.s, 7})
                            : ""});
  table.rows.push_back({"total",
                        Number{fit.total_degrees_of_freedom(), 12},
                        Number{fit.total_sum_of_squares, 7}});
  return fmt::format("Analysis of variance{}\n",
                     report.weighted ? " (weighted)" : "") +
         InRoom(table, room) + "\n";
}

std::string Quality(const RegressionReport& report,
                    const data::ColumnInfo& target) {
  const fitting::RegressionDiagnostics& fit = report.fit;
  const ErrorText error(target.unit, fit.s);
  std::string text =
      fmt::format("s {} on {} degrees of freedom, R2 {}, adjusted R2 {}\n",
                  error.WithUnit(fit.s),
                  Text(Number{fit.residual_degrees_of_freedom, 12}),
                  Text(Fixed{fit.r2, 6}),
                  Text(Fixed{fit.adjusted_r2, 6}));
  if (report.rows.leverage_one > 0) {
    text += fmt::format(
        "predicted R2 n/a: {} {} leverage 1, a coefficient to itself, so it\n"
        "cannot be left out\n",
        Count(report.rows.leverage_one, "row"),
        report.rows.leverage_one == 1 ? "has" : "have");
  } else {
    text += fmt::format("predicted R2 {} (PRESS {}; terms taken as given)\n",
                        Text(Fixed{report.rows.PredictedR2(fit), 6}),
                        Text(Number{report.rows.press, 7}));
  }
  text += fmt::format(
      "largest residual {} (row {}), largest leverage {}\n"
      "condition number {} (columns of unit length{}),\n"
      "effective rank {} of {}\n",
      error.WithUnit(report.rows.largest_residual),
      report.rows.largest_residual_row,
      Text(Number{report.rows.largest_leverage, 4}),
      Text(Number{fit.condition, 4}),
      fit.has_intercept ? ", with intercept" : "",
      fit.effective_rank,
      report.terms.size() + (fit.has_intercept ? 1 : 0));
  return text + "\n";
}

std::string Excluded(const RegressionReport& report, const Terminal& room) {
  std::string text;
  constexpr std::size_t kMostShown = 10;
  if (!report.excluded.empty()) {
    std::vector<std::string> head{"term", "F if it entered", "p"};
    if (report.bootstrap > 0) head.push_back("chosen in");
    Table table = TextTable(head);
    for (std::size_t i = 0; i < std::min(kMostShown, report.excluded.size());
         ++i) {
      const models::ExcludedReport& term = report.excluded[i];
      std::vector<Cell> row{term.name, Number{term.f, 4}, P{term.p}};
      if (report.bootstrap > 0) row.push_back(Percent(term.inclusion));
      table.rows.push_back(std::move(row));
    }
    text += fmt::format("Terms left out ({}{})\n",
                        report.excluded.size(),
                        report.excluded.size() > kMostShown
                            ? "; those of largest F, all with --format json"
                            : "") +
            InRoom(table, room) + "\n";
  }
  if (!report.aliased.empty()) {
    text += fmt::format(
        "Aliased terms ({}): the terms in the model determine them\n",
        report.aliased.size());
    for (std::size_t i = 0; i < std::min(kMostShown, report.aliased.size());
         ++i) {
      const std::string line =
          fmt::format("{} {}", report.aliased[i].name, report.aliased[i].why);
      text +=
          WrapText(data::Printable(line, line.size()), room.text_columns()) +
          "\n";
    }
    if (report.aliased.size() > kMostShown) {
      text += fmt::format("and {} more, all with --format json\n",
                          report.aliased.size() - kMostShown);
    }
    text += "\n";
  }
  return text;
}

std::string Warnings(const RegressionReport& report, const Terminal& room) {
  std::vector<std::string> lines;
  if (report.selected) {
    lines.emplace_back(
        "The terms were chosen with these same rows: p-values, intervals and "
        "R2 are optimistic.");
    if (report.bootstrap > 0) {
      lines.push_back(fmt::format(
          "'chosen in' is the share of {} bootstrap repetitions (each {} drawn "
          "with replacement) that chose the term.",
          report.bootstrap,
          report.bootstrap_unit));
    }
  }
  lines.insert(lines.end(), report.notes.begin(), report.notes.end());
  std::string text;
  for (const std::string& line : lines) {
    text += WrapText(line, room.text_columns()) + "\n";
  }
  return text.empty() ? text : text + "\n";
}

std::string PenaltyText(const RegressionReport& report) {
  std::string text = fmt::format("{} effective parameters\n",
                                 Text(Fixed{report.degrees_of_freedom, 1}));
  if (report.strengths.empty()) return text;
  const auto least = std::min_element(report.mean_squared_errors.begin(),
                                      report.mean_squared_errors.end());
  text += fmt::format(
      "cross-validation over {}: least RMSE {} among {} penalties from {} down "
      "to {}\n",
      report.cross_validation,
      Text(Number{std::sqrt(*least), 5}),
      report.strengths.size(),
      Text(Number{report.strengths.front(), 3}),
      Text(Number{report.strengths.back(), 3}));
  return text;
}

}  // namespace

std::string RegressionText(const RegressionReport& report,
                           const data::ColumnInfo& target,
                           const Terminal& room) {
  std::string text = "\n" + WrapText(report.method, room.text_columns()) +
                     "\n\n" + StepLog(report, room) +
                     CoefficientTable(report, room);
  if (report.penalised) return text + PenaltyText(report) + "\n";
  return text + Anova(report, room) + Quality(report, target) +
         Excluded(report, room) + Warnings(report, room);
}

std::string CorrelationText(const data::Dataset& dataset,
                            const Terminal& room) {
  const models::CorrelationRecord correlations = models::Correlate(dataset);
  const std::vector<std::string>& names = correlations.columns;
  std::vector<std::string> head{"correlation"};
  head.insert(head.end(), names.begin(), names.end());
  Table table = TextTable(head);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<Cell> row{names[i]};
    for (std::size_t j = 0; j < names.size(); ++j) {
      row.push_back(j <= i ? Cell(Fixed{correlations.matrix[i][j], 4})
                           : Cell(""));
    }
    table.rows.push_back(std::move(row));
  }
  return "\n" + InRoom(table, room);
}

}  // namespace errmap::report
