#pragma once

#include <vector>

#include "models/export/program/map_program.h"
#include "models/export/program/run_program.h"
#include "stats/eigen.h"

namespace errmap::models {

/// An invented reading of all inputs, with the expected result.
struct SelfTestRow {
  double dt = 0.0;  // s since the previous row; 0 in the first
  VectorXd readings;
  double error = 0.0;
  int status = 0;  // MapStatus; in rows of the map itself only kMapOutside
};

/// A session through the trained range, across it and beyond; always the same
/// for the same map. `error` comes from the map itself, as in `errmap predict`,
/// not from its program: the arithmetic is checked against it.
std::vector<SelfTestRow> SelfTestRows(const FittedModel& fitted,
                                      const MapProgram& program);

/// A session whose readings first agree as in training, then fail in several
/// ways and recover, with the controller's expected result for each row.
/// Exported files test themselves with it. `program` has its controller;
/// `first`, its first map, has the relations between sensors.
std::vector<SelfTestRow> ControllerSession(const FittedModel& first,
                                           const MapProgram& program,
                                           Precision precision);

/// Returns the range, max - min, of a map's errors: in training if its guards
/// have it, else over the rows within the trained range. For a constant map, it
/// is the size of the constant. At least the smallest normal number.
double ErrorRange(const FittedModel& fitted,
                  const std::vector<SelfTestRow>& rows);

/// The largest differences between a program and its map `form`, divided by
/// their error range.
struct Deviations {
  double inside = 0.0;    // of rows within the trained range
  double anywhere = 0.0;  // of all rows
};
Deviations FindDeviations(const MapProgram& program,
                          Precision precision,
                          const std::vector<SelfTestRow>& rows,
                          double error_range,
                          int form = 0);

/// The deviation allowed within the trained range.
constexpr double AllowedDeviation(Precision precision) {
  return precision == Precision::kDouble ? 1e-12 : 1e-5;
}

}  // namespace errmap::models
