#pragma once

#include <vector>

#include <Eigen/Core>

#include "models/export/program/map_program.h"
#include "models/export/program/run_program.h"

namespace errmap::models {

/// A made-up reading of all inputs and what is to be said of it.
struct SelfTestRow {
  double dt = 0.0;  // s since the row before; 0 in the first
  Eigen::VectorXd readings;
  double error = 0.0;
  int status = 0;  // MapStatus; in rows of the map itself kMapOutside alone
};

/// One session through the trained range, across it and beyond, the same for
/// the same map. `error` comes from the map itself, as `errmap predict` gives
/// it, not from its program: against it the arithmetic is held.
std::vector<SelfTestRow> SelfTestRows(const FittedModel& fitted,
                                      const MapProgram& program);

/// One session of readings that go together as in training, then fail in
/// several ways and come back, with what a controller must say of each row: for
/// an exported file to test itself. `program` with its controller, whose first
/// map tells how sensors go together.
std::vector<SelfTestRow> ControllerSession(const FittedModel& first,
                                           const MapProgram& program,
                                           Precision precision);

/// max - min of the errors that a map is about: of its training where its
/// guards know, else of the rows within the trained range; at least the
/// smallest normal number.
double ErrorRange(const FittedModel& fitted,
                  const std::vector<SelfTestRow>& rows);

/// The largest differences between a program and its map `form`, over their
/// error range.
struct Deviations {
  double inside = 0.0;    // of rows within the trained range
  double anywhere = 0.0;  // of all rows
};
Deviations FindDeviations(const MapProgram& program,
                          Precision precision,
                          const std::vector<SelfTestRow>& rows,
                          double error_range,
                          int form = 0);

/// What it may be within the trained range.
constexpr double AllowedDeviation(Precision precision) {
  return precision == Precision::kDouble ? 1e-12 : 1e-5;
}

}  // namespace errmap::models
