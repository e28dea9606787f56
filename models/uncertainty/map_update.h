#pragma once

#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/study/study.h"

namespace errmap::models {

/// The rows of two data sets of the same inputs and target, one after the
/// other; sessions of the second stay apart from those of the first, whatever
/// their labels. Throws std::invalid_argument where columns differ, or where
/// only one knows sessions and times.
data::Dataset Joined(const data::Dataset& first, const data::Dataset& second);

/// A map against its successor on new sessions that neither has seen.
struct UpdateTrial {
  struct Session {
    std::string session;
    double old_rmse = 0.0;  // target's unit
    double new_rmse = 0.0;
  };
  std::vector<Session> sessions;
  double old_rmse = 0.0;  // of all their rows
  double new_rmse = 0.0;
  std::string why_failed;  // of the successor; "": it could be fitted

  /// Lower by more than `indifference`, and in the geometric mean over the
  /// sessions: one long session alone does not decide, nor does one that is a
  /// little worse stand against one that was far off.
  bool better(double indifference) const;
};

/// Tries the successor: `recipe` fitted to `known` rows and all but one of the
/// new sessions, judged on that one, each in turn; the old map on the same
/// rows. `known` may be null: the successor then learns from new sessions
/// alone. Throws std::invalid_argument where there are fewer than two new
/// sessions.
UpdateTrial TryUpdate(const FittedModel& old_map,
                      const data::Dataset* known,
                      const data::Dataset& fresh,
                      const ModelRecipe& recipe,
                      const FitContext& context);

}  // namespace errmap::models
