#include "models/sensors/sensitivity.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "models/history/history.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

// How a reading enters one input of the form.
struct Path {
  std::string sensor;   // the column that it is derived from in the end
  double gain = 1.0;    // of noise in the reading at hand
  bool zeroed = false;  // less the session's first value
};

// Paths of angles have no sensor: they are not in degC.
std::vector<Path> PathsOf(const FittedModel& fitted) {
  std::vector<Path> paths;
  if (fitted.history == nullptr) {
    for (const TrainedInput& input : fitted.inputs) {
      paths.push_back({.sensor = input.column.name});
    }
    return paths;
  }
  const History& history = *fitted.history;
  for (const std::string& name : history.form_inputs) {
    Path path{.sensor = name};
    // Backwards, since each derived input builds on earlier ones only.
    for (auto input = history.derived.rbegin(); input != history.derived.rend();
         ++input) {
      if (input->column.name != path.sensor) continue;
      path.sensor = input->of;
      if (input->filter == Filter::kEma) path.gain = 0.0;
      if (input->filter == Filter::kZero) path.zeroed = true;
    }
    paths.push_back(std::move(path));
  }
  return paths;
}

bool IsThermometer(const data::ColumnInfo& column) {
  return column.unit.symbol == "degC";
}

double NoiseEffect(const FittedModel& fitted,
                   const MatrixXd& form,
                   const std::vector<Path>& paths,
                   const VectorXd& predicted) {
  VectorXd squares = VectorXd::Zero(form.rows());
  for (const TrainedInput& input : fitted.inputs) {
    if (!IsThermometer(input.column)) continue;
    MatrixXd noisy = form;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (paths[i].sensor != input.column.name) continue;
      noisy.col(static_cast<Index>(i)).array() +=
          paths[i].gain * Sensitivity::kNoise;
    }
    squares += (fitted.PredictForm(noisy).errors - predicted).cwiseAbs2();
  }
  return std::sqrt(squares.mean());
}

double RezeroJump(const FittedModel& fitted,
                  MatrixXd form,
                  const std::vector<Path>& paths,
                  const VectorXd& predicted) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].zeroed) form.col(static_cast<Index>(i)).setZero();
  }
  return (fitted.PredictForm(form).errors - predicted).cwiseAbs().maxCoeff();
}

// The rows as they would be if the column read 0 after each session's first
// row.
data::Dataset WithFailure(const data::Dataset& rows, Index column) {
  if (rows.log() == nullptr) {
    MatrixXd values = rows.input_values();
    values.col(column).setZero();
    return rows.WithInputs(rows.inputs(), std::move(values));
  }
  auto log = std::make_shared<data::SessionLog>(*rows.log());
  for (Index row = 0; row < log->input_values.rows(); ++row) {
    const auto session = static_cast<std::size_t>(
        log->sessions.codes[static_cast<std::size_t>(row)]);
    if (row != log->first_rows[session]) log->input_values(row, column) = 0.0;
  }
  return rows.WithLog(std::move(log), rows.log_rows());
}

// Of a map without a history, whose form reads the rows and no log.
MatrixXd FormWithFailure(const FittedModel& fitted,
                         const data::Dataset& rows,
                         const MatrixXd& form,
                         const std::string& sensor) {
  if (fitted.history != nullptr) {
    return fitted.FormInputs(WithFailure(rows, rows.FindInput(sensor)));
  }
  MatrixXd failed = form;
  for (std::size_t i = 0; i < fitted.inputs.size(); ++i) {
    if (fitted.inputs[i].column.name == sensor) {
      failed.col(static_cast<Index>(i)).setZero();
    }
  }
  return failed;
}

// Enough to meet every state of training.
data::Dataset Thinned(const data::Dataset& training) {
  constexpr Index kMostRows = 5000;
  return training.SelectRows(
      stats::SpreadSample(training.num_rows(), kMostRows));
}

}  // namespace

Sensitivity MeasureSensitivity(const FittedModel& fitted,
                               const data::Dataset& all_rows) {
  const data::Dataset training = Thinned(all_rows);
  const MatrixXd form = fitted.FormInputs(training);
  const VectorXd predicted = fitted.PredictForm(form).errors;
  const std::vector<Path> paths = PathsOf(fitted);
  Sensitivity found;
  found.per_noise = NoiseEffect(fitted, form, paths, predicted);
  found.rezero_jump = RezeroJump(fitted, form, paths, predicted);
  for (const TrainedInput& input : fitted.inputs) {
    if (!IsThermometer(input.column)) continue;
    const std::string& sensor = input.column.name;
    const MatrixXd failed = FormWithFailure(fitted, training, form, sensor);
    const double jump =
        (fitted.PredictForm(failed).errors - predicted).cwiseAbs().maxCoeff();
    if (jump <= found.largest_jump) continue;
    found.largest_jump = jump;
    found.jump_of = sensor;
  }
  return found;
}

}  // namespace errmap::models
