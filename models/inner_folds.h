#pragma once

#include <string>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "fitting/fold_codes.h"
#include "models/error_model.h"

namespace errmap::models {

/// Which whole groups a fold has where groups are held out: neighbours, so that
/// a memory cannot carry over from them, or every fifth.
enum class GroupDeal { kRuns, kInTurn };

/// Folds for the choices made inside a fit, by context.inner_holdout, up to 5:
/// runs of whole sessions or groups, contiguous runs of rows, seeded shares of
/// the rows, or blocks of whole groups (rows where there are none) in order,
/// each predicted from those before it. No row outside `training` has a part in
/// it.
struct InnerFolds {
  fitting::FoldCodes folds;  // of the rows of `training`
  std::string text;  // "sessions:5 of day", "groups:5 of cycle", "kfold:5"
  bool whole_sessions = false;
  bool in_turn = false;  // GroupDeal::kInTurn was heeded
  /// Sessions or groups that are held out whole; else the folds.
  Eigen::Index units = 0;
};

/// What a choice on inner hold-outs minimises.
struct InnerError {
  double mean_square = 0.0;
  double standard_error = 0.0;  // of mean_square over folds; NaN for one fold
};

/// Of a candidate with these mean squares (judged folds), weighted by
/// `weights`: their mean; over whole sessions their geometric mean, since one
/// day far from all others would else decide alone, and for a map that leans
/// on nothing. Errors far below `indifference` count alike.
InnerError TypicalError(const InnerFolds& folds,
                        const Eigen::VectorXd& mean_squares,
                        const Eigen::VectorXd& weights,
                        double indifference);

/// `deal` counts under InnerHoldout::kWholeGroups alone: what is to hold on
/// another day is chosen on runs. Throws std::invalid_argument where there are
/// fewer than 2 rows.
InnerFolds MakeInnerFolds(const data::Dataset& training,
                          const FitContext& context,
                          GroupDeal deal = GroupDeal::kRuns);

}  // namespace errmap::models
