#pragma once

#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/study/study.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// Joins the rows of two data sets with the same inputs and target. Their
/// sessions stay separate, whatever their labels. Throws std::invalid_argument
/// if columns differ, or if only one has sessions and times.
data::Dataset Joined(const data::Dataset& first, const data::Dataset& second);

/// A map compared with its successor on new sessions that neither has seen.
struct UpdateTrial {
  struct Session {
    std::string session;
    double old_rmse = 0.0;  // target's unit
    double new_rmse = 0.0;
  };
  std::vector<Session> sessions;
  double old_rmse = 0.0;  // over all their rows
  double new_rmse = 0.0;
  /// Errors of the old map with the other sign, and shifted by the mean error
  /// of the other new sessions; NaN if these were not tried.
  double negated_rmse = stats::kNaN;
  double shifted_rmse = stats::kNaN;
  double shift = 0.0;      // mean error of the old map in all new sessions
  std::string why_failed;  // of the successor; "": it could be fitted

  /// True if the new errors differ from the old map by sign or by a constant.
  /// The old map corrected for it then has a lower error than the successor,
  /// which would average both.
  bool is_negated() const;
  bool is_shifted() const;
  /// True if neither is the case, and if both the RMSE and its geometric mean
  /// over the sessions are lower by more than `indifference`. So one long
  /// session does not decide alone, and a slightly worse session does not
  /// outweigh one with large errors.
  bool better(double indifference) const;
};

/// Tests the successor: fits `recipe` to `known` rows and all but one of the
/// new sessions, and tests it on that one, each in turn. The old map is tested
/// on the same rows. `known` may be null: the successor then learns from new
/// sessions alone. Throws std::invalid_argument if there are fewer than two new
/// sessions.
UpdateTrial TryUpdate(const FittedModel& old_map,
                      const data::Dataset* known,
                      const data::Dataset& fresh,
                      const ModelRecipe& recipe,
                      const FitContext& context);

}  // namespace errmap::models
