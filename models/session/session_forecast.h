#pragma once

#include <vector>

#include "models/map_experience.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Measured errors of a session with their times, positions and predictions.
struct SessionProbes {
  VectorXd elapsed;    // (n) s since the session began
  VectorXd position;   // (n), or (0) if unknown
  VectorXd predicted;  // (n) target's unit
  VectorXd residuals;  // (n) target minus prediction, target's unit
};

/// Equally likely courses of a session's errors, given its probes.
///
/// A session's errors are scaled errors of the map's held-out sessions, with or
/// without one disturbance. This is an offset, a gain of the predicted error, a
/// growing offset, a shape over the position (if known), or a growing shape.
/// Each is a Gaussian process. Held-out errors are a drifting offset
/// (FitOffset) with noise, of the usual size at that time. Sizes of
/// disturbances are on a grid. Bayes' rule weights all of these by the probes,
/// and predicts other times and places, in closed form (Rasmussen & Williams
/// 2006, Eqs. 2.22 to 2.30).
struct SessionForecast {
  // Sites: times and places of held-out errors, evenly spread, in order of
  // time.
  VectorXd elapsed;           // (m)
  VectorXd position;          // (m), or (0)
  VectorXd predicted;         // (m), or (0)
  std::vector<Index> so_far;  // sites up to the last probe
  std::vector<Index> later;   // those after it
  MatrixXd errors;            // (draws x m) target's unit
};

/// `errors` has a positive RMSE; `probes` has at least one row, all finite. If
/// the time of `errors` is not in seconds, `later` is empty.
SessionForecast ForecastSession(const HeldOutErrors& errors,
                                const SessionProbes& probes);

}  // namespace errmap::models
