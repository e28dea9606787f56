#pragma once

// The members of all that a fitted map consists of, once for model files and
// the journal. Few files need this.

#include "models/error_model.h"
#include "models/history/history.h"
#include "models/map_experience.h"
#include "models/members.h"
#include "models/regression_report.h"

namespace errmap::data {

ERRMAP_RECORD(Unit, symbol, quantity, display_scale, display_symbol)
ERRMAP_RECORD(ColumnInfo, name, unit)
ERRMAP_RECORD(ColumnFilter, column, value)

}  // namespace errmap::data

namespace errmap::fitting {

ERRMAP_RECORD(TracePoint, iteration, rms_error, gradient_norm)
ERRMAP_RECORD(FitSummary,
              termination,
              message,
              initial_cost,
              final_cost,
              initial_gradient_norm,
              final_gradient_norm,
              iterations,
              value_evaluations,
              gradient_evaluations,
              curvature_evaluations,
              seconds,
              mean_iteration_seconds,
              sd_iteration_seconds,
              trace)
ERRMAP_RECORD(CoefficientEstimate,
              estimate,
              standard_error,
              t,
              p,
              lower,
              upper,
              standardised,
              vif)
ERRMAP_RECORD(RegressionDiagnostics,
              observations,
              rank,
              has_intercept,
              aliased,
              intercept,
              coefficients,
              regression_sum_of_squares,
              residual_sum_of_squares,
              total_sum_of_squares,
              residual_degrees_of_freedom,
              f,
              f_p,
              s,
              r2,
              adjusted_r2,
              condition,
              effective_rank,
              triangle,
              means,
              kept,
              bits,
              sum_of_weights)
ERRMAP_RECORD(RowDiagnostics,
              press,
              largest_residual,
              largest_residual_row,
              largest_leverage,
              leverage_one,
              rows)
ERRMAP_RECORD(SelectionStep,
              candidate,
              residual_sum_of_squares,
              bic,
              entered,
              terms,
              f,
              p,
              aic,
              aicc,
              adjusted_r2,
              press,
              cp,
              cv)

}  // namespace errmap::fitting

namespace errmap::models {

ERRMAP_RECORD(TrainedInput, column, min, max, mean, sd)
ERRMAP_RECORD(PolynomialTerm, powers, coefficient)
ERRMAP_RECORD(BendRange, input, min, max)
ERRMAP_RECORD(
    PolynomialForm, input_offset, input_scale, intercept, terms, bends_within)
ERRMAP_RECORD(NetForm,
              output,
              input_offset,
              input_scale,
              target_slope,
              target_offset,
              w1,
              w2)
ERRMAP_RECORD(
    BlendForm::Member, name, weight, inputs, lowest, highest, parameters, form)
ERRMAP_RECORD(BlendForm, num_inputs, rule, members)
ERRMAP_RECORD(PredictionCost, multiplications, exponentials)
ERRMAP_RECORD(OpaqueForm, num_inputs, cost)
ERRMAP_RECORD(EffectiveOption, key, value)
ERRMAP_RECORD(StartResult,
              seed,
              final_cost,
              termination,
              iterations,
              holdout_rmse,
              chosen)
ERRMAP_RECORD(ReportTerm, name, numbers, inclusion)
ERRMAP_RECORD(ReportStep, term, numbers)
ERRMAP_RECORD(ExcludedReport, name, f, p, inclusion)
ERRMAP_RECORD(AliasReport, name, why)
ERRMAP_RECORD(RegressionReport,
              method,
              candidates,
              steps,
              chosen_step,
              ended,
              selected,
              bootstrap,
              bootstrap_unit,
              cross_validation,
              excluded,
              aliased,
              fit,
              rows,
              intercept,
              terms,
              centres,
              weighted,
              penalised,
              strength,
              degrees_of_freedom,
              strengths,
              mean_squared_errors,
              standard_errors,
              notes)
ERRMAP_RECORD(DerivedInput, column, of, filter, tau, between)
ERRMAP_RECORD(RowChange, column, largest, mean)
ERRMAP_RECORD(History,
              time_unit,
              session,
              latest_start,
              row_changes,
              longest_step,
              derived,
              form_inputs)
ERRMAP_RECORD(Guards,
              input_margin,
              error_margin,
              input_min,
              input_max,
              error_min,
              error_max)
ERRMAP_RECORD(PredictionInterval::Level, coverage, half_width, at_least)
ERRMAP_RECORD(PredictionInterval,
              holdout,
              unit,
              units,
              levels,
              of_sessions,
              good_for,
              lag1)
ERRMAP_RECORD(Applicability::Derived, column, min, max)
ERRMAP_RECORD(Applicability,
              derived,
              columns,
              rows,
              mean,
              scale,
              directions,
              rest,
              states,
              distance_limit,
              leverage_limit,
              relation_limit)
ERRMAP_RECORD(
    HeldOutErrors::Unit, label, rmse, elapsed, position, residuals, temperature)
ERRMAP_RECORD(HeldOutErrors, time_unit, position, temperature, rmse, units)
ERRMAP_RECORD(LearntRows::Filter, alike, bits)
ERRMAP_RECORD(LearntRows, every, measured, readings)
ERRMAP_RECORD(FittedModel,
              name,
              kind,
              target,
              align,
              where,
              inputs,
              model,
              summary,
              equation,
              remarks,
              choices,
              starts,
              regression,
              history,
              guards,
              inner_rmse,
              interval,
              applicability,
              held_out,
              learnt)

/// The key of a form in model files; what has none cannot stand in them.
constexpr const char* FileKeyOf(const PolynomialForm* /*form*/) {
  return "polynomial";
}
constexpr const char* FileKeyOf(const NetForm* /*form*/) { return "net"; }
constexpr const char* FileKeyOf(const BlendForm* /*form*/) { return "blend"; }

}  // namespace errmap::models
