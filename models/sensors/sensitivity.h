#pragma once

#include <string>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Effect of disturbed readings on the predictions of a map, on at most 5000 of
/// its training rows. In the target's unit.
struct Sensitivity {
  /// RMS change if every sensor's reading has independent noise of this
  /// standard deviation. Filters are assumed to average the noise out, and
  /// zeros to be free of it.
  static constexpr double kNoise = 0.1;  // degC
  double per_noise = 0.0;
  /// Largest change if one sensor reads 0 from a session's second row on, and
  /// that sensor.
  double largest_jump = 0.0;
  std::string jump_of;
  /// Largest change if the zero is taken again at some row; 0 for a map without
  /// a zero.
  double rezero_jump = 0.0;
};

/// Sensors are the inputs in degC. Without any, their figures stay empty.
/// Throws as FormInputs.
Sensitivity MeasureSensitivity(const FittedModel& fitted,
                               const data::Dataset& training);

}  // namespace errmap::models
