#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "models/error_model.h"
#include "models/sensors/applicability.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// Kind of a map's error on measured rows.
enum class ErrorShape {
  kWithin,  // no larger than promised
  kOffset,  // larger, and an offset explains it
  kShape,   // larger, and no offset explains it
};
/// "within", "offset", "shape".
std::string_view ToString(ErrorShape shape);

/// Errors of a map on measured rows, compared with its promise and with no map.
/// In the target's unit; NaN if the map has no promise.
struct CalibrationCheck {
  double promised = stats::kNaN;  // on unseen units
  double found = 0.0;             // RMSE here
  double within_90 = 0.0;  // share of the rows within the promised interval
  double within_95 = 0.0;
  double uncompensated = 0.0;  // RMS of the target: no map at all
  double constant = 0.0;       // sd of the target: the best constant for it
  double mean = 0.0;           // of target minus prediction
  double offset_share = 0.0;   // share of the mean square
  std::optional<ErrorShape> shape;  // empty without a promise

  /// The RMS of the error about its mean.
  double scatter() const {
    return std::sqrt(std::max(0.0, found * found - mean * mean));
  }
  /// True if the map reduces the error on these rows.
  bool better_than_nothing() const { return found < uncompensated; }
  bool better_than_constant() const { return found < constant; }
};

/// Compares `targets` with `predicted` (m, at least 1). Each row's flag
/// (FlagRows) selects its interval; without flags, all rows count as inside.
CalibrationCheck CheckCalibration(const FittedModel& fitted,
                                  const VectorXd& targets,
                                  const VectorXd& predicted,
                                  const std::vector<RowFlag>& flags = {});

}  // namespace errmap::models
