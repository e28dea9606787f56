#include "cli/report/documents/fit_text.h"

#include <cmath>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/table.h"
#include "cli/report/tables/report_tables.h"
#include "cli/report/text/answers/interval_text.h"
#include "cli/report/text/commands/calibration_check_text.h"
#include "cli/report/wrap_text.h"
#include "data/text.h"
#include "models/study/record/builders/parts.h"

namespace errmap::report {
namespace {

// "stop: gradient (the gradient is small: a minimum)", and for an iterative fit
// what it did and how long an iteration took (the report's Table 4).
std::string EndingText(const fitting::FitSummary& summary) {
  std::string text = fmt::format("stop: {} ({})\n",
                                 fitting::ToString(summary.termination),
                                 summary.message);
  if (summary.iterations == 0) return text;
  text += fmt::format(
      "{} iterations; evaluations: {} of value, {} of gradient, {} of "
      "curvature\n",
      summary.iterations,
      summary.value_evaluations,
      summary.gradient_evaluations,
      summary.curvature_evaluations);
  text += fmt::format(
      "sqrt(2 E) from {:.6g} to {:.6g}, |gradient| from {:.3g} to {:.3g}\n",
      std::sqrt(2.0 * summary.initial_cost),
      std::sqrt(2.0 * summary.final_cost),
      summary.initial_gradient_norm,
      summary.final_gradient_norm);
  constexpr double kMicroseconds = 1e6;
  text += fmt::format("{:.3g} s, an iteration {:.3g} us",
                      summary.seconds,
                      summary.mean_iteration_seconds * kMicroseconds);
  if (std::isfinite(summary.sd_iteration_seconds)) {
    text += fmt::format(" (sd {:.3g})",
                        summary.sd_iteration_seconds * kMicroseconds);
  }
  return text + "\n";
}

// As a table with a line on the spread of their costs; "" if there are none.
std::string StartsText(const std::vector<models::StartResult>& starts,
                       const ErrorText& error) {
  if (starts.empty()) return "";
  std::string text = fmt::format(
      "{} starts, * chosen: lowest cost\n"
      "{:>22}  {:>12}  {:>10}  {:>14}  stop\n",
      starts.size(),
      "seed",
      "cost",
      "iterations",
      "held-out RMSE");
  for (const models::StartResult& start : starts) {
    text += fmt::format("{}{:>21}  {:>12.6g}  {:>10}  {:>14}  {}\n",
                        start.chosen ? "*" : " ",
                        start.seed,
                        start.final_cost,
                        start.iterations,
                        std::isfinite(start.holdout_rmse)
                            ? error.WithUnit(start.holdout_rmse)
                            : std::string("-"),
                        fitting::ToString(start.stop));
  }
  const models::CostSpreadRecord spread = models::MakeRecord(starts).spread;
  return text +
         fmt::format("costs from {:.6g} to {:.6g}, median {:.6g}, sd {:.3g}\n",
                     spread.min,
                     spread.max,
                     spread.median,
                     spread.sd);
}

std::string Paragraph(const std::string& text, const Terminal& room) {
  if (text.empty()) return "";
  return WrapText(data::Printable(text), room.text_columns()) + "\n";
}

// The title and as much of a table as there is room for: lines are not broken,
// and the terminal is not scrolled away. "" without rows.
std::string InRoom(const Table& whole, const Terminal& room) {
  Table table = WithoutEmptyColumns(whole);
  if (table.rows.empty()) return "";
  std::vector<std::string> more;
  if (room.rows > 0 && table.rows.size() > room.rows) {
    const auto hidden = static_cast<long long>(table.rows.size() - room.rows);
    more.push_back(Count(hidden, "more row"));
    table.rows.resize(room.rows);
  }
  const std::vector<std::string> taken = TakeColumns(room.columns, 2, &table);
  if (!taken.empty()) more.push_back(data::JoinWords(taken, ", "));
  std::string text = table.title.empty() ? "" : table.title + "\n";
  text += TerminalTable(table, room.columns);
  if (!more.empty()) {
    text += Paragraph(data::JoinWords(more, "; ") + " with --details.", room);
  }
  return text + Paragraph(table.note, room) + "\n";
}

// For people: step log, coefficient table, ANOVA, s, R2, PRESS, condition,
// excluded and aliased terms.
std::string RegressionText(const models::RegressionRecord& record,
                           bool weighted,
                           const data::ColumnInfo& target,
                           const Terminal& room) {
  const models::LeastSquaresRecord fit =
      record.least_squares.value.value_or(models::LeastSquaresRecord());
  Table anova = AnovaTable(record);
  if (weighted) anova.title += " (weighted)";
  std::string text =
      "\n" + Paragraph(record.method, room) + "\n" +
      InRoom(StepTable(record), room) + InRoom(CoefficientTable(record), room) +
      InRoom(anova, room) +
      Paragraph(RegressionSummary(record, ErrorText(target.unit, fit.s)),
                room) +
      "\n" + InRoom(ExcludedTerms(record), room) +
      InRoom(AliasedTerms(record), room);
  for (const std::string& note : fit.notes) text += Paragraph(note, room);
  return text;
}

// Correlation matrix (Pearson, weighted) of the inputs and the target.
std::string CorrelationText(const data::Dataset& dataset,
                            const Terminal& room) {
  const models::CorrelationRecord correlations = models::Correlate(dataset);
  const std::vector<std::string>& names = correlations.columns;
  Table table{.nothing = ""};
  table.columns = {{"correlation", false}};
  for (const std::string& name : names) table.columns.push_back({name});
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<Cell>& row = table.rows.emplace_back();
    row.emplace_back(names[i]);
    for (std::size_t j = 0; j <= i; ++j) {
      row.emplace_back(Fixed{correlations.matrix[i][j], 4});
    }
  }
  return "\n" + InRoom(table, room);
}

std::string Line(const std::string& label,
                 double value,
                 const data::Unit& unit,
                 const std::string& note = "") {
  if (!std::isfinite(value)) {
    return fmt::format("  {:<10} n/a{}\n", label, note);
  }
  return fmt::format(
      "  {:<10} {:.5g}{}{}\n",
      label,
      value * unit.display_scale,
      unit.display_symbol.empty() ? "" : " " + unit.display_symbol,
      note);
}

}  // namespace

std::string FitText(const models::FittedModel& fitted,
                    const models::Sensitivity& sensitivity,
                    const stats::ErrorMetrics& train,
                    const data::Dataset& dataset,
                    const FitTextOptions& options) {
  const ErrorText error(fitted.target.unit, train.rmse);
  Terminal room = options.terminal;
  const std::size_t width = room.text_columns();
  if (options.details) {
    room.columns = std::string::npos;
    room.rows = 0;
  }
  std::string text;
  const auto say = [&](const std::string& words) {
    if (!words.empty()) text += WrapText(words, width) + "\n";
  };
  const Index learnt_from = fitted.RowsLearntFrom(dataset);
  say(fmt::format("{}: {} fitted to {}{}, RMSE {} on {} rows (not held out)",
                  fitted.name,
                  Count(fitted.model->num_parameters(), "parameter"),
                  learnt_from < dataset.num_rows()
                      ? fmt::format("{} of ", learnt_from)
                      : "",
                  Count(train.n, "row"),
                  error.WithUnit(train.rmse),
                  learnt_from < dataset.num_rows() ? "all" : "these"));
  constexpr Index kMostTerms = 12;
  const bool is_short =
      options.details || fitted.model->num_parameters() <= kMostTerms + 1;
  if (is_short) {
    say(data::Printable(fitted.equation));
  } else if (!fitted.equation.empty()) {
    say("The equation is long: it is in the file, and here with --details.");
  }
  std::istringstream lines(EndingText(fitted.summary));
  for (std::string line; std::getline(lines, line);) say(line);
  for (const std::string& remark : fitted.remarks) say(remark);
  text += StartsText(fitted.starts, error);
  if (options.correlations) text += CorrelationText(dataset, room);
  if (fitted.regression && is_short) {
    text += RegressionText(
        *fitted.regression, dataset.weights().size() != 0, fitted.target, room);
  }
  if (fitted.interval) {
    say(IntervalLine(models::MakeRecord(*fitted.interval), error));
  }
  say(SensitivityLine(sensitivity, error));
  say(fmt::format(
      "written to {}; it predicts {}; the compensation is minus that",
      options.out,
      fitted.target.unit.symbol.empty()
          ? fitted.target.name
          : fitted.target.name + " in " + fitted.target.unit.symbol));
  return text;
}

std::string SummaryText(const stats::ErrorMetrics& metrics,
                        const data::Unit& unit,
                        double ks_d,
                        double ks_p_given) {
  std::string text = fmt::format("  {:<10} {}\n", "n", metrics.n);
  text += Line("mean", metrics.mean, unit);
  text += Line("sd", metrics.sd, unit, "  (n - 1)");
  text += Line("rmse", metrics.rmse, unit, "  (n)");
  text += Line("mae", metrics.mae, unit);
  text += Line("min", metrics.min, unit);
  text += Line("max", metrics.max, unit);
  text += Line("range", metrics.range, unit);
  if (std::isfinite(metrics.r2)) {
    text += fmt::format("  {:<10} {:.6f}\n", "r2", metrics.r2);
  }
  if (std::isfinite(ks_d)) {
    text += fmt::format(
        "  {:<10} {:.5f}, p {:.4g} (Eq. 140; mean and sd are estimated\n  "
        "{:<10} from these values, so p is too large)\n",
        "K-S D",
        ks_d,
        ks_p_given,
        "");
  } else {
    text += fmt::format("  {:<10} n/a (the values do not vary)\n", "K-S D");
  }
  return text;
}

}  // namespace errmap::report
