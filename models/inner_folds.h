#pragma once

#include <cstddef>
#include <string>

#include "data/measurements/dataset.h"
#include "fitting/fold_codes.h"
#include "models/error_model.h"
#include "stats/eigen.h"

namespace errmap::models {

/// How whole groups are assigned to folds: as runs of neighbours, or in turn
/// (every fifth). Runs keep correlated neighbours together.
enum class GroupDeal { kRuns, kInTurn };

/// Up to 5 folds for the choices inside a fit, by context.inner_holdout. They
/// are runs of whole sessions or groups, contiguous runs of rows, or seeded
/// shares of the rows. Forward folds are blocks of whole groups (of rows if
/// there are none), each predicted from the earlier ones. Only rows of
/// `training` are used.
struct InnerFolds {
  fitting::FoldCodes folds;  // of the rows of `training`
  std::string text;  // "sessions:5 of day", "groups:5 of cycle", "kfold:5"
  bool whole_sessions = false;
  bool in_turn = false;  // GroupDeal::kInTurn was used
  /// Number of sessions or groups held out whole; else number of folds.
  Index units = 0;
};

/// The error that choices on inner hold-outs minimise.
struct InnerError {
  double mean_square = 0.0;
  double standard_error = 0.0;  // of mean_square over folds; NaN for one fold
};

/// Returns the mean of `mean_squares` (judged folds), weighted by `weights`.
/// Over whole sessions it is the geometric mean. With an arithmetic mean, one
/// extreme day would decide alone, and favour a map without inputs. Errors far
/// below `indifference` count as equal.
InnerError TypicalError(const InnerFolds& folds,
                        const VectorXd& mean_squares,
                        const VectorXd& weights,
                        double indifference);

/// Returns the root of TypicalError of folds with these sums of squared errors
/// (NaN: no fit) and numbers of rows.
double TypicalRmse(const InnerFolds& folds,
                   const VectorXd& squares,
                   const VectorXd& rows,
                   double indifference);

/// Limits for abandoning a view or a basis on inner hold-outs. It is abandoned
/// if its error with the first few penalties exceeds this multiple of that of
/// an earlier one. This harmed none of 1,095 searches for a ridge. It changed
/// 10 of 467 choices of a net's view, with the same errors elsewhere.
inline constexpr std::size_t kTrialsBeforeGivenUp = 3;
inline constexpr double kOutOfReach = 2.0;

/// `deal` matters only for InnerHoldout::kWholeGroups: choices that must hold
/// on another day use runs. Throws std::invalid_argument if there are fewer
/// than 2 rows.
InnerFolds MakeInnerFolds(const data::Dataset& training,
                          const FitContext& context,
                          GroupDeal deal = GroupDeal::kRuns);

}  // namespace errmap::models
