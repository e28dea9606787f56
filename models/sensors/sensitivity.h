#pragma once

#include <string>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/error_model.h"

namespace errmap::models {

/// What disturbed readings do to the predictions of a map, over the rows that
/// it was fitted to (5000 of them at even steps, where they are more); target's
/// unit.
struct Sensitivity {
  /// RMS change where every sensor's reading carries independent noise with
  /// this standard deviation. Filters are taken to average it away, zeros to
  /// hold none.
  static constexpr double kNoise = 0.1;  // degC
  double per_noise = 0.0;
  /// Largest change where one sensor reads 0 from a session's second row on,
  /// and which.
  double largest_jump = 0.0;
  std::string jump_of;
  /// Largest change where the zero is taken anew in the row at hand; 0 for a
  /// map without one.
  double rezero_jump = 0.0;
};

/// Sensors are the inputs in degC; a map without any has nothing to tell of
/// them. Throws as FormInputs.
Sensitivity MeasureSensitivity(const FittedModel& fitted,
                               const data::Dataset& training);

}  // namespace errmap::models
