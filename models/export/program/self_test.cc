#include "models/export/program/self_test.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/export/program/map_program.h"
#include "models/history/history.h"
#include "models/history/history_state.h"
#include "models/map_experience.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

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
VectorXd WanderingReadings(const MapProgram& program, int row, double reach) {
  VectorXd readings(std::ssize(program.readings));
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    const ProgramReading& reading = program.readings[i];
    const double middle = 0.5 * (reading.trained_min + reading.trained_max);
    const double half = 0.5 * (reading.trained_max - reading.trained_min);
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
MatrixXd FormInputs(const FittedModel& fitted,
                    const std::vector<SelfTestRow>& rows) {
  std::vector<data::ColumnInfo> columns;
  for (const TrainedInput& input : fitted.inputs) {
    columns.push_back(input.column);
  }
  MatrixXd inputs(std::ssize(rows), fitted.model->num_inputs());
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

bool IsInside(const MapProgram& program, const VectorXd& readings) {
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    const ProgramReading& reading = program.readings[i];
    const double value = readings[static_cast<Index>(i)];
    if (value < reading.trained_min || value > reading.trained_max) {
      return false;
    }
  }
  return true;
}

// How far each sensor goes with the others: along the first direction of the
// thermal states, as far as all stay within their trained range.
VectorXd CommonSwing(const FittedModel& first, const MapProgram& program) {
  constexpr double kWithin = 0.9;
  VectorXd swing(std::ssize(program.readings));
  for (Index i = 0; i < swing.size(); ++i) {
    const ProgramReading& reading =
        program.readings[static_cast<std::size_t>(i)];
    swing[i] = kWithin * std::min(reading.trained_max - reading.trained_mean,
                                  reading.trained_mean - reading.trained_min);
  }
  const Applicability* trained = first.applicability.get();
  if (trained == nullptr) return swing;
  const VectorXd along =
      trained->scale.cwiseProduct(trained->directions.col(0));
  double share = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < along.size(); ++i) {
    const Index column = trained->columns[static_cast<std::size_t>(i)];
    if (along[i] != 0.0) {
      share = std::min(share, swing[column] / std::fabs(along[i]));
    }
  }
  if (!std::isfinite(share)) share = 0.0;
  for (Index i = 0; i < along.size(); ++i) {
    swing[trained->columns[static_cast<std::size_t>(i)]] = share * along[i];
  }
  return swing;
}

// Sensors that warm up and cool down together, positions that wander.
VectorXd CommonReadings(const MapProgram& program,
                        const VectorXd& swing,
                        int row) {
  constexpr double kOwn = 0.01;  // of the range, each sensor by itself
  VectorXd readings = WanderingReadings(program, row, 0.98);
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    const ProgramReading& reading = program.readings[i];
    if (reading.is_position) continue;
    const auto at = static_cast<Index>(i);
    const double own =
        readings[at] - 0.5 * (reading.trained_min + reading.trained_max);
    readings[at] = reading.trained_mean +
                   swing[at] * std::sin(2.0 * std::numbers::pi * 0.07 * row) +
                   kOwn * own;
  }
  return readings;
}

constexpr int kNumFailures = 5;
constexpr int kNumHealthy = 14;

// A row in which a sensor, or without one the position, fails; the last one is
// so long after the others that the error fades.
void Fail(const MapProgram& program, int failure, SelfTestRow* row) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Index at = 0;
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    if (!program.readings[i].is_position) at = static_cast<Index>(i);
  }
  double none = 0.0;
  double& reading = row->readings.size() > 0 ? row->readings[at] : none;
  switch (failure) {
    case 0:
      reading = 0.0;
      return;
    case 1:
      reading = stats::kNaN;
      return;
    case 2:
      row->dt = kInfinity;
      return;
    case 3:
      reading = 850.0;
      return;
    default:
      reading = -kInfinity;
      row->dt = program.limits.hold + 1.0;
      return;
  }
}

}  // namespace

std::vector<SelfTestRow> ControllerSession(const FittedModel& first,
                                           const MapProgram& program,
                                           Precision precision) {
  const VectorXd swing = CommonSwing(first, program);
  std::vector<SelfTestRow> rows;
  for (int i = 0; i < kNumHealthy + kNumFailures + 2; ++i) {
    const int failure = i - kNumHealthy;
    SelfTestRow& row = rows.emplace_back(
        SelfTestRow{.dt = StepBefore(i + 1),
                    .readings = CommonReadings(program, swing, i)});
    if (failure >= 0 && failure < kNumFailures) Fail(program, failure, &row);
  }
  ControllerRun exact(program, Precision::kDouble);
  ControllerRun run(program, precision);
  for (SelfTestRow& row : rows) {
    double rounded = 0.0;
    row.status = run.Step(row.dt, row.readings, &rounded);
    exact.Step(row.dt, row.readings, &row.error);
  }
  return rows;
}

std::vector<SelfTestRow> SelfTestRows(const FittedModel& fitted,
                                      const MapProgram& program) {
  std::vector<SelfTestRow> rows;
  for (int row = 0; row < kNumRows; ++row) {
    rows.push_back(
        {.dt = StepBefore(row),
         .readings = WanderingReadings(program, row, ReachOf(fitted, row))});
  }
  const Prediction prediction = fitted.PredictForm(FormInputs(fitted, rows));
  std::vector<SelfTestRow> finite;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto at = static_cast<Index>(i);
    rows[i].error = prediction.errors[at];
    rows[i].status = IsInside(program, rows[i].readings) ? 0 : kMapOutside;
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
                          double error_range,
                          int form) {
  ProgramRun run(program, precision, form);
  Deviations worst;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const VectorXd readings = ReadingsOfProgram(
        program, static_cast<std::size_t>(form), rows[i].readings);
    if (i == 0) run.Begin(readings);
    double error = std::numeric_limits<double>::infinity();
    run.Step(rows[i].dt, readings, &error);
    const double deviation = std::fabs(error - rows[i].error) / error_range;
    worst.anywhere = std::max(worst.anywhere, deviation);
    if ((rows[i].status & kMapOutside) != 0) continue;
    worst.inside = std::max(worst.inside, deviation);
  }
  return worst;
}

}  // namespace errmap::models
