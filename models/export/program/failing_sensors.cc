#include "models/export/program/failing_sensors.h"

#include <algorithm>
#include <cmath>

#include "models/export/program/run_program.h"

namespace errmap::models {
namespace {

using Eigen::VectorXd;

constexpr double kForEver = 1e8;  // s

// The error given after `from`, then `to` for ever.
double ErrorWithChecks(const MapProgram& program,
                       const VectorXd& from,
                       const VectorXd& to) {
  ControllerRun run(program, Precision::kDouble);
  double error = 0.0;
  run.Step(kForEver, from, &error);
  run.Step(kForEver, to, &error);
  return error;
}

double ErrorByItself(const MapProgram& program,
                     const VectorXd& from,
                     const VectorXd& to) {
  ProgramRun run(program, Precision::kDouble);
  double error = 0.0;
  run.Begin(from);
  run.Step(kForEver, to, &error);
  return error;
}

}  // namespace

std::vector<FailingSensor> WorstOfFailing(const MapProgram& program) {
  constexpr int kValues = 64;
  const VectorXd healthy = MeanReadings(program);
  const double by_itself = ErrorByItself(program, healthy, healthy);
  const double with_checks = ErrorWithChecks(program, healthy, healthy);
  std::vector<FailingSensor> found;
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    const ProgramReading& reading = program.readings[i];
    if (reading.is_position) continue;
    VectorXd failed = healthy;
    double& value = failed[static_cast<Eigen::Index>(i)];
    value = 0.0;
    FailingSensor sensor{
        .name = reading.column.name,
        .without =
            std::fabs(ErrorByItself(program, healthy, failed) - by_itself),
        .with =
            std::fabs(ErrorWithChecks(program, healthy, failed) - with_checks)};
    for (int k = 0; k <= kValues; ++k) {
      value =
          reading.far_low + (reading.far_high - reading.far_low) * k / kValues;
      sensor.with = std::max(
          sensor.with,
          std::fabs(ErrorWithChecks(program, healthy, failed) - with_checks));
    }
    found.push_back(std::move(sensor));
  }
  std::ranges::stable_sort(
      found, std::ranges::greater{}, &FailingSensor::without);
  return found;
}

}  // namespace errmap::models
