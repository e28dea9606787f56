#include "models/study/record/making/fit_blocks.h"

#include <algorithm>
#include <cmath>

#include "stats/summary.h"

namespace errmap::models {
namespace {

CostSpreadRecord SpreadOf(const std::vector<StartResult>& starts) {
  std::vector<double> costs;
  for (const StartResult& start : starts) {
    if (std::isfinite(start.final_cost)) costs.push_back(start.final_cost);
  }
  CostSpreadRecord spread;
  spread.finite = static_cast<std::int64_t>(costs.size());
  if (costs.empty()) return spread;
  std::ranges::sort(costs);
  const std::size_t half = costs.size() / 2;
  spread.min = costs.front();
  spread.max = costs.back();
  spread.median = costs.size() % 2 == 1 ? costs[half]
                                        : 0.5 * (costs[half - 1] + costs[half]);
  if (costs.size() > 1) {
    spread.sd = stats::Summarize(
                    Eigen::Map<const Eigen::VectorXd>(
                        costs.data(), static_cast<Eigen::Index>(costs.size())))
                    .sd;
  }
  return spread;
}

StepRecord StepOf(const ReportStep& step) {
  const fitting::SelectionStep& numbers = step.numbers;
  return {.term = step.term.empty() ? std::optional<std::string>()
                                    : std::optional(step.term),
          .entered = numbers.entered,
          .terms = numbers.terms,
          .f = numbers.f,
          .p = numbers.p,
          .rss = numbers.residual_sum_of_squares,
          .aic = numbers.aic,
          .aicc = numbers.aicc,
          .bic = numbers.bic,
          .adjusted_r2 = numbers.adjusted_r2,
          .press = numbers.press,
          .cp = numbers.cp,
          .cv = numbers.cv};
}

CoefficientRecord CoefficientOf(const ReportTerm& term, bool is_intercept) {
  const fitting::CoefficientEstimate& numbers = term.numbers;
  CoefficientRecord record{.term = term.name,
                           .estimate = numbers.estimate,
                           .standard_error = numbers.standard_error,
                           .t = numbers.t,
                           .p = numbers.p,
                           .ci95 = {numbers.lower, numbers.upper},
                           .of_term = {}};
  if (!is_intercept) {
    record.of_term.value = TermRecord{.standardised = numbers.standardised,
                                      .vif = numbers.vif,
                                      .bootstrap_inclusion = term.inclusion};
  }
  return record;
}

LeastSquaresRecord LeastSquaresOf(const RegressionReport& report) {
  const fitting::RegressionDiagnostics& fit = report.fit;
  LeastSquaresRecord record;
  record.anova = {.regression_df = fit.regression_degrees_of_freedom(),
                  .regression_ss = fit.regression_sum_of_squares,
                  .residual_df = fit.residual_degrees_of_freedom,
                  .residual_ss = fit.residual_sum_of_squares,
                  .total_ss = fit.total_sum_of_squares,
                  .f = fit.f,
                  .p = fit.f_p};
  record.s = fit.s;
  record.r2 = fit.r2;
  record.adjusted_r2 = fit.adjusted_r2;
  record.press = report.rows.press;
  record.predicted_r2 = report.rows.PredictedR2(fit);
  record.rows_of_leverage_1 = report.rows.leverage_one;
  record.largest_residual = report.rows.largest_residual;
  record.largest_residual_row = report.rows.largest_residual_row;
  record.largest_leverage = report.rows.largest_leverage;
  record.condition = fit.condition;
  record.effective_rank = fit.effective_rank;
  record.bits = fit.bits;
  for (const ExcludedReport& term : report.excluded) {
    record.excluded.push_back({.term = term.name,
                               .f = term.f,
                               .p = term.p,
                               .bootstrap_inclusion = term.inclusion});
  }
  for (const AliasReport& term : report.aliased) {
    record.aliased.push_back({.term = term.name, .why = term.why});
  }
  record.after_selection = report.selected;
  record.bootstrap = {.repetitions = report.bootstrap,
                      .unit = report.bootstrap_unit};
  record.notes = report.notes;
  return record;
}

}  // namespace

MetricsRecord MakeRecord(const stats::ErrorMetrics& metrics) {
  return {.n = metrics.residuals.n,
          .mean = metrics.residuals.mean,
          .sd = metrics.residuals.sd,
          .rmse = metrics.rmse,
          .mae = metrics.mae,
          .min = metrics.residuals.min,
          .max = metrics.residuals.max,
          .range = metrics.residuals.range,
          .r2 = metrics.r2};
}

SummaryRecord MakeRecord(const fitting::FitSummary& summary) {
  SummaryRecord record{.stop = summary.termination,
                       .converged = summary.converged(),
                       .message = summary.message,
                       .iterations = summary.iterations,
                       .evaluations = summary.evaluations(),
                       .value_evaluations = summary.value_evaluations,
                       .gradient_evaluations = summary.gradient_evaluations,
                       .curvature_evaluations = summary.curvature_evaluations,
                       .initial_cost = summary.initial_cost,
                       .final_cost = summary.final_cost,
                       .initial_gradient_norm = summary.initial_gradient_norm,
                       .final_gradient_norm = summary.final_gradient_norm,
                       .mean_iteration_seconds = summary.mean_iteration_seconds,
                       .sd_iteration_seconds = summary.sd_iteration_seconds,
                       .trace = {}};
  if (summary.trace.empty()) return record;
  auto& trace = record.trace.emplace();
  for (const fitting::TracePoint& point : summary.trace) {
    trace.emplace_back(point.iteration, point.rms_error, point.gradient_norm);
  }
  return record;
}

StartsRecord MakeRecord(const std::vector<StartResult>& starts) {
  return {.table = starts, .spread = SpreadOf(starts)};
}

RegressionRecord MakeRecord(const RegressionReport& report) {
  RegressionRecord record{
      .method = report.method,
      .candidates = report.candidates,
      .steps = {},
      .chosen_step = static_cast<std::int64_t>(report.chosen_step),
      .ended = report.ended,
      .coefficients = {},
      .centres = report.centres,
      .penalised = {},
      .least_squares = {}};
  for (const ReportStep& step : report.steps) {
    record.steps.push_back(StepOf(step));
  }
  if (report.fit.has_intercept) {
    record.coefficients.push_back(CoefficientOf(report.intercept, true));
  }
  for (const ReportTerm& term : report.terms) {
    record.coefficients.push_back(CoefficientOf(term, false));
  }
  if (report.penalised) {
    record.penalised.value = PenaltyRecord{
        .penalty = report.strength,
        .effective_parameters = report.degrees_of_freedom,
        .cross_validation = {.holdout = report.cross_validation,
                             .penalty = report.strengths,
                             .mse = report.mean_squared_errors,
                             .standard_error = report.standard_errors}};
  } else {
    record.least_squares.value = LeastSquaresOf(report);
  }
  return record;
}

ByName<OptionValue> MakeRecord(const std::vector<EffectiveOption>& options) {
  ByName<OptionValue> record;
  for (const EffectiveOption& option : options) {
    record.emplace_back(option.key, option.value);
  }
  return record;
}

FitRecord MakeFitRecord(double fit_seconds,
                        const fitting::FitSummary& summary,
                        const std::vector<std::string>& remarks,
                        const std::vector<EffectiveOption>& choices,
                        const std::vector<StartResult>& starts) {
  FitRecord record{.fit_seconds = fit_seconds,
                   .summary = {MakeRecord(summary)},
                   .remarks = remarks,
                   .choices = {},
                   .starts = {}};
  if (!choices.empty()) record.choices = MakeRecord(choices);
  if (!starts.empty()) record.starts = MakeRecord(starts);
  return record;
}

}  // namespace errmap::models
