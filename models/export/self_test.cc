#include "models/export/self_test.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/history/history.h"
#include "models/history/history_state.h"

namespace errmap::models {
namespace {

using Eigen::Index;

constexpr int kNumRows = 24;

// How far a row goes, in half trained ranges from the middle: within, then a
// little outside, and where guards hold beyond what they let through.
double ReachOf(const FittedModel& fitted, int row) {
  constexpr int kFirstOutside = 18;
  constexpr int kFirstFar = 22;
  if (row < kFirstOutside) return 0.98;
  if (row < kFirstFar || !fitted.guards) return 1.3;
  return 1.5 * (1.0 + 2.0 * fitted.guards->input_margin);
}

// Readings that wander about, each at a pace of its own.
Eigen::VectorXd ReadingsOf(const std::vector<TrainedInput>& inputs,
                           int row,
                           double reach) {
  Eigen::VectorXd readings(static_cast<Index>(inputs.size()));
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double middle = 0.5 * (inputs[i].min + inputs[i].max);
    const double half = 0.5 * (inputs[i].max - inputs[i].min);
    const double turns = std::numbers::phi * row / 6.0 +
                         std::numbers::sqrt2 * static_cast<double>(i);
    readings[static_cast<Index>(i)] =
        middle + reach * half * std::sin(2.0 * std::numbers::pi * turns);
  }
  return readings;
}

double StepBefore(int row) {
  constexpr double kSteps[] = {60.0, 0.001, 300.0, 1.0, 20.0, 3600.0, 0.0};
  return row == 0 ? 0.0 : kSteps[static_cast<std::size_t>(row) % 7];
}

// What the form reads of a session, by the filters that `predict` runs.
Eigen::MatrixXd FormInputs(const FittedModel& fitted,
                           const std::vector<SelfTestRow>& rows) {
  std::vector<data::ColumnInfo> columns;
  for (const TrainedInput& input : fitted.inputs) {
    columns.push_back(input.column);
  }
  Eigen::MatrixXd inputs(static_cast<Index>(rows.size()),
                         fitted.model->num_inputs());
  if (fitted.history == nullptr) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      inputs.row(static_cast<Index>(i)) = rows[i].readings.transpose();
    }
    return inputs;
  }
  HistoryState state(*fitted.history, columns);
  state.Start(rows.front().readings);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    state.Step(rows[i].dt, rows[i].readings);
    inputs.row(static_cast<Index>(i)) = state.form_inputs().transpose();
  }
  return inputs;
}

}  // namespace

std::vector<SelfTestRow> SelfTestRows(const FittedModel& fitted,
                                      const MapProgram& program) {
  std::vector<SelfTestRow> rows;
  for (int row = 0; row < kNumRows; ++row) {
    rows.push_back(
        {.dt = StepBefore(row),
         .readings = ReadingsOf(fitted.inputs, row, ReachOf(fitted, row))});
  }
  const Prediction prediction = fitted.PredictForm(FormInputs(fitted, rows));
  std::vector<SelfTestRow> finite;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto at = static_cast<Index>(i);
    rows[i].error = prediction.errors[at];
    rows[i].status = StatusOfReadings(program, rows[i].readings) |
                     (prediction.clipped[at] ? kMapClipped : 0);
    // A map without guards may overflow; a session ends there.
    if (!std::isfinite(rows[i].error)) break;
    finite.push_back(rows[i]);
  }
  return finite;
}

double ErrorRange(const FittedModel& fitted,
                  const std::vector<SelfTestRow>& rows) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const SelfTestRow& row : rows) {
    if ((row.status & kMapOutside) != 0) continue;
    low = std::min(low, row.error);
    high = std::max(high, row.error);
  }
  double range = fitted.guards
                     ? fitted.guards->error_max - fitted.guards->error_min
                     : high - low;
  // A constant map has no range, and its own size serves.
  if (!(range > 0.0)) range = std::max(std::fabs(low), std::fabs(high));
  return std::isfinite(range)
             ? std::max(range, std::numeric_limits<double>::min())
             : std::numeric_limits<double>::min();
}

Deviations FindDeviations(const MapProgram& program,
                          Precision precision,
                          const std::vector<SelfTestRow>& rows,
                          double error_range) {
  ProgramRun run(program, precision);
  Deviations worst;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i == 0) run.Begin(rows[i].readings);
    double error = std::numeric_limits<double>::infinity();
    run.Step(rows[i].dt, rows[i].readings, &error);
    const double deviation = std::fabs(error - rows[i].error) / error_range;
    worst.anywhere = std::max(worst.anywhere, deviation);
    if ((rows[i].status & kMapOutside) != 0) continue;
    worst.inside = std::max(worst.inside, deviation);
  }
  return worst;
}

}  // namespace errmap::models
