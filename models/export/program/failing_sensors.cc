#include <algorithm>
#include <cmath>

#include "models/export/program/controller.h"
#include "models/export/program/run_program.h"

namespace errmap::models {
namespace {

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

enum class PartOfRange { kMin, kMean, kMax };
constexpr PartOfRange kPartsOfRange[] = {
    PartOfRange::kMin, PartOfRange::kMean, PartOfRange::kMax};

// A state with all positions and all sensors there in their trained range:
// sensors warm together.
VectorXd HealthyState(const MapProgram& program,
                      PartOfRange positions,
                      PartOfRange sensors) {
  VectorXd state = MeanReadings(program);
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    const ProgramReading& reading = program.readings[i];
    const PartOfRange part = reading.is_position ? positions : sensors;
    if (part == PartOfRange::kMean) continue;
    state[static_cast<Index>(i)] =
        part == PartOfRange::kMin ? reading.trained_min : reading.trained_max;
  }
  return state;
}

// Raises *most to the largest change of the error after one of these failures
// of reading `i` in a healthy state.
template <typename ErrorAfter>
void RaiseToChange(const MapProgram& program,
                   const ErrorAfter& error,
                   const VectorXd& healthy,
                   std::size_t i,
                   const std::vector<double>& failures,
                   double* most) {
  const double own = error(program, healthy, healthy);
  VectorXd failed = healthy;
  for (const double value : failures) {
    failed[static_cast<Index>(i)] = value;
    *most = std::max(*most, std::fabs(error(program, healthy, failed) - own));
  }
}

// 0, and all between its limits of plausible values.
std::vector<double> FailuresOf(const ProgramReading& reading) {
  constexpr int kValues = 64;
  std::vector<double> failures{0.0};
  for (int k = 0; k <= kValues; ++k) {
    failures.push_back(reading.far_low +
                       (reading.far_high - reading.far_low) * k / kValues);
  }
  return failures;
}

}  // namespace

std::vector<FailingSensor> WorstOfFailing(const MapProgram& program) {
  std::vector<FailingSensor> found;
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    const ProgramReading& reading = program.readings[i];
    if (reading.is_position) continue;
    const std::vector<double> failures = FailuresOf(reading);
    FailingSensor& sensor =
        found.emplace_back(FailingSensor{.name = reading.column.name});
    const auto raise = [&](const auto& error,
                           const VectorXd& healthy,
                           const std::vector<double>& values,
                           double* most) {
      RaiseToChange(program, error, healthy, i, values, most);
    };
    for (const PartOfRange positions : kPartsOfRange) {
      // All sensors at an end might be refused, though they are healthy.
      raise(ErrorWithChecks,
            HealthyState(program, positions, PartOfRange::kMean),
            failures,
            &sensor.with);
      for (const PartOfRange sensors : kPartsOfRange) {
        const VectorXd healthy = HealthyState(program, positions, sensors);
        raise(ErrorByItself, healthy, failures, &sensor.without);
        raise(ErrorByItself, healthy, {0.0}, &sensor.zero);
      }
    }
  }
  std::ranges::stable_sort(found, std::ranges::greater{}, &FailingSensor::zero);
  return found;
}

}  // namespace errmap::models
