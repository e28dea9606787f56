#pragma once

#include <vector>

#include "models/map_experience.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Measured errors of a session: where, when, and what the map made of them.
struct SessionProbes {
  VectorXd elapsed;    // (n) s since the session began
  VectorXd position;   // (n), or (0) where none is known
  VectorXd predicted;  // (n) target's unit
  VectorXd residuals;  // (n) target less prediction, target's unit
};

/// What the errors of a session may be, by probes: draws that are alike likely.
///
/// A session's errors are those of the map's held-out sessions, larger or
/// smaller as a whole, or these and one disturbance: an offset, a gain of the
/// predicted error, an offset that grows, a shape over the position, or a shape
/// that grows. Each is a Gaussian process, held-out errors as an offset that
/// wanders (FitOffset) with noise, of the size that they have at the time;
/// shapes are left out if the probes have no position;
/// sizes of disturbances are on a grid. What probes make of all these by Bayes'
/// rule, and what follows at other times and places, is in closed form
/// (Rasmussen & Williams 2006, Eqs. 2.22 to 2.30).
struct SessionForecast {
  // Sites: times and places of held-out errors, spread evenly, by rising time.
  VectorXd elapsed;           // (m)
  VectorXd position;          // (m), or (0)
  VectorXd predicted;         // (m), or (0)
  std::vector<Index> so_far;  // sites up to the last probe
  std::vector<Index> later;   // those after it
  MatrixXd errors;            // (draws x m) target's unit
};

/// `errors` has a positive RMSE; `probes` at least one row, all finite. Where
/// the time of `errors` is not in seconds, nothing comes later.
SessionForecast ForecastSession(const HeldOutErrors& errors,
                                const SessionProbes& probes);

}  // namespace errmap::models
