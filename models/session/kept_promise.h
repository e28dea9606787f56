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

/// What the error of a map on measured rows is made of.
enum class ErrorShape {
  kWithin,  // no larger than promised
  kOffset,  // larger, and an offset explains it
  kShape,   // larger, and no offset does
};
/// "within", "offset", "shape".
std::string_view ToString(ErrorShape shape);

/// A map on measured rows, compared with its promise and with no map. Target's
/// unit; NaN where the map promises nothing.
struct KeptPromise {
  double promised = stats::kNaN;  // on unseen units
  double found = 0.0;             // RMSE here
  double within_90 = 0.0;  // share of the rows within the promised interval
  double within_95 = 0.0;
  double uncompensated = 0.0;  // RMS of the target: no map at all
  double constant = 0.0;       // sd of the target: the best constant for it
  double mean = 0.0;           // of target less prediction
  double offset_share = 0.0;   // of the mean square that its mean is
  std::optional<ErrorShape> shape;  // nothing without a promise

  /// What is left without the mean.
  double scatter() const {
    return std::sqrt(std::max(0.0, found * found - mean * mean));
  }
  /// Whether the map is of use on these rows.
  bool better_than_nothing() const { return found < uncompensated; }
  bool better_than_constant() const { return found < constant; }
};

/// Takes `targets` and `predicted` (m, at least 1). A flag for each (FlagRows)
/// chooses the interval of the row; without flags, all rows are inside.
KeptPromise HoldToPromise(const FittedModel& fitted,
                          const VectorXd& targets,
                          const VectorXd& predicted,
                          const std::vector<RowFlag>& flags = {});

}  // namespace errmap::models
